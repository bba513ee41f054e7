#include "daemon/pipeline/keypoint_inbox.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/quantile.h"
#include "drivers/clock.h"

namespace mocap {
namespace {

/// Over which rates and medians are told.
constexpr std::int64_t kTellOverNs = 5'000'000'000;
constexpr std::size_t kMostTold = 512;

}  // namespace

bool KeypointInbox::Add(const std::string& sender, KeypointView view, int dropped_points,
                        std::int64_t now_ns, std::int64_t steady_ns) {
  const std::scoped_lock lock(mutex_);
  RemoveOld(now_ns);
  Sender* const from = FindOrAdd(sender, steady_ns);
  if (!from) return ++strangers_, false;
  const std::int64_t lag_ns = now_ns - view.capture_ns;
  Note(from->lags_ms, steady_ns, static_cast<double>(lag_ns) / 1e6);
  const auto refuse = [from](KeypointRefusal reason) {
    ++from->counts.refused[static_cast<std::size_t>(reason)];
    return false;
  };
  if (lag_ns > kMemoryNs) return refuse(KeypointRefusal::kOld);
  if (lag_ns < -kMemoryNs) return refuse(KeypointRefusal::kAhead);
  if (view.points.empty()) return refuse(KeypointRefusal::kEmpty);
  if (from->waiting >= kMostWaiting) return refuse(KeypointRefusal::kFull);
  ++from->waiting;
  ++from->counts.taken;
  from->counts.dropped_points += dropped_points;
  view.sender = sender;
  waiting_.push_back(std::move(view));
  return true;
}

void KeypointInbox::Refuse(const std::string& sender, KeypointRefusal reason,
                           std::int64_t steady_ns) {
  const std::scoped_lock lock(mutex_);
  Sender* const from = sender.empty() ? nullptr : FindOrAdd(sender, steady_ns);
  if (!from) return void(++strangers_);
  ++from->counts.refused[static_cast<std::size_t>(reason)];
}

void KeypointInbox::TakeFor(std::int64_t capture_ns, std::vector<KeypointView>& views) {
  views.clear();
  set_ns_.store(capture_ns, std::memory_order_relaxed);
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  RemoveOld(capture_ns);
  const auto is_later = [capture_ns](const KeypointView& view) {
    return view.capture_ns > capture_ns;
  };
  const auto taken = std::stable_partition(waiting_.begin(), waiting_.end(), is_later);
  for (auto each = taken; each != waiting_.end(); ++each) {
    if (Sender* const from = Find(each->sender)) --from->waiting;
    views.push_back(std::move(*each));
  }
  waiting_.erase(taken, waiting_.end());
}

void KeypointInbox::Tell(const KeypointView& view, double agreement) {
  Tell(view.sender, agreement, SteadyNs());
}

void KeypointInbox::Tell(const std::string& sender, double agreement, std::int64_t steady_ns) {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock() || !std::isfinite(agreement)) return;
  if (Sender* const from = Find(sender))
    Note(from->agreements, steady_ns, std::clamp(agreement, 0.0, 1.0));
}

KeypointsReport KeypointInbox::Report(std::int64_t steady_ns) const {
  const auto lately = [steady_ns](const std::deque<Timed>& list) {
    std::vector<double> values;
    for (const Timed& each : list)
      if (steady_ns - each.steady_ns < kTellOverNs) values.push_back(each.value);
    return values;
  };
  KeypointsReport report;
  const std::scoped_lock lock(mutex_);
  report.strangers = strangers_;
  for (const Sender& sender : senders_) {
    if (steady_ns - sender.heard_ns > kForgetNs) continue;
    KeypointSender& told = report.senders.emplace_back(sender.counts);
    std::vector<double> lags = lately(sender.lags_ms), agreements = lately(sender.agreements);
    if (!lags.empty()) {
      const Timed& oldest = *std::prev(sender.lags_ms.end(), std::ssize(lags));
      const double span_s = static_cast<double>(steady_ns - oldest.steady_ns) / 1e9;
      told.views_per_second = static_cast<double>(lags.size()) / std::max(1.0, span_s);
      told.lag_ms = MedianOf(lags);
    }
    if (!agreements.empty()) told.agreement = MedianOf(agreements);
  }
  std::ranges::sort(report.senders, {}, &KeypointSender::name);
  return report;
}

KeypointInbox::Sender* KeypointInbox::Find(const std::string& name) {
  for (Sender& sender : senders_)
    if (sender.counts.name == name) return &sender;
  return nullptr;
}

/// @return  null: there are too many.
KeypointInbox::Sender* KeypointInbox::FindOrAdd(const std::string& name, std::int64_t steady_ns) {
  Sender* found = Find(name);
  if (!found) {
    std::erase_if(senders_,
                  [&](const Sender& sender) { return steady_ns - sender.heard_ns > kForgetNs; });
    if (senders_.size() >= kMostSenders) return nullptr;
    found = &senders_.emplace_back();
    found->counts.name = name;
  }
  found->heard_ns = steady_ns;
  return found;
}

/// Nobody has taken them in time.
void KeypointInbox::RemoveOld(std::int64_t now_ns) {
  std::erase_if(waiting_, [&](const KeypointView& view) {
    const bool is_old = now_ns - view.capture_ns > kMemoryNs;
    Sender* const from = is_old ? Find(view.sender) : nullptr;
    if (from) {
      --from->waiting;
      --from->counts.taken;
      ++from->counts.refused[static_cast<std::size_t>(KeypointRefusal::kOld)];
    }
    return is_old;
  });
}

void KeypointInbox::Note(std::deque<Timed>& list, std::int64_t steady_ns, double value) {
  list.push_back({steady_ns, value});
  while (list.size() > kMostTold || steady_ns - list.front().steady_ns > kTellOverNs)
    list.pop_front();
}

}  // namespace mocap
