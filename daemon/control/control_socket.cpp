#include "daemon/control/control_socket.h"

#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "daemon/base/service_folders.h"

namespace mocap {
namespace {

constexpr const char* kSystemSocket = "/run/mocapd/control";
constexpr int kWaitingClients = 8;
/// A client that connects and sends nothing delays the others no longer than this.
constexpr timeval kClientPatience{1, 0};
/// A status waits only for other requests.
constexpr timeval kStatusPatience{15, 0};
constexpr mode_t kOwnerAndGroup = 0660;

std::string Why() { return std::strerror(errno); }

FileDescriptor NewSocket() {
  FileDescriptor fd(socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
  if (!fd.valid()) throw std::runtime_error("a local socket cannot be created: " + Why());
  return fd;
}

sockaddr_un AddressOf(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.native().size() >= sizeof address.sun_path) {
    throw SetupError(path.string() + ": is too long for the path of a socket");
  }
  std::strcpy(address.sun_path, path.c_str());
  return address;
}

template <typename Call>
int WithAddress(Call call, int fd, const sockaddr_un& address) {
  return call(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address);
}

/// How a person starts the daemon on this computer.
std::string StartHint() {
  std::error_code error;
  bool is_service = std::filesystem::exists("/run/systemd/system", error);
  const auto has_unit = [&error](const char* folder) {
    return std::filesystem::exists(std::filesystem::path(folder) / "mocapd.service", error);
  };
  is_service &= std::ranges::any_of(
      std::array{"/etc/systemd/system", "/usr/local/lib/systemd/system", "/lib/systemd/system"},
      has_unit);
  return is_service ? "start mocapd: systemctl start mocapd" : "start mocapd: mocapd --config FILE";
}

[[noreturn]] void RefusePlace(const std::filesystem::path& path, const std::string& why) {
  throw SetupError(path.string() + ": the control socket cannot be created: " + why);
}

FileDescriptor Listen(const std::filesystem::path& path) {
  const sockaddr_un address = AddressOf(path);
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (WithAddress(connect, NewSocket().get(), address) == 0) {
    throw SetupError(path.string() + ": another mocapd uses this socket");
  }
  // Left by an earlier run that was killed.
  if (std::filesystem::is_socket(path, error)) std::filesystem::remove(path, error);
  FileDescriptor listener = NewSocket();
  if (WithAddress(bind, listener.get(), address) != 0 || chmod(path.c_str(), kOwnerAndGroup) != 0 ||
      listen(listener.get(), kWaitingClients) != 0) {
    RefusePlace(path, Why());
  }
  return listener;
}

std::optional<std::string> Receive(int fd, std::size_t longest) {
  std::string message(longest + 1, '\0');
  errno = 0;
  const ssize_t received = recv(fd, message.data(), message.size(), 0);
  if (received <= 0) return {};
  message.resize(static_cast<std::size_t>(received));
  return message;
}

[[noreturn]] void FailSilent(const std::filesystem::path& place, const timeval& patience) {
  throw std::runtime_error(place.string() + ": mocapd has not answered for " +
                           std::to_string(patience.tv_sec) +
                           " s: it hangs, or is busy with another request");
}

std::filesystem::path UsersOwnSocket() {
  const char* folder = std::getenv("XDG_RUNTIME_DIR");
  return folder ? std::filesystem::path(folder) / "mocapd" / "control" : std::filesystem::path();
}

/// Of a daemon that is not named by its socket. The user's own comes last.
std::vector<std::filesystem::path> UsualSockets() {
  std::vector<std::filesystem::path> sockets = {kSystemSocket};
  if (const std::filesystem::path own = UsersOwnSocket(); !own.empty()) sockets.push_back(own);
  return sockets;
}

[[noreturn]] void FailUnanswered(const std::filesystem::path& socket) {
  if (!socket.empty()) {
    throw std::runtime_error("nothing answers at " + socket.string() +
                             ": start mocapd with this control.socket");
  }
  const std::filesystem::path own = UsersOwnSocket();
  const std::string nowhere = "nothing answers at " + std::string(kSystemSocket);
  if (!own.empty()) throw std::runtime_error(nowhere + " or " + own.string() + ": " + StartHint());
  throw std::runtime_error(nowhere + ": " + StartHint() +
                           "; XDG_RUNTIME_DIR is not set, so a mocapd of your own needs [control] "
                           "socket in its FILE, and commands --config FILE");
}

}  // namespace

std::filesystem::path ControlSocketOf(const std::filesystem::path& configured) {
  if (!configured.empty()) return configured;
  if (const char* folder = std::getenv("RUNTIME_DIRECTORY")) {
    return std::filesystem::path(folder) / "control";
  }
  return UsersOwnSocket();
}

void RequireSocketPlace(const std::filesystem::path& socket) {
  AddressOf(socket);
  std::error_code error;
  if (std::filesystem::exists(socket, error) && !std::filesystem::is_socket(socket, error)) {
    RefusePlace(socket, "a file or folder of that name exists");
  }
  const std::string why = WhyNotWritable(std::filesystem::absolute(socket).parent_path());
  if (!why.empty()) RefusePlace(socket, why);
}

ControlServer::ControlServer(const std::filesystem::path& socket, Handler handler)
    : path_(socket),
      handler_(std::move(handler)),
      listener_(Listen(socket)),
      stop_(eventfd(0, EFD_CLOEXEC)) {
  thread_ = std::thread([this] { Run(); });
}

ControlServer::~ControlServer() {
  eventfd_write(stop_.get(), 1);
  thread_.join();
  std::error_code error;
  std::filesystem::remove(path_, error);
}

void ControlServer::Run() {
  pthread_setname_np(pthread_self(), "control");
  std::array<pollfd, 2> waits = {{{stop_.get(), POLLIN, 0}, {listener_.get(), POLLIN, 0}}};
  for (;;) {
    if (poll(waits.data(), waits.size(), -1) < 0 && errno != EINTR) return;
    if (waits[0].revents != 0) return;
    if (waits[1].revents == 0) continue;
    const FileDescriptor client(accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
    if (client.valid()) Answer(client.get());
  }
}

void ControlServer::Answer(int client) const {
  setsockopt(client, SOL_SOCKET, SO_RCVTIMEO, &kClientPatience, sizeof kClientPatience);
  setsockopt(client, SOL_SOCKET, SO_SNDTIMEO, &kClientPatience, sizeof kClientPatience);
  const std::optional<std::string> line = Receive(client, kLongestRequest);
  if (!line) return;
  ControlReply reply;
  try {
    const std::optional<ControlRequest> request = ParseControlRequest(*line);
    reply = request ? handler_(*request)
                    : ControlReply{ControlOutcome::kWrong, "the request is not understood"};
  } catch (const SetupError& error) {
    reply = {ControlOutcome::kWrong, error.what()};
  } catch (const std::exception& error) {
    reply = {ControlOutcome::kFailed, error.what()};
  }
  const std::string message = EncodeReply(reply);
  send(client, message.data(), message.size(), MSG_NOSIGNAL);
}

ControlReply AskDaemon(const std::filesystem::path& socket, const std::string& request) {
  const auto places = socket.empty() ? UsualSockets() : std::vector{socket};
  for (const std::filesystem::path& place : places) {
    const timeval patience =
        request.starts_with("status") ? kStatusPatience : timeval{kReplyPatience.count(), 0};
    const FileDescriptor fd = NewSocket();
    setsockopt(fd.get(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    setsockopt(fd.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    if (WithAddress(connect, fd.get(), AddressOf(place)) != 0) {
      if (errno == EAGAIN) FailSilent(place, patience);
      if (errno != EACCES) continue;
      throw SetupError(place.string() +
                       ": permission denied; as root: adduser USER mocap, then log in again");
    }
    std::optional<std::string> message;
    if (send(fd.get(), request.data(), request.size(), MSG_NOSIGNAL) >= 0) {
      message = Receive(fd.get(), kLongestReply);
    }
    if (!message && errno == EAGAIN) FailSilent(place, patience);
    const std::optional<ControlReply> reply = message ? DecodeReply(*message) : std::nullopt;
    if (!reply) throw std::runtime_error(place.string() + ": mocapd did not answer");
    return *reply;
  }
  FailUnanswered(socket);
}

ControlReply ReplyOfDaemon(const std::filesystem::path& socket, const std::string& request) {
  try {
    return AskDaemon(socket, request);
  } catch (const SetupError& error) {
    return {ControlOutcome::kWrong, error.what()};
  } catch (const std::runtime_error& error) {
    return {ControlOutcome::kFailed, error.what()};
  }
}

}  // namespace mocap
