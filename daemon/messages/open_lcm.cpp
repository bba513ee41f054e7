#include "daemon/messages/open_lcm.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "core/errors.h"
#include "daemon/base/file_descriptor.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

constexpr int kConnectTimeoutMs = 1000;

/// Suppresses the many lines that the LCM library prints on a failure: our error is one line.
class QuietStandardError {
 public:
  QuietStandardError() : saved_(dup(STDERR_FILENO)) {
    std::fflush(stderr);
    const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(null, STDERR_FILENO);
    close(null);
  }
  ~QuietStandardError() {
    std::fflush(stderr);
    dup2(saved_, STDERR_FILENO);
    close(saved_);
  }
  QuietStandardError(const QuietStandardError&) = delete;
  QuietStandardError& operator=(const QuietStandardError&) = delete;

 private:
  int saved_;
};

LcmUrl Parse(const std::string& url) {
  try {
    return ParseLcmUrl(url);
  } catch (const SetupError& error) {
    throw SetupError(std::string("lcm.url: ") + error.what());
  }
}

bool Connects(const addrinfo& place) {
  const FileDescriptor fd(socket(place.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (connect(fd.get(), place.ai_addr, place.ai_addrlen) == 0) return true;
  if (errno != EINPROGRESS) return false;
  pollfd wait{fd.get(), POLLOUT, 0};
  if (poll(&wait, 1, kConnectTimeoutMs) != 1) return false;
  int error = 0;
  socklen_t size = sizeof error;
  return getsockopt(fd.get(), SOL_SOCKET, SO_ERROR, &error, &size) == 0 && error == 0;
}

/// LCM itself would only notice at the first message.
void RequireServer(const std::string& url, const LcmUrl& address) {
  if (address.provider != LcmProvider::kTcp || TcpServerAnswers(address)) return;
  throw SetupError("lcm.url: no server answers at " + url +
                   "; start lcm-tcpq-server first, or use udpm://239.255.76.67:7667?ttl=0");
}

/// Checks whether a log can be written, without creating it.
void RequireWritable(const std::string& url, const std::filesystem::path& file) {
  std::error_code error;
  const bool is_there = std::filesystem::exists(file, error);
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const bool can_write =
      is_there ? !std::filesystem::is_directory(file, error) && access(file.c_str(), W_OK) == 0
               : access(folder.c_str(), W_OK | X_OK) == 0;
  if (can_write) return;
  throw SetupError("lcm.url: " + url + ": the file cannot be written: " +
                   (errno != 0 ? std::strerror(errno) : "it is a folder"));
}

}  // namespace

bool HasMulticastRoute() {
  const FileDescriptor fd(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(7667);
  inet_pton(AF_INET, "239.255.76.67", &group.sin_addr);
  sockaddr address{};
  static_assert(sizeof address == sizeof group);
  std::memcpy(&address, &group, sizeof group);
  return connect(fd.get(), &address, sizeof address) == 0;
}

bool TcpServerAnswers(const LcmUrl& address) {
  addrinfo wanted{};
  wanted.ai_family = AF_INET;  // LCM supports IPv4 only.
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &wanted, &found)) {
    return false;
  }
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> places(found, &freeaddrinfo);
  for (const addrinfo* place = found; place; place = place->ai_next) {
    if (Connects(*place)) return true;
  }
  return false;
}

std::unique_ptr<lcm::LCM> OpenLcm(const std::string& url) {
  const LcmUrl address = Parse(url);
  RequireServer(url, address);
  if (address.provider == LcmProvider::kFile && address.is_written) {
    RequireWritable(url, address.file);
  }
  std::unique_ptr<lcm::LCM> lcm;
  {
    QuietStandardError quiet;
    lcm = std::make_unique<lcm::LCM>(url);
  }
  if (lcm->good()) return lcm;
  if (url.starts_with("udpm:") && !HasMulticastRoute()) {
    throw SetupError("lcm.url: " + url + " needs a multicast route, and there is none; add one: " +
                     "ip link set lo up && ip route add 224.0.0.0/4 dev lo");
  }
  throw SetupError("lcm.url: \"" + url +
                   "\" cannot be opened; expected one like udpm://239.255.76.67:7667?ttl=0");
}

std::string ReceiveFault(const LcmUrl& address) {
  if (address.provider != LcmProvider::kMulticast) return "";
  const std::string port = "UDP port " + std::to_string(address.port);
  const FileDescriptor fd(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!fd.valid()) return port + " cannot be used: " + std::strerror(errno);
  const int is_shared = 1;
  setsockopt(fd.get(), SOL_SOCKET, SO_REUSEADDR, &is_shared, sizeof is_shared);
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_port = htons(address.port);
  sockaddr place{};
  static_assert(sizeof place == sizeof here);
  std::memcpy(&place, &here, sizeof here);
  if (bind(fd.get(), &place, sizeof place) == 0) return "";
  const int error = errno;
  if (error == EADDRINUSE) {
    return port + " is in use by another program: ss -ulpn names it; end it, or use another port";
  }
  return port + " cannot be used: " + std::strerror(error) +
         (error == EACCES ? "; expected a port above 1023" : "");
}

std::unique_ptr<lcm::LCM> OpenLcmToListen(const std::string& url) {
  if (const std::string fault = ReceiveFault(Parse(url)); !fault.empty()) {
    throw SetupError("nothing can be received on " + Printable(url) + ": " + fault);
  }
  return OpenLcm(url);
}

std::unique_ptr<lcm::LCM> OpenLcmBeside(const std::string& url) {
  return Parse(url).provider == LcmProvider::kMulticast ? OpenLcm(url) : nullptr;
}

void CheckLcm(const std::string& url) {
  const LcmUrl address = Parse(url);
  if (address.provider == LcmProvider::kMulticast) OpenLcm(url);
  RequireServer(url, address);
  if (address.provider == LcmProvider::kFile) RequireWritable(url, address.file);
}

}  // namespace mocap
