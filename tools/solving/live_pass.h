// The first pass over a take: tracks it as live, and keeps what the sets show and who was where.
#pragma once

#include <functional>
#include <map>

#include "core/solving/person_track.h"
#include "daemon/pipeline/pose_sink.h"
#include "tools/solving/set_spool.h"
#include "tools/solving/solve_files.h"

namespace mocap {

/// Receives the sets of the first pass.
class LivePass : public PoseSink {
 public:
  /// @param everybody  else only the person tracked for longest, as number 1.
  /// @param also       gets every set; null: nobody. Borrowed.
  LivePass(const std::filesystem::path& spool, bool everybody, PoseSink* also)
      : everybody_(everybody), spool_(spool), also_(also) {}

  void OnSet(const TrackedSet& set) override;

  FirstPass Finish() { return {spool_.Finish(), std::move(tracks_)}; }

 private:
  void Follow(int person, const CaptureResult& result, const BodyModel& body);

  const bool everybody_;
  SetSpoolWriter spool_;
  PoseSink* const also_;
  RecordedSet recorded_;
  std::map<int, PersonTrack> tracks_;
  int sets_ = 0;
};

}  // namespace mocap
