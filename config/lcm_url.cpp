#include "config/lcm_url.h"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "drivers/quoted.h"

namespace mocap {
namespace {

constexpr std::string_view kDefaultGroup = "239.255.76.67";
constexpr std::string_view kDefaultServer = "127.0.0.1";
constexpr std::uint16_t kDefaultMulticastPort = 7667;
constexpr std::uint16_t kDefaultServerPort = 7700;
constexpr int kMostHops = 255;
constexpr const char* kWanted = "; expected one like udpm://239.255.76.67:7667?ttl=0";

[[noreturn]] void Fail(const std::string& url, const std::string& what) {
  throw SetupError("\"" + url + "\" " + what);
}

std::optional<int> Number(std::string_view text, int min, int max) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  if (!is_number || value < min || value > max) return std::nullopt;
  return value;
}

struct Option {
  std::string_view key, value;
};

std::vector<Option> SplitOptions(std::string_view text) {
  std::vector<Option> options;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('&'), text.size());
    const std::string_view one = text.substr(0, end);
    const std::size_t equals = std::min(one.find('='), one.size());
    options.push_back({one.substr(0, equals), one.substr(std::min(equals + 1, one.size()))});
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return options;
}

[[noreturn]] void FailOption(const std::string& url, const Option& option,
                             const std::vector<std::string>& known) {
  Fail(url, "has the unknown option " + Quoted(option.key) + "; " +
                WithNearestName(option.key, known, "expected " + known[0] + " or " + known[1]));
}

void CheckMulticastOption(const std::string& url, const Option& option, bool has_ports) {
  constexpr int kLargestBuffer = 1 << 30;
  constexpr int kMostPorts = 65535;
  const auto require = [&](int min, int max) {
    if (Number(option.value, min, max)) return;
    Fail(url, "has " + std::string(option.key) + "=" + std::string(option.value) +
                  "; expected a number of " + std::to_string(min) + " to " + std::to_string(max));
  };
  if (option.key == "ttl") return require(0, kMostHops);
  if (option.key == "recv_buf_size") return require(1, kLargestBuffer);
  if (has_ports && option.key == "nports") return require(1, kMostPorts);
  FailOption(url, option, {"ttl", "recv_buf_size"});
}

/// Parses "HOST:PORT". Missing parts keep LCM's defaults.
void ReadPlace(const std::string& url, std::string_view place, LcmUrl& address) {
  if (place.empty()) return;
  const std::size_t colon = place.rfind(':');
  address.host = place.substr(0, colon);
  if (place.starts_with('[')) {
    Fail(url, "has an IPv6 address, and LCM knows only IPv4" + std::string(kWanted));
  }
  constexpr int kHighestPort = 65535;
  const std::optional<int> port = colon == std::string_view::npos
                                      ? std::nullopt
                                      : Number(place.substr(colon + 1), 1, kHighestPort);
  if (address.host.empty() || !port) {
    Fail(url, "has no address with a port of 1 to 65535" + std::string(kWanted));
  }
  address.port = static_cast<std::uint16_t>(*port);
}

LcmUrl Multicast(const std::string& url, std::string_view place, const std::vector<Option>& options,
                 bool has_ports) {
  LcmUrl address{.provider = LcmProvider::kMulticast,
                 .host = std::string(kDefaultGroup),
                 .port = kDefaultMulticastPort,
                 .file = {}};
  ReadPlace(url, place, address);
  in_addr group{};
  if (inet_pton(AF_INET, address.host.c_str(), &group) != 1 || !IN_MULTICAST(ntohl(group.s_addr))) {
    Fail(url, "names " + address.host +
                  ", which is not a multicast address; expected 224.0.0.0 to 239.255.255.255");
  }
  for (const Option& option : options) {
    CheckMulticastOption(url, option, has_ports);
    if (option.key == "ttl") address.hops = *Number(option.value, 0, kMostHops);
  }
  return address;
}

double Speed(const std::string& url, std::string_view text) {
  constexpr double kSlowest = 0.001, kFastest = 1e6;
  double speed = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), speed);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  if (is_number && (speed == 0 || (speed >= kSlowest && speed <= kFastest))) return speed;
  Fail(url, "has speed=" + std::string(text) + "; expected 0 or a number from 0.001 to 1000000");
}

LcmUrl File(const std::string& url, std::string_view place, const std::vector<Option>& options) {
  LcmUrl address{.provider = LcmProvider::kFile, .host = {}, .file = std::string(place)};
  if (address.file.empty()) Fail(url, "has no file name");
  for (const Option& option : options) {
    if (option.key == "mode") {
      if (option.value != "r" && option.value != "w" && option.value != "a") {
        Fail(url, "has mode=" + std::string(option.value) + "; expected w, a or r");
      }
      address.is_written = option.value != "r";
    } else if (option.key == "speed") {
      address.speed = Speed(url, option.value);
    } else {
      FailOption(url, option, {"mode", "speed"});
    }
  }
  return address;
}

void RequireNoOptions(const std::string& url, const std::vector<Option>& options) {
  if (!options.empty()) Fail(url, "has options, but this kind of address takes none");
}

}  // namespace

LcmUrl ParseLcmUrl(const std::string& url) {
  const std::size_t scheme_end = url.find("://");
  if (scheme_end == std::string::npos) Fail(url, "is not an LCM address" + std::string(kWanted));
  const std::string scheme = url.substr(0, scheme_end);
  std::string_view rest(url);
  rest.remove_prefix(scheme_end + 3);
  const std::size_t question = std::min(rest.find('?'), rest.size());
  const std::string_view place = rest.substr(0, question);
  const std::vector<Option> options =
      SplitOptions(rest.substr(std::min(question + 1, rest.size())));
  if (scheme == "udpm" || scheme == "mpudpm") {
    return Multicast(url, place, options, scheme == "mpudpm");
  }
  if (scheme == "file") return File(url, place, options);
  if (scheme == "tcpq") {
    LcmUrl address{.provider = LcmProvider::kTcp,
                   .host = std::string(kDefaultServer),
                   .port = kDefaultServerPort,
                   .file = {}};
    ReadPlace(url, place, address);
    RequireNoOptions(url, options);
    return address;
  }
  if (scheme != "memq") Fail(url, "begins with " + scheme + ", which LCM does not have" + kWanted);
  RequireNoOptions(url, options);
  LcmUrl address;
  address.provider = LcmProvider::kMemory;
  return address;
}

}  // namespace mocap
