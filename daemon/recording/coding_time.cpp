#include "daemon/recording/coding_time.h"

#include <fstream>

namespace mocap {

std::optional<ThreadTimes> ReadThreadTimes(pid_t thread) {
  std::ifstream in("/proc/self/task/" + std::to_string(thread) + "/schedstat");
  ThreadTimes times;
  if (!(in >> times.ran_ns >> times.queued_ns)) return std::nullopt;
  return times;
}

LossCause CauseOf(const CodingTime& time, int processors) {
  /// A cause that takes a larger share of the time explains the loss.
  constexpr double kMuch = 0.4;
  const auto all_ns = static_cast<double>(time.all_ns());
  if (all_ns <= 0) return LossCause::kUnknown;
  const auto share = [all_ns](std::int64_t part_ns) {
    return static_cast<double>(part_ns) / all_ns;
  };
  if (share(time.blocked_ns) > kMuch) return LossCause::kDisk;
  if (share(time.held_ns) > kMuch) return LossCause::kPoses;
  // Coders that are numerous enough keep each other from the processor.
  const double own = static_cast<double>(time.ran_ns) /
                     (static_cast<double>(time.wall_ns) * static_cast<double>(processors));
  const bool take_all = time.wall_ns > 0 && own > kMuch;
  return take_all || time.ran_ns > time.queued_ns ? LossCause::kCodec : LossCause::kOtherWork;
}

std::string TextOf(LossCause cause) {
  switch (cause) {
    case LossCause::kUnknown:
      break;
    case LossCause::kOtherWork:
      return "the processor was busy with other programs: stop them, or raise recording.buffer_mb";
    case LossCause::kCodec:
      return "the codec is too slow on this processor: use fewer frames a second, smaller pictures "
             "or a faster recording.codec (\"raw\" is the fastest, then \"huffyuv\")";
    case LossCause::kDisk:
      return "the disk is too slow: use a faster disk, or a recording.codec that writes less "
             "(\"ffv1\" writes the least, then \"huffyuv\")";
    case LossCause::kPoses:
      return "tracking was behind and has priority: use larger voxels or a lower frame rate";
  }
  return "the cause is not known: raise recording.buffer_mb";
}

}  // namespace mocap
