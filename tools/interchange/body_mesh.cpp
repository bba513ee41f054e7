#include "tools/interchange/body_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/body/body_shape.h"
#include "tools/kinematics/rest_body.h"

namespace mocap {
namespace {

constexpr int kAround = 16;
constexpr int kRingsOfCap = 5;

/// The joint that moves a capsule, by the carrying axis in the body table.
SkeletonJoint JointOf(const Capsule& capsule, const BodyTable& table) {
  using enum SkeletonJoint;
  const auto is_carried_by = [&](Segment segment) {
    return capsule.carrier == table.carrier[static_cast<int>(segment)];
  };
  switch (capsule.part) {
    case BodyPart::kHead:
      return kHead;
    case BodyPart::kUpperArmL:
      return kLeftArm;
    case BodyPart::kUpperArmR:
      return kRightArm;
    case BodyPart::kLowerArmL:
      return is_carried_by(Segment::kLowerArmL) ? kLeftForeArm : kLeftHand;
    case BodyPart::kLowerArmR:
      return is_carried_by(Segment::kLowerArmR) ? kRightForeArm : kRightHand;
    case BodyPart::kThighL:
      return kLeftUpLeg;
    case BodyPart::kThighR:
      return kRightUpLeg;
    case BodyPart::kCalfL:
      if (is_carried_by(Segment::kCalfL)) return kLeftLeg;
      return is_carried_by(Segment::kFootL) ? kLeftFoot : kLeftToe;
    case BodyPart::kCalfR:
      if (is_carried_by(Segment::kCalfR)) return kRightLeg;
      return is_carried_by(Segment::kFootR) ? kRightFoot : kRightToe;
    case BodyPart::kTorso:
      break;
  }
  if (is_carried_by(Segment::kTorso)) return kSpine;
  if (is_carried_by(Segment::kPelvis)) return kHips;
  return is_carried_by(Segment::kShoulderL) ? kLeftShoulder : kRightShoulder;
}

/// A capsule's surface consists of two balls and the cone tangent to both. Each point is at the
/// ball's radius from one of the centres, along the normal.
class CapsuleSurface {
 public:
  CapsuleSurface(const Capsule& capsule, SkeletonJoint joint, BodyMesh& mesh)
      : capsule_(capsule), joint_(joint), mesh_(mesh) {
    const Vector3 core = capsule.b_T - capsule.a_T;
    length_ = core.norm();
    axis_ = length_ > 0 ? Vector3(core / length_) : Vector3::UnitZ();
    aside_ = axis_.unitOrthogonal();
  }

  void Add() {
    // If one ball is inside the other, only the larger is visible.
    const double slope = (capsule_.radius_a_mm - capsule_.radius_b_mm) / std::max(length_, 1e-9);
    const double seam = std::asin(std::clamp(slope, -1.0, 1.0));
    const std::size_t first = mesh_.vertices.size();
    for (int i = 0; i <= kRingsOfCap; ++i) {
      AddRing(capsule_.a_T, capsule_.radius_a_mm, Between(-EIGEN_PI / 2, seam, i));
    }
    for (int i = 0; i <= kRingsOfCap; ++i) {
      AddRing(capsule_.b_T, capsule_.radius_b_mm, Between(seam, EIGEN_PI / 2, i));
    }
    for (std::size_t ring = first; ring + kAround < mesh_.vertices.size(); ring += kAround) {
      AddBand(ring);
    }
  }

 private:
  static double Between(double from, double to, int ring) {
    return from + (to - from) * ring / kRingsOfCap;
  }
  void AddRing(const Vector3& centre, double radius, double elevation) {
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * EIGEN_PI * i / kAround;
      const Vector3 out = std::cos(angle) * aside_ + std::sin(angle) * axis_.cross(aside_);
      const Vector3 normal = std::sin(elevation) * axis_ + std::cos(elevation) * out;
      mesh_.vertices.push_back({centre + radius * normal, normal, joint_});
    }
  }
  void AddBand(std::size_t ring) {
    const auto index = [&](std::size_t i) { return static_cast<std::uint16_t>(ring + i); };
    for (std::size_t i = 0; i < kAround; ++i) {
      const std::size_t next = (i + 1) % kAround;
      mesh_.triangles.push_back({index(i), index(next), index(kAround + i)});
      mesh_.triangles.push_back({index(next), index(kAround + next), index(kAround + i)});
    }
  }

  const Capsule& capsule_;
  const SkeletonJoint joint_;
  BodyMesh& mesh_;
  double length_;
  Vector3 axis_, aside_;
};

}  // namespace

BodyMesh MakeBodyMesh(const BodyRecord& body) {
  const RestBody rest(body);
  std::vector<Capsule> capsules;
  BuildShape(rest.table(), rest.sizes(), rest.places_T(), capsules);
  BodyMesh mesh;
  for (const Capsule& capsule : capsules) {
    CapsuleSurface(capsule, JointOf(capsule, rest.table()), mesh).Add();
  }
  return mesh;
}

}  // namespace mocap
