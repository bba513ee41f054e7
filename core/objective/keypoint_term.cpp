#include "core/objective/keypoint_term.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace mocap {
namespace {

// How a view may be meant.
enum Meaning { kRight, kExchanged, kElsewhere };
using Meanings = std::array<double, 3>;

/// Where a landmark is, seen from a line of sight.
struct Offset {
  Vector3 p_W;       ///< Of the landmark.
  Vector3 across_W;  ///< From the line of sight to the landmark.
};

class PosedLandmarks {
 public:
  explicit PosedLandmarks(const PosedBody& posed)
      : posed_(posed), places_(PlaceLandmarks(posed.body())) {}

  int CarrierOf(Landmark landmark) const { return Of(landmark).carrier; }
  Offset From(const KeypointRay& ray, Landmark landmark) const {
    const Vector3 p_W = PlaceIn(posed_.posture(), Of(landmark));
    const Vector3 from_eye_W = p_W - ray.eye_W;
    return {p_W, from_eye_W - from_eye_W.dot(ray.direction_W) * ray.direction_W};
  }

 private:
  const LandmarkPlace& Of(Landmark landmark) const { return places_[static_cast<int>(landmark)]; }

  const PosedBody& posed_;
  LandmarkPlaces places_;
};

double ScaledSquare(const Vector3& across_W, double scale_mm) {
  return across_W.squaredNorm() / (kKeypointNoise.freedom * scale_mm * scale_mm);
}

// A view's points count as this many independent ones.
double ShareOf(const KeypointRays& view) {
  return std::min(1.0, kKeypointNoise.independent / static_cast<double>(view.rays.size()));
}

// -log p of a view's points by each meaning, more than that of points without a residual. They
// follow Student's t in two dimensions.
Meanings NatsByMeaning(const KeypointRays& view, const PosedLandmarks& landmarks) {
  LogSum right, exchanged;
  double elsewhere = 0;
  for (const KeypointRay& ray : view.rays) {
    const double scale_mm = KeypointScale_mm(ray.landmark, ray.score);
    right.Add(ScaledSquare(landmarks.From(ray, ray.landmark).across_W, scale_mm));
    exchanged.Add(ScaledSquare(landmarks.From(ray, Mirrored(ray.landmark)).across_W, scale_mm));
    elsewhere += std::log(kKeypointNoise.region_mm2 / (2 * std::numbers::pi * scale_mm * scale_mm));
  }
  const double per_log = (kKeypointNoise.freedom + 2) / 2;
  const double share = ShareOf(view);
  return {share * per_log * right.Sum() - std::log(kKeypointNoise.Right()),
          share * per_log * exchanged.Sum() - std::log(kKeypointNoise.exchanged),
          share * elsewhere - std::log(kKeypointNoise.elsewhere)};
}

struct Mixture {
  double nats;
  Meanings probabilities;
};

Mixture Mix(const Meanings& nats) {
  const double least = std::ranges::min(nats);
  Mixture mixture{};
  double sum = 0;
  for (std::size_t i = 0; i < nats.size(); ++i)
    sum += mixture.probabilities[i] = std::exp(least - nats[i]);
  for (double& probability : mixture.probabilities) probability /= sum;
  mixture.nats = least - std::log(sum);
  return mixture;
}

// Two directions across a line of sight.
std::array<Vector3, 2> Across(const Vector3& direction_W) {
  const Vector3 one_W = direction_W.unitOrthogonal();
  return {one_W, direction_W.cross(one_W)};
}

// Pulls a landmark to a line of sight, with the derivative of its -log p.
void Pull(const KeypointRay& ray, Landmark landmark, double scale_mm, double worth,
          const PosedLandmarks& landmarks, Linearisation& sums) {
  constexpr double kNothing = 1e-6;
  if (worth < kNothing) return;
  const Offset offset = landmarks.From(ray, landmark);
  const double variance_mm2 = kKeypointNoise.freedom * scale_mm * scale_mm *
                              (1 + ScaledSquare(offset.across_W, scale_mm)) /
                              ((kKeypointNoise.freedom + 2) * worth);
  for (const Vector3& direction_W : Across(ray.direction_W))
    sums.chain.Add(landmarks.CarrierOf(landmark), offset.p_W, direction_W,
                   -offset.across_W.dot(direction_W), variance_mm2);
}

}  // namespace

double KeypointTerm::NatsOf(const KeypointRays& view, const PosedBody& posed) {
  return Mix(NatsByMeaning(view, PosedLandmarks(posed))).nats;
}

double KeypointTerm::ProbabilityOfRight(const KeypointRays& view, const PosedBody& posed) {
  return Mix(NatsByMeaning(view, PosedLandmarks(posed))).probabilities[kRight];
}

double KeypointTerm::ProbabilityOfElsewhere(const KeypointRays& view, const PosedBody& posed) {
  return Mix(NatsByMeaning(view, PosedLandmarks(posed))).probabilities[kElsewhere];
}

double KeypointTerm::At(const PosedBody& posed) const {
  if (views_.empty()) return 0;
  const PosedLandmarks landmarks(posed);
  double nats = 0;
  for (const KeypointRays& view : views_)
    nats += view.worth * Mix(NatsByMeaning(view, landmarks)).nats;
  return nats;
}

void KeypointTerm::Linearize(const PosedBody& posed, Linearisation& sums) const {
  if (views_.empty()) return;
  const PosedLandmarks landmarks(posed);
  for (const KeypointRays& view : views_) {
    const Meanings meant = Mix(NatsByMeaning(view, landmarks)).probabilities;
    const double worth = view.worth * ShareOf(view);
    for (const KeypointRay& ray : view.rays) {
      const double scale_mm = KeypointScale_mm(ray.landmark, ray.score);
      Pull(ray, ray.landmark, scale_mm, worth * meant[kRight], landmarks, sums);
      Pull(ray, Mirrored(ray.landmark), scale_mm, worth * meant[kExchanged], landmarks, sums);
    }
  }
}

void KeypointTerm::PullAsRight(const KeypointRays& view, double width, const PosedBody& posed,
                               Linearisation& sums) {
  const PosedLandmarks landmarks(posed);
  for (const KeypointRay& ray : view.rays)
    Pull(ray, ray.landmark, width * KeypointScale_mm(ray.landmark, ray.score), ShareOf(view),
         landmarks, sums);
}

}  // namespace mocap
