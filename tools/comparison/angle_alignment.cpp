// Aligns recordings of joint angles.
#include <algorithm>
#include <cmath>

#include "core/degrees.h"
#include "tools/comparison/agreement.h"
#include "tools/comparison/alignment.h"
#include "tools/comparison/ground_pelvis.h"
#include "tools/comparison/least_near.h"
#include "tools/comparison/speed_correlation.h"
#include "tools/comparison/text_motion.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

constexpr std::size_t kManyAngleMoments = 2000;

/// An angle in both recordings, in whose own spread differences are measured.
struct AngleTracks {
  const std::vector<double>* own;
  std::vector<double> other;  ///< With our sign.
  double spread_deg;
};

double SpreadOfAngle(const std::vector<double>& deg) { return AgreementOf(deg).rmsd_without_bias; }

/// Angles that move in both recordings and mean the same in every ground.
std::vector<AngleTracks> TracksOf(const ResultMotion& own, const RecordedMotion& other,
                                  const std::vector<AnglePair>& angles) {
  // Less is noise, or a coordinate that is held.
  constexpr double kLeast_deg = 1;
  std::vector<AngleTracks> tracks;
  for (const AnglePair& pair : angles) {
    const AngleCurve* here = own.motion.FindAngle(pair.own);
    const AngleCurve* there = other.FindAngle(pair.other);
    if (!here || !there || IsOfGround(pair.own)) continue;
    const double spread = SpreadOfAngle(here->deg);
    if (!(spread > kLeast_deg) || !(SpreadOfAngle(there->deg) > kLeast_deg)) continue;
    tracks.push_back({&here->deg, there->deg, spread});
    for (double& deg : tracks.back().other) deg *= pair.sign;
  }
  return tracks;
}

/// Mean squared difference, less its mean, in shares of each angle's spread.
double LossAt(const ResultMotion& own, const RecordedMotion& other,
              const std::vector<AngleTracks>& tracks, double offset_s) {
  const auto moments = SharedMoments(own.motion, other, offset_s, kManyAngleMoments);
  double loss = 0;
  for (const AngleTracks& track : tracks) {
    std::vector<double> apart_deg;
    for (const SharedMoment& moment : moments)
      apart_deg.push_back(AngleAt(*track.own, moment.own) - AngleAt(track.other, moment.other));
    const Agreement agreement = AgreementOf(apart_deg);
    // What never overlaps is as unlike as can be.
    constexpr double kUnlike = 4;
    loss +=
        agreement.count > 2 ? std::pow(agreement.rmsd_without_bias / track.spread_deg, 2) : kUnlike;
  }
  return loss / static_cast<double>(tracks.size());
}

}  // namespace

std::optional<Alignment> AlignByAngles(const ResultMotion& own, const RecordedMotion& other,
                                       const std::vector<AnglePair>& angles) {
  const std::vector<AngleTracks> tracks = TracksOf(own, other, angles);
  if (tracks.empty()) return {};
  const double step_s = CoarseStep(own.motion, other);
  const TimeGrid own_grid = GridOf(own.motion, step_s), other_grid = GridOf(other, step_s);
  std::vector<SignalPair> signals;
  for (const AngleTracks& track : tracks)
    signals.push_back({Resampled(own.motion, AngleCurve{"", *track.own}, own_grid),
                       Resampled(other, AngleCurve{"", track.other}, other_grid)});
  Alignment best;
  double least = 1e300;
  for (const OffsetCandidate& candidate :
       FindOffsets(signals, LeastOverlap(own.motion, other, step_s), 12)) {
    const double offset_s =
        own.motion.time_s.front() - other.time_s.front() + step_s * candidate.lag;
    const auto loss = [&](double at) { return LossAt(own, other, tracks, at); };
    const double refined_s = LeastNear(offset_s, step_s, 2e-5, loss);
    // Strides are alike: a weaker correlation must fit clearly better.
    constexpr double kClearly = 0.9;
    const double here = loss(refined_s);
    if (here >= kClearly * least) continue;
    least = here;
    best.offset_s = refined_s;
  }
  if (least > 1e299) return {};
  best.by = PairedBy::kAngles;
  const NamedPair pelvis{std::string(kPelvisOrigin), {std::string(kPelvisOrigin)}};
  best.pairs = PairsOf(own, other, std::span(&pelvis, 1));
  AlignGrounds(own, other, best);
  return best;
}

}  // namespace mocap
