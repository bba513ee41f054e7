#include "daemon/messages/channel_name.h"

#include <string_view>

namespace mocap {

std::string ChannelPattern(const std::string& text) {
  std::string pattern;
  for (const char c : text) {
    if (std::string_view("\\^$.|?*+()[]{}").find(c) != std::string_view::npos) pattern += '\\';
    pattern += c;
  }
  return pattern;
}

}  // namespace mocap
