#include "core/people/outline_division.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mocap {
namespace {

// Perpendicular surfaces count as this far apart, as in a fit.
constexpr double kSquareMm = 40;
// Beyond this mismatch a body certainly does not explain a ray.
constexpr double kSurelyNotMm = 120;
// Longer than any room.
constexpr double kFarMm = 30000;
// A camera with this many rays of a person shows that person.
constexpr int kRaysOfWitness = 6;

bool Passes(const GrazingRay& ray, const Eigen::AlignedBox3d& box_W) {
  const Vector3 a = (box_W.min() - ray.eye_W).cwiseQuotient(ray.direction_W);
  const Vector3 b = (box_W.max() - ray.eye_W).cwiseQuotient(ray.direction_W);
  return std::max(0.0, a.cwiseMin(b).maxCoeff()) < a.cwiseMax(b).minCoeff();
}

double MismatchOf(const GrazingRay& ray, const PosedPerson& person) {
  double least_mm = std::numeric_limits<double>::infinity();
  for (const PosedCapsule& capsule : person.capsules) {
    const Vector3 to_middle = capsule.middle_W - ray.eye_W;
    const double aside_mm = to_middle.cross(ray.direction_W).norm();
    if (aside_mm - capsule.reach_mm >= least_mm) continue;
    const auto distance = capsule.DistanceTo(ray.eye_W, ray.eye_W + kFarMm * ray.direction_W);
    const Vector3 offset = distance.segment_W - distance.core_W;
    const double facing = offset.dot(ray.outward_W) / (offset.norm() + 1);
    least_mm = std::min(least_mm, std::abs(distance.outside_mm) + kSquareMm * (1 - facing));
  }
  return least_mm;
}

}  // namespace

void OutlineDivision::Divide(std::span<const Outline> outlines, std::span<const PosedPerson> people,
                             const FleshDivision& flesh) {
  shares_.resize(people.size() + flesh.strangers().size());
  sole_.resize(shares_.size());
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    shares_[i].own.resize(outlines.size());
    shares_[i].near.resize(outlines.size());
    for (Outline& outline : shares_[i].own) outline.clear();
    for (Outline& outline : shares_[i].near) outline.clear();
    sole_[i].assign(outlines.size(), 0);
  }
  for (std::size_t camera = 0; camera < outlines.size(); ++camera)
    for (const GrazingRay& ray : outlines[camera]) DivideRay(ray, camera, people, flesh);
  CountWitnesses();
}

void OutlineDivision::DivideRay(const GrazingRay& ray, std::size_t camera,
                                std::span<const PosedPerson> people, const FleshDivision& flesh) {
  passed_.clear();
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    const Eigen::AlignedBox3d box_W =
        i < people.size() ? people[i].box_W
                          : AroundStranger(flesh.strangers()[i - people.size()].box_W);
    if (!Passes(ray, box_W)) continue;
    passed_.push_back({i, 0, true});
    shares_[i].near[camera].push_back(ray);
  }
  const Passed* const owner = OwnerOf(ray, people, flesh);
  if (!owner) return;
  shares_[owner->share].own[camera].push_back(ray);
  if (owner->mismatch_mm > kExplainsMm) ShareAmongTouched(ray, camera, *owner, people.size());
  // A stranger's body is unknown: it takes no witness from a known person.
  const bool is_known = owner->share < people.size();
  const bool is_shared = std::ranges::any_of(passed_, [&](const Passed& passed) {
    return &passed != owner && passed.mismatch_mm <= kSurelyNotMm &&
           (!is_known || passed.share < people.size());
  });
  sole_[owner->share][camera] += !is_shared;
}

// Rays that no body explains may graze a lost limb: they go to all people whose flesh they touch.
void OutlineDivision::ShareAmongTouched(const GrazingRay& ray, std::size_t camera,
                                        const Passed& owner, std::size_t people) {
  for (const Passed& passed : passed_) {
    if (&passed != &owner && passed.touches && passed.share < people)
      shares_[passed.share].own[camera].push_back(ray);
  }
}

const OutlineDivision::Passed* OutlineDivision::OwnerOf(const GrazingRay& ray,
                                                        std::span<const PosedPerson> people,
                                                        const FleshDivision& flesh) {
  if (passed_.size() == 1) return &passed_.front();
  const Passed* owner = nullptr;
  for (Passed& passed : passed_) {
    passed.touches = flesh.Touches(passed.share, ray);
    // A stranger's body is unknown.
    passed.mismatch_mm =
        passed.share < people.size() ? MismatchOf(ray, people[passed.share]) : kExplainsMm;
    if (!passed.touches && passed.mismatch_mm > kExplainsMm) continue;
    const bool is_better =
        !owner || passed.touches > owner->touches ||
        (passed.touches == owner->touches && passed.mismatch_mm < owner->mismatch_mm);
    if (is_better) owner = &passed;
  }
  return owner;
}

void OutlineDivision::CountWitnesses() {
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    shares_[i].witnesses = static_cast<int>(
        std::ranges::count_if(sole_[i], [](int rays) { return rays >= kRaysOfWitness; }));
  }
}

}  // namespace mocap
