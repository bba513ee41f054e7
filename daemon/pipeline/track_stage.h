// Turns voxel grids into poses and hands them on.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "core/people/people_capture.h"
#include "daemon/pipeline/carve_stage.h"
#include "daemon/pipeline/pose_sink.h"
#include "daemon/pipeline/stage.h"
#include "drivers/subject_position.h"

namespace mocap {

/// Tracks each set and hands it on. For one thread; counters: any.
class TrackStage : private UpdateObserver {
 public:
  /// @param person  receives the subject position, for pan-tilt heads; may be null.
  TrackStage(PeopleCapture people, LatencyOrigin origin, PoseSink& sink, StageRecorders& recorders,
             std::shared_ptr<SubjectPosition> person = nullptr);

  ~TrackStage();

  /// @param keypoints  that have come for the set.
  void Process(const CarvedSet& set, std::span<const KeypointRays> keypoints = {});
  /// From the next set on, tracks a person of these sizes. Without sizes, measures those who are
  /// present. Any thread.
  /// @param subject  if its name is empty, nobody is named.
  void ChangeSubject(const std::optional<KnownPerson>& subject);
  /// From the next set on, a person whose sizes match one of these gets that name. Any thread.
  void KnowPeople(const std::vector<KnownPerson>& people);
  /// From the next set on, names the person with this number. One thread at a time.
  void NamePerson(int id, const std::string& name);
  /// The tracked people after the last set; tracking thread only.
  std::span<const PersonView> people() const { return people_.people(); }
  std::int64_t sets() const { return sets_.load(std::memory_order_relaxed); }
  CaptureState state() const { return state_.load(std::memory_order_relaxed); }

 private:
  using Subject = std::optional<KnownPerson>;
  using KnownPeople = std::vector<KnownPerson>;
  using NamedPeople = std::vector<std::pair<int, std::string>>;

  void TakeRequests();
  std::int64_t Onward(std::int64_t capture_ns);
  void OnStageEnd(UpdateStage stage) override;

  PeopleCapture people_;
  LatencyOrigin origin_;
  PoseSink& sink_;
  StageRecorders& recorders_;
  const std::shared_ptr<SubjectPosition> person_;
  // Owned until the tracking thread takes them.
  std::atomic<const Subject*> next_subject_{nullptr};
  std::atomic<KnownPeople*> next_known_{nullptr};
  std::atomic<NamedPeople*> next_names_{nullptr};
  std::int64_t mark_ns_ = 0;                ///< When the previous stage ended.
  std::array<std::int64_t, 2> stage_ns_{};  ///< By UpdateStage, for this update.
  std::int64_t shift_ns_ = 0;               ///< From capture to the tracker's time.
  std::optional<std::int64_t> last_ns_;     ///< Of the last set, in the tracker's time.
  std::atomic<std::int64_t> sets_{0};
  std::atomic<CaptureState> state_{CaptureState::kSearching};
};

}  // namespace mocap
