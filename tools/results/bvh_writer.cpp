#include "tools/results/bvh_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>

#include "tools/results/export_axes.h"
#include "tools/results/fixed_text.h"

namespace mocap {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kCmPerMm = 0.1;

/// Angles z, x, y of R = Rz Rx Ry [rad].
Vector3 AnglesZxy(const Matrix3& R) {
  const double x = std::asin(std::clamp(R(2, 1), -1.0, 1.0));
  // At the lock only the sum or difference of z and y counts.
  if (std::abs(R(2, 1)) > 1 - 1e-12) return {std::atan2(R(1, 0), R(0, 0)), x, 0};
  return {std::atan2(-R(0, 1), R(1, 1)), x, std::atan2(-R(2, 0), R(2, 2))};
}

/// Of all angles that mean the same rotation, those nearest to the last frame's.
Vector3 NearestEquivalent(const Vector3& angles, const Vector3& last) {
  const auto near_last = [&](const Vector3& a) {
    Vector3 moved;
    for (int i = 0; i < 3; ++i) moved[i] = last[i] + std::remainder(a[i] - last[i], 2 * kPi);
    return moved;
  };
  const Vector3 first = near_last(angles);
  const Vector3 second = near_last({angles[0] + kPi, kPi - angles[1], angles[2] + kPi});
  return (first - last).squaredNorm() <= (second - last).squaredNorm() ? first : second;
}

std::string Numbers(const Vector3& v, int decimals) {
  return FixedText(v.x(), decimals) + ' ' + FixedText(v.y(), decimals) + ' ' +
         FixedText(v.z(), decimals);
}

std::string Offset(const Vector3& offset_mm) {
  const Vector3 cm = kCmPerMm * (YUpFromWorld() * offset_mm);
  return "OFFSET " + Numbers(cm, 4) + '\n';
}

void WriteJoint(const BvhSkeleton& skeleton, int joint, int depth, std::ostream& out) {
  const std::string indent(depth, '\t');
  out << indent << (joint == 0 ? "ROOT " : "JOINT ") << kBvhJoints[joint].name << '\n'
      << indent << "{\n"
      << indent << '\t' << Offset(skeleton.offset[joint]) << indent << '\t'
      << (joint == 0 ? "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
                     : "CHANNELS 3 Zrotation Xrotation Yrotation\n");
  bool has_child = false;
  for (int child = joint + 1; child < kBvhJointCount; ++child) {
    if (kBvhJoints[child].parent != joint) continue;
    has_child = true;
    WriteJoint(skeleton, child, depth + 1, out);
  }
  if (!has_child) {
    out << indent << "\tEnd Site\n"
        << indent << "\t{\n"
        << indent << "\t\t" << Offset(skeleton.end[joint]) << indent << "\t}\n";
  }
  out << indent << "}\n";
}

}  // namespace

void WriteBvh(const BvhMotion& motion, std::ostream& out) {
  out << "HIERARCHY\n";
  WriteJoint(motion.skeleton, 0, 0, out);
  out << fmt::format("MOTION\nFrames: {}\nFrame Time: {:.6f}\n", motion.frames.size(),
                     motion.period_s);
  const Matrix3 R_YW = YUpFromWorld();
  std::array<Vector3, kBvhJointCount> last;
  last.fill(Vector3::Zero());
  for (const BvhPose& pose : motion.frames) {
    const Vector3 hips_cm = kCmPerMm * (R_YW * pose.p_WHips);
    std::string line = Numbers(hips_cm, 4);
    for (int i = 0; i < kBvhJointCount; ++i) {
      last[i] = NearestEquivalent(AnglesZxy(R_YW * pose.R[i] * R_YW.transpose()), last[i]);
      line += ' ' + Numbers(last[i] * 180 / kPi, 5);
    }
    out << line << '\n';
  }
}

}  // namespace mocap
