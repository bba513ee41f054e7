#include "tools/comparison/paired_places.h"

#include <algorithm>

namespace mocap {
namespace {

/// Our points a while before and after a moment.
struct Around {
  std::optional<FramePlace> before, after;
  double apart_s;

  Vector3 VelocityOf(const std::vector<Vector3>& track) const {
    if (!before || !after) return Unseen();
    return (PointAt(track, *after) - PointAt(track, *before)) / apart_s;
  }
};

}  // namespace

std::vector<SharedMoment> SharedMoments(const RecordedMotion& own, const RecordedMotion& other,
                                        double offset_s, std::size_t most) {
  const FrameFinder own_frames(own), other_frames(other);
  const bool by_own = own.Period() >= other.Period();
  const std::vector<double>& times = by_own ? own.time_s : other.time_s;
  std::vector<SharedMoment> moments;
  for (const double time_s : times) {
    const double own_s = by_own ? time_s : time_s + offset_s;
    const auto here = own_frames.Find(own_s), there = other_frames.Find(own_s - offset_s);
    if (here && there) moments.push_back({own_s, *here, *there});
  }
  if (moments.size() <= most) return moments;
  std::vector<SharedMoment> chosen;
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(moments[i * moments.size() / most]);
  return chosen;
}

PairedPlaces PlacesAt(const ResultMotion& own, const RecordedMotion& other,
                      const Alignment& alignment, std::size_t most) {
  const FrameFinder frames(own.motion);
  const double while_s = std::max(own.motion.Period(), other.Period());
  PairedPlaces all;
  for (const SharedMoment& moment : SharedMoments(own.motion, other, alignment.offset_s, most)) {
    const Around around{frames.Find(moment.time_s - while_s), frames.Find(moment.time_s + while_s),
                        2 * while_s};
    for (std::size_t i = 0; i < alignment.pairs.size(); ++i) {
      const PointPair& pair = alignment.pairs[i];
      const PlacePair place{PointAt(pair.other, moment.other), PointAt(*pair.own, moment.own)};
      if (!place.other.allFinite() || !place.own.allFinite()) continue;
      all.places.push_back(place);
      all.velocity_W.push_back(around.VelocityOf(*pair.own));
      all.pair.push_back(i);
      all.frame.push_back(NearestFrame(moment.own));
    }
  }
  return all;
}

const Matrix3& RotationAt(const ResultMotion& own, const Alignment& alignment,
                          const PairedPlaces& all, std::size_t place) {
  const PointPair& pair = alignment.pairs[all.pair[place]];
  return own.R_WS[all.frame[place]][static_cast<std::size_t>(pair.segment)];
}

std::vector<Vector3> SegmentMeans(const ResultMotion& own, const Alignment& alignment,
                                  const PairedPlaces& all, const std::vector<Vector3>& vectors_W) {
  std::vector<Vector3> sums(alignment.pairs.size(), Vector3::Zero());
  std::vector<double> counts(sums.size());
  for (std::size_t i = 0; i < vectors_W.size(); ++i) {
    if (!vectors_W[i].allFinite()) continue;
    sums[all.pair[i]] += RotationAt(own, alignment, all, i).transpose() * vectors_W[i];
    ++counts[all.pair[i]];
  }
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= std::max(1.0, counts[i]);
  return sums;
}

}  // namespace mocap
