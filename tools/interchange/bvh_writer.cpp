#include "tools/interchange/bvh_writer.h"

#include <fmt/format.h>

#include <iterator>
#include <ostream>
#include <string>

#include "core/degrees.h"
#include "tools/interchange/people_times.h"
#include "tools/interchange/skeleton_motion.h"
#include "tools/kinematics/euler_angles.h"
#include "tools/results/fixed_text.h"

namespace mocap {
namespace {

constexpr double kCmPerMm = 0.1;

std::string Numbers(const Vector3& v, int decimals) {
  return FixedText(v.x(), decimals) + ' ' + FixedText(v.y(), decimals) + ' ' +
         FixedText(v.z(), decimals);
}

std::string Offset(const Vector3& offset_mm) {
  return "OFFSET " + Numbers(kCmPerMm * offset_mm, 4) + '\n';
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

std::string Channels(const Skeleton& skeleton, bool is_root) {
  std::string text = is_root ? "CHANNELS 6 Xposition Yposition Zposition" : "CHANNELS 3";
  for (const char axis : skeleton.rotations) text += fmt::format(" {}rotation", axis);
  return text + '\n';
}

void WriteHierarchy(const Skeleton& skeleton, const JointOffsets& bones, int joint, int depth,
                    std::ostream& out) {
  const std::string indent(depth, '\t');
  const SkeletonJointInfo& info = skeleton.joints[joint];
  if (info.is_end) {
    out << indent << "End Site\n";
  } else {
    out << indent << (joint == 0 ? "ROOT " : "JOINT ") << info.name << '\n';
  }
  out << indent << "{\n" << indent << '\t' << Offset(bones[joint]);
  if (!info.is_end) out << indent << '\t' << Channels(skeleton, joint == 0);
  for (int child = joint + 1; child < std::ssize(skeleton.joints); ++child) {
    if (skeleton.joints[child].parent == joint)
      WriteHierarchy(skeleton, bones, child, depth + 1, out);
  }
  out << indent << "}\n";
}

void WriteMotion(const Skeleton& skeleton, const SkeletonMotion& motion, std::ostream& out) {
  out << fmt::format("MOTION\nFrames: {}\nFrame Time: {:.6f}\n", motion.frames.size(),
                     motion.period_s);
  const auto angles_of = skeleton.rotations == "ZYX" ? AnglesZyx : AnglesZxy;
  JointOffsets last(skeleton.joints.size(), Vector3::Zero());
  for (const SkeletonPose& pose : motion.frames) {
    std::string line = Numbers(kCmPerMm * pose.offset[0], 4);
    for (std::size_t i = 0; i < last.size(); ++i) {
      if (skeleton.joints[i].is_end) continue;
      last[i] = NearestEquivalent(angles_of(pose.R[i]), last[i]);
      line += ' ' + Numbers(kDegreesPerRad * last[i], 5);
    }
    out << line << '\n';
  }
}

}  // namespace

ExportRemarks WriteBvh(const ExportScene& scene, std::ostream& out) {
  const ExportSubject& subject = scene.subjects.front();
  const Skeleton& skeleton = *scene.skeleton;
  const bool is_alone = subject.name.empty();
  const SkeletonMotion motion = MakeSkeletonMotion(
      is_alone ? subject.result : HoldingFirstPose(subject.result, scene.moments), skeleton);
  out << "HIERARCHY\n";
  WriteHierarchy(skeleton, motion.bones, 0, 0, out);
  WriteMotion(skeleton, motion, out);
  return RemarksOn(motion, is_alone ? 0 : SecondsBeforeFirstPose(subject.result, scene.moments));
}

}  // namespace mocap
