#include "daemon/messages/channel_name.h"

#include <string_view>

#include "drivers/nearest_name.h"
#include "drivers/quoted.h"

namespace mocap {

std::string ChannelPattern(const std::string& text) {
  std::string pattern;
  for (const char c : text) {
    if (std::string_view("\\^$.|?*+()[]{}").find(c) != std::string_view::npos) pattern += '\\';
    pattern += c;
  }
  return pattern;
}

std::string PrefixPhrase(const std::vector<std::string>& prefixes) {
  std::vector<std::string> quoted;
  for (const std::string& prefix : prefixes) {
    if (!prefix.empty()) quoted.push_back(Quoted(prefix));
  }
  const bool has_plain = quoted.size() < prefixes.size();
  if (quoted.empty()) return "without a prefix";
  return (has_plain ? "without a prefix and " : "") +
         std::string(quoted.size() == 1 ? "with prefix " : "with the prefixes ") +
         ListedNames(quoted);
}

}  // namespace mocap
