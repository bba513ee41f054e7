#include "tools/results/result_sink.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "tools/stop_on_signals.h"

namespace mocap {

void ResultSink::OnSet(const TrackedSet& set) {
  EndIfStopAsked();
  const auto is_tracked = [](const PersonView& person) {
    return person.capture->result().state == CaptureState::kTracking;
  };
  ++frames_;
  tracked_frames_ += std::ranges::any_of(set.people, is_tracked);
  acquisition_frames_ = set.acquisition_frames;
  if (kept_ == KeptPeople::kFirst) {
    Keep(set, set.result, set.body, result_);
  } else {
    for (const PersonView& person : set.people)
      Keep(set, person.capture->result(), person.capture->body(), people_[person.id]);
  }
  if (shows_progress_) ShowProgress(set);
}

void ResultSink::Keep(const TrackedSet& set, const CaptureResult& captured, const BodyModel& body,
                      Result& result) const {
  result.poses.push_back(PoseRowOf(set.frame, set.capture_ns, captured, body));
  result.body = RecordOf(body);
  if (!result.take) result.take = take_;
}

void ResultSink::ShowProgress(const TrackedSet& set) const {
  const std::string state(kCaptureStateNames[static_cast<std::size_t>(set.result.state)]);
  std::fprintf(stderr, "\r\x1b[Kframe %lld  %s", static_cast<long long>(set.frame), state.c_str());
  if (set.people.size() > 1) std::fprintf(stderr, "  %zu people", set.people.size());
}

void ResultSink::EndProgress() const {
  if (shows_progress_) std::fprintf(stderr, "\r\x1b[K");
}

}  // namespace mocap
