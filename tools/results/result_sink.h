// The end of a pipeline whose poses are to be kept.
#pragma once

#include <cstddef>
#include <map>

#include "daemon/pipeline/pose_sink.h"
#include "tools/results/result.h"

namespace mocap {

/// Whose poses are kept.
enum class KeptPeople {
  kFirst,     ///< Every set is a row: of whoever has been followed the longest, or of nobody.
  kEverybody  ///< A result a person, with rows of the sets in which the person is known.
};

/// Keeps sets as rows of results.
class ResultSink : public PoseSink {
 public:
  /// @param shows_progress  on a terminal: how far it is, on stderr.
  ResultSink(KeptPeople kept, bool shows_progress) : kept_(kept), shows_progress_(shows_progress) {}

  void OnSet(const TrackedSet& set) override;
  /// Clears the line that showed the progress.
  void EndProgress() const;

  const Result& result() const { return result_; }
  /// By the people's ids; empty unless everybody's are kept.
  const std::map<int, Result>& people() const { return people_; }
  std::size_t frames() const { return frames_; }
  /// In which somebody was tracked.
  std::size_t tracked_frames() const { return tracked_frames_; }
  int acquisition_frames() const { return acquisition_frames_; }

 private:
  void ShowProgress(const TrackedSet& set) const;

  const KeptPeople kept_;
  const bool shows_progress_;
  Result result_;
  std::map<int, Result> people_;
  std::size_t frames_ = 0;
  std::size_t tracked_frames_ = 0;
  int acquisition_frames_ = 0;
};

}  // namespace mocap
