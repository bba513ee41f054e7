#include "core/people/outline_division.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mocap {
namespace {

// Beyond this mismatch a body certainly does not explain a ray.
constexpr double kSurelyNotMm = 1.5 * kExplainsMm;
// A camera with this many rays of a person shows that person.
constexpr int kRaysThatShow = 6;

// How far a ray passes from a body's surface. One of the opposite direction is not explained.
double MismatchOf(const GrazingRay& ray, const LineRange& range, const PosedPerson& person) {
  const Vector3 from_W = ray.eye_W + range.from_mm * ray.direction_W;
  const Vector3 to_W = ray.eye_W + range.to_mm * ray.direction_W;
  double least_mm = std::numeric_limits<double>::infinity();
  for (const PosedCapsule& capsule : person.capsules) {
    const double aside_mm = (capsule.middle_W - ray.eye_W).cross(ray.direction_W).norm();
    if (aside_mm - capsule.reach_mm >= least_mm) continue;
    const auto distance = capsule.DistanceTo(from_W, to_W);
    const Vector3 offset = distance.segment_W - distance.core_W;
    const double facing = offset.dot(ray.outward_W) / (offset.norm() + 1);
    least_mm = std::min(least_mm, std::abs(distance.outside_mm) + kExplainsMm / 2 * (1 - facing));
  }
  return least_mm;
}

// Whether a ray grazes flesh or passes through it.
bool Touches(const GrazingRay& ray, const FleshShare& share) {
  // As shares of a voxel: the step along the ray, and the offset of the test line towards the
  // inside.
  constexpr double kStep = 0.8, kInward = 0.7;
  const VoxelGrid& flesh = share.flesh;
  const Vector3 eye_W = ray.eye_W - kInward * flesh.voxel_mm() * ray.outward_W;
  const auto range = RangeWithin(share.box_W, eye_W, ray.direction_W);
  if (!range) return false;
  const Vector3 begin_W = eye_W + range->from_mm * ray.direction_W;
  Vector3 place = (begin_W - flesh.origin_W()) / flesh.voxel_mm();
  const double step_mm = kStep * flesh.voxel_mm();
  for (double mm = range->from_mm; mm < range->to_mm; mm += step_mm) {
    const Eigen::Vector3i at = place.array().floor().cast<int>();
    if (flesh.Contains(at.x(), at.y(), at.z()) && flesh.Test(at.x(), at.y(), at.z())) return true;
    place += kStep * ray.direction_W;
  }
  return false;
}

}  // namespace

void OutlineDivision::Divide(std::span<const Outline> outlines, std::span<const PosedPerson> people,
                             const FleshDivision& flesh) {
  boxes_W_.clear();
  for (const PosedPerson& person : people) boxes_W_.push_back(person.box_W);
  for (const FleshShare& stranger : flesh.strangers())
    boxes_W_.push_back(AroundStranger(stranger.box_W));
  shares_.resize(boxes_W_.size());
  for (OutlineShare& share : shares_) {
    share.cameras = 0;
    for (std::vector<Outline>* const rays : {&share.own, &share.near}) {
      rays->resize(outlines.size());
      for (Outline& outline : *rays) outline.clear();
    }
  }
  for (std::size_t camera = 0; camera < outlines.size(); ++camera) {
    sole_.assign(shares_.size(), 0);
    for (const GrazingRay& ray : outlines[camera]) DivideRay(ray, camera, people, flesh);
    for (std::size_t i = 0; i < shares_.size(); ++i)
      shares_[i].cameras += sole_[i] >= kRaysThatShow;
  }
}

void OutlineDivision::DivideRay(const GrazingRay& ray, std::size_t camera,
                                std::span<const PosedPerson> people, const FleshDivision& flesh) {
  passed_.clear();
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    const auto range = RangeWithin(boxes_W_[i], ray.eye_W, ray.direction_W);
    if (!range) continue;
    passed_.push_back({i, *range});
    shares_[i].near[camera].push_back(ray);
  }
  for (Passed& passed : passed_) {
    if (passed_.size() == 1) break;
    // A stranger's body is unknown.
    if (passed.share < people.size())
      passed.mismatch_mm = MismatchOf(ray, passed.range, people[passed.share]);
    passed.touches = Touches(ray, flesh.shares()[passed.share]);
  }
  Assign(ray, camera, people.size());
}

// Gives a ray to whom it grazes best, among those whose flesh it touches. A ray that may be
// another's does not count as showing anybody, but a stranger takes none from a known person.
void OutlineDivision::Assign(const GrazingRay& ray, std::size_t camera, std::size_t people) {
  const auto best = std::ranges::min_element(passed_, {}, [](const Passed& passed) {
    return std::pair(!passed.touches, passed.mismatch_mm);
  });
  const auto is_unexplained = [](const Passed& passed) { return passed.mismatch_mm > kExplainsMm; };
  if (best == passed_.end() || (!best->touches && is_unexplained(*best))) return;
  bool is_shared = false;
  for (auto passed = passed_.begin(); passed != passed_.end(); ++passed) {
    const bool is_known = passed->share < people;
    const bool is_lost_limbs = is_unexplained(*best) && passed->touches && is_known;
    if (passed == best || is_lost_limbs) shares_[passed->share].own[camera].push_back(ray);
    is_shared |= passed != best && passed->mismatch_mm <= kSurelyNotMm &&
                 (is_known || best->share >= people);
  }
  sole_[best->share] += !is_shared;
}

}  // namespace mocap
