// Pipeline sink that keeps poses.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "daemon/pipeline/pose_sink.h"
#include "tools/results/result.h"

namespace mocap {

/// People whose poses are kept.
enum class KeptPeople {
  kFirst,     ///< One row per frame set, of the person tracked longest, or of nobody.
  kEverybody  ///< One result per person, with a row for each set in which the person is known.
};

/// Keeps frame sets as rows of results.
class ResultSink : public PoseSink {
 public:
  /// @param shows_progress  print the progress on stderr, a terminal.
  /// @param take  what is tracked; empty: no take.
  ResultSink(KeptPeople kept, bool shows_progress, std::optional<TakeMark> take = {})
      : kept_(kept), shows_progress_(shows_progress), take_(std::move(take)) {}
  /// Clears the progress line, which a failure may have left.
  ~ResultSink() { EndProgress(); }
  ResultSink(const ResultSink&) = delete;
  ResultSink& operator=(const ResultSink&) = delete;

  void OnSet(const TrackedSet& set) override;
  /// Clears the progress line.
  void EndProgress() const;

  const Result& result() const { return result_; }
  /// By people's ids; empty unless everybody is kept.
  const std::map<int, Result>& people() const { return people_; }
  std::size_t frames() const { return frames_; }
  /// Frames in which somebody was tracked.
  std::size_t tracked_frames() const { return tracked_frames_; }
  int acquisition_frames() const { return acquisition_frames_; }

 private:
  void Keep(const TrackedSet& set, const CaptureResult& captured, const BodyModel& body,
            Result& result) const;
  void ShowProgress(const TrackedSet& set) const;

  const KeptPeople kept_;
  const bool shows_progress_;
  const std::optional<TakeMark> take_;
  Result result_;
  std::map<int, Result> people_;
  std::size_t frames_ = 0;
  std::size_t tracked_frames_ = 0;
  int acquisition_frames_ = 0;
};

}  // namespace mocap
