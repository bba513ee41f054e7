#include "tools/interchange/bvh_writer.h"

#include <fmt/format.h>

#include <array>
#include <ostream>
#include <string>

#include "core/degrees.h"
#include "tools/interchange/people_times.h"
#include "tools/interchange/skeleton_motion.h"
#include "tools/kinematics/euler_zxy.h"
#include "tools/results/export_axes.h"
#include "tools/results/fixed_text.h"

namespace mocap {
namespace {

constexpr double kCmPerMm = 0.1;

std::string Numbers(const Vector3& v, int decimals) {
  return FixedText(v.x(), decimals) + ' ' + FixedText(v.y(), decimals) + ' ' +
         FixedText(v.z(), decimals);
}

std::string Offset(const Vector3& offset_mm) {
  const Vector3 cm = kCmPerMm * (YUpFromWorld() * offset_mm);
  return "OFFSET " + Numbers(cm, 4) + '\n';
}

/// Lists what BVH cannot represent.
/// @param before_s  time that others were tracked before this person.
ExportRemarks RemarksOn(const SkeletonMotion& motion, double before_s) {
  ExportRemarks remarks;
  if (before_s > 0) {
    remarks.push_back(
        fmt::format("not tracked in the first {:.2f} s, which show the first pose", before_s));
  }
  if (motion.skipped_frames > 0) {
    remarks.push_back(
        fmt::format("frames before the first tracked one, left out: {}", motion.skipped_frames));
  }
  if (motion.held_frames > 0) {
    remarks.push_back(fmt::format("frames missing or not tracked, which repeat the last pose: {}",
                                  motion.held_frames));
  }
  if (motion.worst_mm > 1) {
    remarks.push_back(
        fmt::format("bones change their length in this result and are constant in BVH: joints are "
                    "off by up to {:.1f} mm",
                    motion.worst_mm));
  }
  return remarks;
}

void WriteHierarchy(const JointOffsets& bones, int joint, int depth, std::ostream& out) {
  const std::string indent(depth, '\t');
  const SkeletonJointInfo& info = kSkeletonJoints[joint];
  if (info.is_end) {
    out << indent << "End Site\n";
  } else {
    out << indent << (joint == 0 ? "ROOT " : "JOINT ") << info.name << '\n';
  }
  out << indent << "{\n" << indent << '\t' << Offset(bones[joint]);
  if (!info.is_end) {
    out << indent << '\t'
        << (joint == 0 ? "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
                       : "CHANNELS 3 Zrotation Xrotation Yrotation\n");
  }
  for (int child = joint + 1; child < kSkeletonJointCount; ++child) {
    if (kSkeletonJoints[child].parent == joint) WriteHierarchy(bones, child, depth + 1, out);
  }
  out << indent << "}\n";
}

void WriteMotion(const SkeletonMotion& motion, std::ostream& out) {
  out << fmt::format("MOTION\nFrames: {}\nFrame Time: {:.6f}\n", motion.frames.size(),
                     motion.period_s);
  const Matrix3 R_YW = YUpFromWorld();
  JointOffsets last;
  last.fill(Vector3::Zero());
  for (const SkeletonPose& pose : motion.frames) {
    std::string line = Numbers(kCmPerMm * (R_YW * pose.offset[0]), 4);
    for (int i = 0; i < kSkeletonJointCount; ++i) {
      if (kSkeletonJoints[i].is_end) continue;
      last[i] = NearestEquivalent(AnglesZxy(R_YW * pose.R[i] * R_YW.transpose()), last[i]);
      line += ' ' + Numbers(kDegreesPerRad * last[i], 5);
    }
    out << line << '\n';
  }
}

}  // namespace

ExportRemarks WriteBvh(const ExportScene& scene, std::ostream& out) {
  const ExportSubject& subject = scene.subjects.front();
  const bool is_alone = subject.name.empty();
  const SkeletonMotion motion = MakeSkeletonMotion(
      is_alone ? subject.result : HoldingFirstPose(subject.result, scene.moments));
  out << "HIERARCHY\n";
  WriteHierarchy(motion.bones, 0, 0, out);
  WriteMotion(motion, out);
  return RemarksOn(motion, is_alone ? 0 : SecondsBeforeFirstPose(subject.result, scene.moments));
}

}  // namespace mocap
