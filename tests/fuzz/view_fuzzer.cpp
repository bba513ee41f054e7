#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "tools/view/access.h"
#include "tools/view/control_desk.h"
#include "tools/view/live_feed.h"
#include "tools/view/request_target.h"

namespace {

/// A feed that has heard of a studio and of a body, as all that came before left it.
class Feed {
 public:
  void Hear(const std::string& channel, std::string_view bytes) {
    lcm_.publish(channel, bytes.data(), static_cast<unsigned>(bytes.size()));
    while (lcm_.handleTimeout(0) > 0) {
    }
  }

 private:
  lcm::LCM lcm_{"memq://"};
  mocap::LiveFeed feed_{lcm_, "", "memq://", [](std::size_t, mocap::LiveMessage) {}};
};

constexpr std::array kChannels = {"MOCAP_POSE",    "MOCAP_BODY",     "MOCAP_VOXELS",
                                  "MOCAP_STATUS",  "MOCAP_SERVICE",  "MOCAP_STUDIO",
                                  "MOCAP_PREVIEW", "MOCAP_PEOPLE",   "MOCAP_BODIES",
                                  "MOCAP_UNKNOWN", "MOCAP_CONTRAST", "MOCAP_DETAILS"};

void Ask(std::string_view text) {
  const mocap::RequestTarget target = mocap::ParseRequestTarget(text);
  mocap::IsOwnHost(text);
  mocap::IsFromOwnPage({text, text, text, text}, true);
  static const mocap::ControlDesk desk("/nonexistent/control", "token");
  desk.Answer({.method = "POST",
               .path = "/control",
               .query = target.query,
               .authorization = "Bearer token",
               .body = std::string(text)});
}

}  // namespace

/// The first byte says whether the rest is a message or comes from a browser.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  static Feed feed;
  if (data[0] < kChannels.size()) {
    feed.Hear(kChannels[data[0]], rest);
  } else {
    Ask(rest);
  }
  return 0;
}
