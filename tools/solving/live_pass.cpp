#include "tools/solving/live_pass.h"

#include "tools/stop_on_signals.h"

namespace mocap {

void LivePass::OnSet(const TrackedSet& set) {
  EndIfStopAsked();
  if (also_) also_->OnSet(set);
  recorded_.grid = set.grid;
  recorded_.doubtful.assign(set.doubtful.begin(), set.doubtful.end());
  recorded_.outlines.assign(set.outlines.begin(), set.outlines.end());
  recorded_.person_box_W = set.person_box_W;
  recorded_.frame = set.frame;
  recorded_.capture_ns = set.capture_ns;
  spool_.Add(recorded_);
  if (everybody_) {
    for (const PersonView& person : set.people)
      Follow(person.id, person.capture->result(), person.capture->body());
  } else {
    Follow(1, set.result, set.body);
  }
  ++sets_;
}

void LivePass::Follow(int person, const CaptureResult& result, const BodyModel& body) {
  if (result.state != CaptureState::kTracking && result.state != CaptureState::kAcquiring) return;
  PersonTrack& track = tracks_.try_emplace(person, PersonTrack{body, 0, {}}).first->second;
  track.body = body;
  track.Set(sets_, result.pose);
}

}  // namespace mocap
