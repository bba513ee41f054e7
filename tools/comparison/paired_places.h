// Places of paired points at moments that two recordings share.
#pragma once

#include <string>
#include <vector>

#include "tools/comparison/result_motion.h"
#include "tools/comparison/rigid_fit.h"

namespace mocap {

/// A point of a result and the markers whose middle is compared with it.
struct PointPair {
  std::string point;
  std::vector<std::string> others;
  const std::vector<Vector3>* own = nullptr;  ///< By frame of the result's motion; not owned.
  std::vector<Vector3> other;                 ///< By frame of the other recording.
  Segment segment = Segment::kTorso;
};

/// How points were paired.
enum class PairedBy { kNames, kMotion, kAngles };

struct Alignment {
  PairedBy by = PairedBy::kNames;
  double offset_s = 0;  ///< Our time is the other's plus this.
  RigidTransform X;     ///< Takes the other's points to our world.
  std::vector<PointPair> pairs;
  double median_mm = 0;  ///< Distance of paired points.
};

/// A moment that both recordings have: a frame of the slower one.
struct SharedMoment {
  double time_s = 0;  ///< Of the result.
  FramePlace own, other;
};
/// @param most  moments, evenly chosen.
std::vector<SharedMoment> SharedMoments(const RecordedMotion& own, const RecordedMotion& other,
                                        double offset_s, std::size_t most);

/// Places of all pairs at shared moments: only what both recordings see.
struct PairedPlaces {
  std::vector<PlacePair> places;
  std::vector<Vector3> velocity_W;  ///< Of our points [mm/s]; NaN: at an end or a gap.
  std::vector<std::size_t> pair;    ///< Index of each place's pair.
  std::vector<std::size_t> frame;   ///< Our nearest frame.
};
PairedPlaces PlacesAt(const ResultMotion& own, const RecordedMotion& other,
                      const Alignment& alignment, std::size_t most);

/// Rotation of the segment of a place's pair to the world.
const Matrix3& RotationAt(const ResultMotion& own, const Alignment& alignment,
                          const PairedPlaces& all, std::size_t place);

/// The mean of vectors of each pair, in the axes of its segment. @param vectors_W  one per place.
std::vector<Vector3> SegmentMeans(const ResultMotion& own, const Alignment& alignment,
                                  const PairedPlaces& all, const std::vector<Vector3>& vectors_W);

}  // namespace mocap
