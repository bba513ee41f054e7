#include "core/tracking/contact_matcher.h"

#include <algorithm>
#include <cmath>

#include "core/vectorized.h"

namespace mocap {
namespace {

// A place on the inside of the left leg is no evidence for the right one: surfaces that face
// square to each other count as this far apart.
constexpr float kSquare_mm = 40;
// Lengths are no less, so that nothing is divided by zero.
constexpr float kLeastSq_mm2 = 1e-3f;
constexpr float kParallel = 1e-4f;

struct Contacts {
  const float *from_x, *from_y, *from_z;
  const float *along_x, *along_y, *along_z, *along_sq;
  const float *outward_x, *outward_y, *outward_z;
};

struct SlimCapsule {
  explicit SlimCapsule(const PosedCapsule& capsule)
      : a(capsule.a_W.cast<float>()),
        core((capsule.b_W - capsule.a_W).cast<float>()),
        core_sq(std::max(core.squaredNorm(), kLeastSq_mm2)),
        radius(static_cast<float>(capsule.radius_a_mm)),
        taper(static_cast<float>(capsule.radius_b_mm - capsule.radius_a_mm)) {}

  Eigen::Vector3f a, core;
  float core_sq, radius, taper;
};

inline float Clamped(float x) { return x < 0 ? 0 : x > 1 ? 1 : x; }

// Closest places of two segments (Ericson 2005, §5.1.9), without branches.
MOCAP_VECTORIZED
void TryCapsule(const Contacts& contacts, int count, const SlimCapsule& capsule, int index,
                float* mismatch, std::int32_t* best) {
  const float ax = capsule.a.x(), ay = capsule.a.y(), az = capsule.a.z();
  const float cx = capsule.core.x(), cy = capsule.core.y(), cz = capsule.core.z();
  const float core_sq = capsule.core_sq, radius = capsule.radius, taper = capsule.taper;
  const float per_core_sq = 1 / core_sq;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float lx = contacts.along_x[i], ly = contacts.along_y[i], lz = contacts.along_z[i];
    const float bx = ax - contacts.from_x[i], by = ay - contacts.from_y[i],
                bz = az - contacts.from_z[i];
    const float along_sq = contacts.along_sq[i];
    const float dot = cx * lx + cy * ly + cz * lz;
    const float c = cx * bx + cy * by + cz * bz;
    const float f = lx * bx + ly * by + lz * bz;
    const float slant = core_sq * along_sq - dot * dot;
    const float least = kParallel * core_sq * along_sq;
    const float first = Clamped((dot * f - c * along_sq) / (slant > least ? slant : least));
    const float on_segment = Clamped((dot * first + f) / along_sq);
    const float share = Clamped((dot * on_segment - c) * per_core_sq);
    const float x = on_segment * lx - bx - share * cx;
    const float y = on_segment * ly - by - share * cy;
    const float z = on_segment * lz - bz - share * cz;
    const float length = std::sqrt(x * x + y * y + z * z);
    const float apart = std::abs(length - radius - share * taper);
    const float facing =
        (contacts.outward_x[i] * x + contacts.outward_y[i] * y + contacts.outward_z[i] * z) /
        (length + 1);
    const float value = apart + kSquare_mm * (1 - facing);
    const bool is_better = value < mismatch[i];
    best[i] = is_better ? index : best[i];
    mismatch[i] = is_better ? value : mismatch[i];
  }
}

void Resize(std::array<std::vector<float>, 3>& columns, std::size_t count) {
  for (auto& column : columns) column.resize(count);
}

}  // namespace

void ContactMatcher::SetContacts(std::span<const Contact> contacts) {
  contacts_.assign(contacts.begin(), contacts.end());
  for (auto* columns : {&from_, &along_, &outward_}) Resize(*columns, contacts.size());
  along_sq_.resize(contacts.size());
  mismatch_.resize(contacts.size());
  best_.resize(contacts.size());
  matches_.resize(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = contacts[i];
    for (int axis = 0; axis < 3; ++axis) {
      from_[axis][i] = static_cast<float>(contact.from_W[axis]);
      along_[axis][i] = static_cast<float>(contact.to_W[axis] - contact.from_W[axis]);
      outward_[axis][i] = static_cast<float>(contact.outward_W[axis]);
    }
    along_sq_[i] =
        std::max(static_cast<float>((contact.to_W - contact.from_W).squaredNorm()), kLeastSq_mm2);
  }
}

const std::vector<ContactMatch>& ContactMatcher::Match(std::span<const PosedCapsule> capsules,
                                                       double reach_mm) {
  const Contacts columns{from_[0].data(),   from_[1].data(),    from_[2].data(),
                         along_[0].data(),  along_[1].data(),   along_[2].data(),
                         along_sq_.data(),  outward_[0].data(), outward_[1].data(),
                         outward_[2].data()};
  std::ranges::fill(mismatch_, static_cast<float>(reach_mm));
  std::ranges::fill(best_, -1);
  for (int k = 0; k < std::ssize(capsules); ++k) {
    TryCapsule(columns, static_cast<int>(contacts_.size()), SlimCapsule(capsules[k]), k,
               mismatch_.data(), best_.data());
  }
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    matches_[i].capsule = best_[i];
    if (best_[i] < 0) continue;
    matches_[i].distance = capsules[best_[i]].DistanceTo(contacts_[i].from_W, contacts_[i].to_W);
  }
  return matches_;
}

}  // namespace mocap
