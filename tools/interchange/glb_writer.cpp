#include "tools/interchange/glb_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ostream>
#include <vector>

#include "drivers/printable_text.h"
#include "tools/interchange/body_mesh.h"
#include "tools/interchange/gltf_buffer.h"
#include "tools/interchange/skeleton_motion.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

using Json = nlohmann::ordered_json;

/// A joint that moves less within the skeleton needs no translation curve.
constexpr double kMoved_mm = 0.05;
constexpr double kMetresPerMm = 1e-3;

void Append(const Vector3& v, std::vector<float>& floats) {
  for (const double value : v) floats.push_back(static_cast<float>(value));
}

Json JsonOf(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

/// With joints at rest, and the feet on the floor below the origin.
Json Nodes(const SkeletonMotion& motion, const JointOffsets& rest) {
  Json nodes = Json::array();
  const auto joints = MocapdSkeleton().joints;
  const double sole_mm = rest[static_cast<int>(SkeletonJoint::kLeftToeEnd)].y();
  for (int i = 0; i < kSkeletonJointCount; ++i) {
    const SkeletonJointInfo& info = joints[i];
    const Vector3 place = info.parent < 0 ? Vector3(0, rest[i].y() - sole_mm, 0) : motion.bones[i];
    Json node = {{"name", info.name}, {"translation", JsonOf(kMetresPerMm * place)}};
    for (int child = i + 1; child < kSkeletonJointCount; ++child) {
      if (joints[child].parent == i) node["children"].push_back(child);
    }
    nodes.push_back(std::move(node));
  }
  return nodes;
}

Json Mesh(const BodyRecord& body, GltfBuffer& buffer) {
  const BodyMesh mesh = MakeBodyMesh(body);
  std::vector<float> positions, normals;
  std::vector<std::uint8_t> joints, weights;
  for (const MeshVertex& vertex : mesh.vertices) {
    Append(kMetresPerMm * (YUpFromWorld() * vertex.p_T), positions);
    Append(YUpFromWorld() * vertex.normal_T, normals);
    joints.insert(joints.end(), {static_cast<std::uint8_t>(vertex.joint), 0, 0, 0});
    weights.insert(weights.end(), {255, 0, 0, 0});
  }
  std::vector<std::uint16_t> indices;
  for (const auto& triangle : mesh.triangles) {
    indices.insert(indices.end(), triangle.begin(), triangle.end());
  }
  const Json attributes = {{"POSITION", buffer.AddFloats(positions, "VEC3", GltfBuffer::kVertices)},
                           {"NORMAL", buffer.AddFloats(normals, "VEC3", GltfBuffer::kVertices)},
                           {"JOINTS_0", buffer.AddBytes(joints, false)},
                           {"WEIGHTS_0", buffer.AddBytes(weights, true)}};
  const Json primitive = {
      {"attributes", attributes}, {"indices", buffer.AddIndices(indices)}, {"material", 0}};
  return {{"name", "Body"}, {"primitives", Json::array({primitive})}};
}

/// The mesh is bound to joints without rotation at rest.
int InverseBindMatrices(const JointOffsets& rest, GltfBuffer& buffer) {
  std::vector<float> columns;
  for (const Vector3& place : rest) {
    Eigen::Matrix4f inverse = Eigen::Matrix4f::Identity();
    inverse.topRightCorner<3, 1>() = (-kMetresPerMm * place).cast<float>();
    columns.insert(columns.end(), inverse.data(), inverse.data() + inverse.size());
  }
  return buffer.AddFloats(columns, "MAT4");
}

class Animation {
 public:
  Animation(const SkeletonMotion& motion, std::int64_t first_ns, GltfBuffer& buffer)
      : motion_(motion), buffer_(buffer) {
    std::vector<float> times;
    for (const SkeletonPose& pose : motion.frames) {
      times.push_back(static_cast<float>(1e-9 * static_cast<double>(pose.time_ns - first_ns)));
    }
    times_ = buffer.AddFloats(times, "SCALAR");
    for (int joint = 0; joint < kSkeletonJointCount; ++joint) {
      if (Moves(joint)) AddChannel(joint, "translation", Translations(joint), "VEC3");
      if (!MocapdSkeleton().joints[joint].is_end)
        AddChannel(joint, "rotation", Rotations(joint), "VEC4");
    }
  }

  Json Take(const std::string& name) {
    return {{"name", name}, {"channels", std::move(channels_)}, {"samplers", std::move(samplers_)}};
  }

 private:
  bool Moves(int joint) const {
    return std::ranges::any_of(motion_.frames, [&](const SkeletonPose& pose) {
      return (pose.offset[joint] - motion_.bones[joint]).norm() > kMoved_mm;
    });
  }
  std::vector<float> Translations(int joint) const {
    std::vector<float> values;
    for (const SkeletonPose& pose : motion_.frames)
      Append(kMetresPerMm * pose.offset[joint], values);
    return values;
  }
  std::vector<float> Rotations(int joint) const {
    std::vector<float> values;
    Eigen::Quaterniond last = Eigen::Quaterniond::Identity();
    for (const SkeletonPose& pose : motion_.frames) {
      Eigen::Quaterniond q(pose.R[joint]);
      // Of two equivalent quaternions, the one that continues from the last.
      if (q.dot(last) < 0) q.coeffs() *= -1;
      last = q;
      for (const double value : q.coeffs()) values.push_back(static_cast<float>(value));
    }
    return values;
  }
  void AddChannel(int joint, const char* path, const std::vector<float>& values, const char* type) {
    channels_.push_back(
        {{"sampler", samplers_.size()}, {"target", {{"node", joint}, {"path", path}}}});
    samplers_.push_back({{"input", times_},
                         {"output", buffer_.AddFloats(values, type)},
                         {"interpolation", "LINEAR"}});
  }

  const SkeletonMotion& motion_;
  GltfBuffer& buffer_;
  int times_ = 0;
  Json channels_ = Json::array(), samplers_ = Json::array();
};

Json Material() {
  return {{"name", "Skin"},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {0.6, 0.66, 0.72, 1}},
            {"metallicFactor", 0},
            {"roughnessFactor", 0.8}}}};
}

ExportRemarks RemarksOn(const SkeletonMotion& motion) {
  if (motion.held_frames == 0) return {};
  return {fmt::format("frames missing or not tracked, which repeat the last pose: {}",
                      motion.held_frames)};
}

}  // namespace

ExportRemarks WriteGlb(const ExportScene& scene, std::ostream& out) {
  const ExportSubject& subject = scene.subjects.front();
  const SkeletonMotion motion = MakeSkeletonMotion(subject.result);
  const JointOffsets rest = RestPlaces(subject.result.body);
  const std::string name = subject.name.empty() ? "Person" : Printable(subject.name);
  GltfBuffer buffer;
  std::vector<int> joints(kSkeletonJointCount);
  for (int i = 0; i < kSkeletonJointCount; ++i) joints[i] = i;
  Json file = {
      {"asset", {{"version", "2.0"}, {"generator", std::string("mocapd ") + MOCAP_VERSION}}},
      {"scene", 0}};
  if (subject.result.filter) file["asset"]["extras"] = {{"filter", *subject.result.filter}};
  file["scenes"] = Json::array({{{"nodes", {0, kSkeletonJointCount}}}});
  file["nodes"] = Nodes(motion, rest);
  file["nodes"].push_back({{"name", name}, {"mesh", 0}, {"skin", 0}});
  file["meshes"] = Json::array({Mesh(subject.result.body, buffer)});
  file["materials"] = Json::array({Material()});
  file["skins"] = Json::array({{{"name", name},
                                {"skeleton", 0},
                                {"joints", joints},
                                {"inverseBindMatrices", InverseBindMatrices(rest, buffer)}}});
  file["animations"] =
      Json::array({Animation(motion, scene.moments.front().timestamp_ns, buffer).Take(name)});
  out << buffer.Glb(std::move(file));
  return RemarksOn(motion);
}

}  // namespace mocap
