#include "daemon/messages/silence.h"

#include <utility>
#include <vector>

#include "daemon/messages/channel_name.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

// Anyone may send.
constexpr std::size_t kMostOthers = 8;

}  // namespace

Silence::Silence(lcm::LCM& lcm, std::string url, std::string prefix,
                 std::function<std::int64_t()> now_ns)
    : lcm_(lcm), url_(std::move(url)), prefix_(std::move(prefix)), now_ns_(std::move(now_ns)) {
  // Every daemon sends this once a second, whatever its role.
  subscription_ = lcm_.subscribe(std::string(".*") + kStatusChannel, &Silence::OnMessage, this);
}

Silence::~Silence() { lcm_.unsubscribe(subscription_); }

void Silence::OnMessage(const lcm::ReceiveBuffer*, const std::string& channel) {
  const std::string prefix =
      channel.substr(0, channel.size() - std::string_view(kStatusChannel).size());
  const std::int64_t now_ns = now_ns_();
  std::erase_if(heard_ns_, [&](const auto& heard) { return now_ns - heard.second > kLimit_ns; });
  const std::size_t others = heard_ns_.size() - heard_ns_.count(prefix_);
  if (prefix != prefix_ && !heard_ns_.contains(prefix) && others >= kMostOthers) return;
  heard_ns_[prefix] = now_ns;
}

std::string Silence::Text() const {
  const std::int64_t now_ns = now_ns_();
  std::vector<std::string> others;
  bool is_here = false;
  for (const auto& [prefix, time_ns] : heard_ns_) {
    if (now_ns - time_ns > kLimit_ns) continue;
    is_here |= prefix == prefix_;
    if (prefix != prefix_) others.push_back(prefix);
  }
  const std::string url = Printable(url_);
  if (is_here)
    return "mocapd sends its status on " + url +
           ", but no poses: mocap status says why; a node never sends poses, its studio does";
  if (others.empty())
    return "no messages arrive on " + url + ": is mocapd running? mocap doctor checks the network";
  const std::string text = "no messages " + PrefixPhrase({prefix_}) + " arrive on " + url +
                           ", but mocapd sends there " + PrefixPhrase(others);
  return text + (others == std::vector<std::string>{""} ? ": leave --prefix out"
                                                        : ": choose it with --prefix");
}

}  // namespace mocap
