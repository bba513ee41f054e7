#include "drivers/virtual_studio/people/person_mesh.h"

#include <algorithm>
#include <cmath>

#include "drivers/virtual_studio/curve.h"
#include "drivers/virtual_studio/people/body_profiles.h"
#include "drivers/virtual_studio/people/tube_builder.h"
#include "drivers/virtual_studio/random.h"

namespace mocap::simulation {
namespace {

void AddTorso(TubeBuilder& builder, const Anthropometry& body, const Outfit& outfit) {
  TubeStyle style{.rings = 30, .sectors = 22, .side = 1, .fold = 0.012, .material = {}};
  style.material = [&outfit](double s, double) {
    if (s > 0.985) return kSkin;
    if (s < 0.08) return kTrousers;
    return outfit.striped && std::fmod(s * 9, 2) < 1 ? kStripe : kShirt;
  };
  // From the neck downward, so that the rings run against z, as in the limbs.
  builder.AddTube(1.2, -0.19, style, [&](double s) {
    Ring ring;
    ring.X_WRing = {Matrix3::Identity(),
                    builder.rest()[kPelvis].p + Vector3(0, 0, s * body.torso_mm)};
    ring.section = TorsoSection(body, s);
    if (s < 0.985) ring.section = Loosened(ring.section, outfit.costume.torso_slack_mm);
    ring.roundness = 2 + 0.7 * Smoothstep(-0.15, 0, s) * (1 - Smoothstep(0.8, 0.95, s));
    const double lumbar = Smoothstep(0.08, 0.36, s), thorax = Smoothstep(0.38, 0.62, s);
    const double neck = Smoothstep(0.94, 1.06, s), head = Smoothstep(1.08, 1.2, s);
    ring.weights[kPelvis] = 1 - lumbar;
    ring.weights[kLumbar] = lumbar * (1 - thorax);
    ring.weights[kThorax] = thorax * (1 - neck);
    ring.weights[kNeck] = neck * (1 - head);
    ring.weights[kHead] = head;
    return ring;
  });
}

void AddHead(TubeBuilder& builder, const Anthropometry& body, const Outfit& outfit) {
  TubeStyle style{.rings = 18, .sectors = 18, .side = 1, .fold = 0, .material = {}};
  const bool is_bald = outfit.costume.hair == Hair::kNone;
  style.material = [is_bald](double s, double angle) {
    // Hair: the crown, and further down at the back.
    if (is_bald) return kSkin;
    const double back = 0.5 - 0.5 * std::cos(angle);
    return s > 0.84 - 0.55 * back * back ? kHair : kSkin;
  };
  builder.AddTube(1, 0, style, [&](double s) {
    Ring ring;
    const Vector3 middle = HeadCenterInHead(body);
    ring.X_WRing =
        builder.rest()[kHead] *
        RigidTransform{Matrix3::Identity(), middle + Vector3(0, 0, (s - 0.5) * body.head_mm)};
    ring.section = HeadSection(body, s);
    ring.weights[kHead] = 1;
    return ring;
  });
}

void AddArm(TubeBuilder& builder, const Anthropometry& body, const Outfit& outfit, int side) {
  TubeStyle style{
      .rings = 40, .sectors = 12, .side = SideSign(side), .fold = 0.015, .material = {}};
  style.material = [&outfit](double s, double) {
    if (s > outfit.sleeve_end) return kSkin;
    return outfit.striped && std::fmod(s * 5 + 10, 2) < 1 ? kStripe : kShirt;
  };
  builder.AddTube(-0.2, 3, style, [&](double s) {
    const double z =
        -(std::min(s, 1.0) * body.upper_arm_mm + std::clamp(s - 1, 0.0, 1.0) * body.forearm_mm +
          std::clamp(s - 2, 0.0, 1.0) * body.hand_mm);
    Ring ring;
    ring.X_WRing =
        builder.rest()[kUpperArmL + side] * RigidTransform{Matrix3::Identity(), {0, 0, z}};
    ring.section = ArmSection(body, s);
    if (s < outfit.sleeve_end) {
      const double wide_mm = outfit.costume.sleeve_slack_mm * Smoothstep(0.2, 1.6, s);
      ring.section = Loosened(ring.section, 0.003 * body.stature_mm + wide_mm);
    }
    const double upper = Smoothstep(-0.2, 0.15, s), fore = Smoothstep(0.86, 1.14, s);
    // Towards the wrist, the skin turns with the hand more and more.
    const double hand = 0.7 * Smoothstep(1.3, 1.9, s) + 0.3 * Smoothstep(1.92, 2.08, s);
    ring.weights[kThorax] = 0.4 * (1 - upper);
    ring.weights[kClavicleL + side] = 0.6 * (1 - upper);
    ring.weights[kUpperArmL + side] = upper * (1 - fore);
    ring.weights[kForearmL + side] = fore * (1 - hand);
    ring.weights[kHandL + side] = fore * hand;
    return ring;
  });

  TubeStyle thumb{.rings = 6, .sectors = 8, .side = SideSign(side), .fold = 0, .material = {}};
  thumb.material = [](double, double) { return kSkin; };
  builder.AddTube(0, 1, thumb, [&](double s) {
    const double h = body.stature_mm;
    Ring ring;
    ring.X_WRing = builder.rest()[kHandL + side] *
                   RigidTransform{Matrix3::Identity(),
                                  {(0.010 + 0.022 * s) * h, -SideSign(side) * 0.006 * s * h,
                                   -(0.10 + 0.50 * s) * body.hand_mm}};
    const double r = h * (0.0075 - 0.0035 * s * s) * (s > 0.95 ? 0.5 : 1);
    ring.section = {s, 0, 0, r, r, r, r};
    ring.weights[kHandL + side] = 1;
    return ring;
  });
}

void AddLeg(TubeBuilder& builder, const Anthropometry& body, const Outfit& outfit, int side) {
  TubeStyle style{
      .rings = 34, .sectors = 14, .side = SideSign(side), .fold = 0.015, .material = {}};
  style.material = [&outfit](double s, double) {
    return s > outfit.trouser_end ? kSkin : kTrousers;
  };
  builder.AddTube(-0.14, 2.06, style, [&](double s) {
    const double z = -(std::min(s, 1.0) * body.thigh_mm + std::max(s - 1, 0.0) * body.shank_mm);
    Ring ring;
    ring.X_WRing = builder.rest()[kThighL + side] * RigidTransform{Matrix3::Identity(), {0, 0, z}};
    ring.section = LegSection(body, s);
    if (s < outfit.trouser_end)
      ring.section = Loosened(ring.section, outfit.trouser_slack_mm * Smoothstep(0.1, 1.5, s));
    const double thigh = Smoothstep(-0.10, 0.20, s), shank = Smoothstep(0.87, 1.13, s);
    const double foot = Smoothstep(1.9, 2.06, s);
    ring.weights[kPelvis] = 1 - thigh;
    ring.weights[kThighL + side] = thigh * (1 - shank);
    ring.weights[kShankL + side] = shank * (1 - foot);
    ring.weights[kFootL + side] = shank * foot;
    return ring;
  });
}

void AddFoot(TubeBuilder& builder, const Anthropometry& body, int side) {
  TubeStyle style{.rings = 16, .sectors = 14, .side = SideSign(side), .fold = 0, .material = {}};
  style.material = [](double, double) { return kShoes; };
  // The rings are upright: x is up and z backward, so that they run against z.
  Matrix3 R_FootRing;
  R_FootRing << Vector3::UnitZ(), Vector3::UnitY(), -Vector3::UnitX();
  builder.AddTube(0, 1, style, [&](double s) {
    const double x = s * body.foot_mm - body.heel_mm;
    Ring ring;
    ring.X_WRing =
        builder.rest()[kFootL + side] * RigidTransform{R_FootRing, {x, 0, -body.ankle_to_sole_mm}};
    ring.section = FootSection(body, s);
    // The oval rests on the sole: its middle is low and its lower half flat.
    const double top = ring.section.front;
    ring.section.cx = 0.3 * top;
    ring.section.front = 0.7 * top;
    ring.section.back = 0.3 * top;
    ring.roundness = 2.6;
    const double toes = Smoothstep(body.ball_mm - 0.012 * body.stature_mm,
                                   body.ball_mm + 0.012 * body.stature_mm, x);
    ring.weights[kFootL + side] = 1 - toes;
    ring.weights[kToesL + side] = toes;
    return ring;
  });
}

BodyPose RestPose(const Anthropometry& body) {
  BodyPose pose;
  pose.p_WPelvis.z() = body.hip_height_mm();
  for (ArmAngles& arm : pose.arms) arm.abduction = 0.7;
  for (LegAngles& leg : pose.legs) leg.abduction = 0.05;
  return pose;
}

}  // namespace

PersonMesh BuildPersonMesh(const Anthropometry& body, const Outfit& outfit, std::uint64_t seed) {
  PersonMesh mesh;
  mesh.rest = PlaceBones(body, RestPose(body));
  TubeBuilder builder(mesh, Mix(seed, Tag("folds")));
  AddTorso(builder, body, outfit);
  AddHead(builder, body, outfit);
  for (const int side : {kLeft, kRight}) {
    AddArm(builder, body, outfit, side);
    AddLeg(builder, body, outfit, side);
    AddFoot(builder, body, side);
  }
  AddCostume(body, outfit.costume, builder);
  builder.FinishNormals();
  return mesh;
}

void SkinMesh(const PersonMesh& mesh, const BonePoses& bones, std::vector<Eigen::Vector3f>& p_W,
              std::vector<Eigen::Vector3f>& n_W) {
  std::array<Eigen::Matrix<float, 3, 4>, kBoneCount> moves;
  for (int i = 0; i < kBoneCount; ++i) {
    const RigidTransform X = bones[i] * mesh.rest[i].Inverse();
    moves[i] << X.R.cast<float>(), X.p.cast<float>();
  }
  p_W.resize(mesh.vertices.size());
  n_W.resize(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const PersonMesh::Vertex& v = mesh.vertices[i];
    Eigen::Matrix<float, 3, 4> m = moves[v.bones[0]];
    if (v.weights[0] < 1) {
      m = v.weights[0] * m + v.weights[1] * moves[v.bones[1]];
      if (v.weights[2] > 0) m += v.weights[2] * moves[v.bones[2]];
    }
    p_W[i] = m.leftCols<3>() * v.p_rest + m.col(3);
    n_W[i] = m.leftCols<3>() * v.n_rest;
  }
}

}  // namespace mocap::simulation
