#include "drivers/simulation/person_mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/errors.h"
#include "drivers/simulation/body_profiles.h"
#include "drivers/simulation/curve.h"
#include "drivers/simulation/random.h"

namespace mocap::simulation {
namespace {

// Smooth folds: a sum of waves around and along a part.
class Folds {
 public:
  explicit Folds(std::uint64_t seed) {
    Random random(seed);
    for (Wave& wave : waves_)
      wave = {std::floor(random.Uniform(1, 5)), random.Uniform(4, 14), random.Uniform(0, 6.28)};
  }
  double At(double angle, double s) const {
    double sum = 0;
    for (const Wave& wave : waves_)
      sum += std::sin(wave.around * angle + wave.along * s + wave.phase);
    return sum / std::size(waves_);
  }

 private:
  struct Wave {
    double around, along, phase;
  };
  std::array<Wave, 4> waves_;
};

// One ring of a tube: pose of its cross-section, and weights of the bones that move it.
struct Ring {
  RigidTransform X_WRing;  // At rest; the section lies in its x-y plane, y to the left.
  Section section;
  double roundness = 2;  // Exponent of the superellipse.
  std::array<double, kBoneCount> weights{};
};

struct TubeStyle {
  int rings = 0, sectors = 0;
  double side = 1;  // +1: `outer` is to the left.
  double fold = 0;  // Depth of folds as a share of the radius.
  std::function<Material(double s, double angle)> material;
};

class Builder {
 public:
  Builder(PersonMesh& mesh, std::uint64_t seed) : mesh_(mesh), seed_(seed) {}

  // Joins rings from `first` to `last` into a closed tube.
  void AddTube(double first, double last, const TubeStyle& style,
               const std::function<Ring(double s)>& ring_at) {
    const Folds folds(Mix(seed_, ++parts_));
    const int base = static_cast<int>(mesh_.vertices.size());
    for (int r = 0; r < style.rings; ++r) {
      const double s = first + (last - first) * r / (style.rings - 1);
      const Ring ring = ring_at(s);
      for (int c = 0; c < style.sectors; ++c)
        AddVertex(ring, 2 * std::numbers::pi * c / style.sectors, s, style, folds);
    }
    AddCap(ring_at(first), base, style, false, style.material(first, 0));
    AddSides(base, first, last, style);
    AddCoarseSides(base, style);
    AddCap(ring_at(last), base + (style.rings - 1) * style.sectors, style, true,
           style.material(last, 0));
  }

  void FinishNormals() {
    for (const PersonMesh::Triangle& t : mesh_.triangles) {
      const auto& p = mesh_.vertices;
      const Eigen::Vector3f n =
          (p[t.v[1]].p_rest - p[t.v[0]].p_rest).cross(p[t.v[2]].p_rest - p[t.v[0]].p_rest);
      for (const int i : t.v) mesh_.vertices[i].n_rest += n;
    }
    for (PersonMesh::Vertex& v : mesh_.vertices) v.n_rest.normalize();
  }

 private:
  void AddVertex(const Ring& ring, double angle, double s, const TubeStyle& style,
                 const Folds& folds) {
    const double c = std::cos(angle), d = std::sin(angle);
    const double n = ring.roundness;
    double radius = std::pow(std::pow(std::abs(c), n) + std::pow(std::abs(d), n), -1 / n);
    const double fold = folds.At(angle, s);
    radius *= 1 + style.fold * fold;
    const Section& q = ring.section;
    const bool outward = d * style.side >= 0;
    const Vector3 p(q.cx + radius * c * (c >= 0 ? q.front : q.back),
                    style.side * q.cy + radius * d * (outward ? q.outer : q.inner), 0);
    Push(ring, p, static_cast<float>(1 + 0.10 * fold));
  }

  int Push(const Ring& ring, const Vector3& p_Ring, float albedo) {
    PersonMesh::Vertex vertex;
    vertex.p_rest = (ring.X_WRing * p_Ring).cast<float>();
    vertex.albedo = albedo;
    std::array<double, kBoneCount> weights = ring.weights;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const int bone =
          static_cast<int>(std::max_element(weights.begin(), weights.end()) - weights.begin());
      vertex.bones[k] = static_cast<std::uint8_t>(bone);
      vertex.weights[k] = static_cast<float>(weights[bone]);
      sum += weights[bone];
      weights[bone] = 0;
    }
    MOCAP_CHECK(sum > 0.5);
    for (float& w : vertex.weights) w /= static_cast<float>(sum);
    mesh_.vertices.push_back(vertex);
    MOCAP_CHECK(mesh_.vertices.size() < 65536);
    return static_cast<int>(mesh_.vertices.size()) - 1;
  }

  void AddCap(const Ring& ring, int base, const TubeStyle& style, bool end, Material material) {
    const int center = Push(ring, {ring.section.cx, style.side * ring.section.cy, 0}, 1);
    for (int c = 0; c < style.sectors; ++c) {
      const int a = base + c, b = base + (c + 1) % style.sectors;
      AddTriangle(center, end ? b : a, end ? a : b, material);
    }
  }

  void AddSides(int base, double first, double last, const TubeStyle& style) {
    for (int r = 0; r + 1 < style.rings; ++r) {
      const double s = first + (last - first) * (r + 0.5) / (style.rings - 1);
      for (int c = 0; c < style.sectors; ++c) {
        const int next = (c + 1) % style.sectors;
        const int a = base + r * style.sectors + c, b = base + r * style.sectors + next;
        const int d = a + style.sectors, e = b + style.sectors;
        const Material material =
            style.material(s, 2 * std::numbers::pi * (c + 0.5) / style.sectors);
        AddTriangle(a, d, b, material);
        AddTriangle(b, d, e, material);
      }
    }
  }

  // Every third ring and second sector.
  void AddCoarseSides(int base, const TubeStyle& style) {
    const int first = static_cast<int>(mesh_.coarse_vertices.size());
    const int columns = style.sectors / 2;
    int rows = 0;
    for (int r = 0; r < style.rings;
         r = r + 3 < style.rings || r == style.rings - 1 ? r + 3 : style.rings - 1) {
      for (int c = 0; c < columns; ++c)
        mesh_.coarse_vertices.push_back(
            static_cast<std::uint16_t>(base + r * style.sectors + 2 * c));
      ++rows;
    }
    for (int r = 0; r + 1 < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        const auto at = [&](int row, int column) {
          return static_cast<std::uint16_t>(first + row * columns + column % columns);
        };
        mesh_.coarse_triangles.push_back({at(r, c), at(r + 1, c), at(r, c + 1)});
        mesh_.coarse_triangles.push_back({at(r, c + 1), at(r + 1, c), at(r + 1, c + 1)});
      }
  }

  void AddTriangle(int a, int b, int c, Material material) {
    mesh_.triangles.push_back({{static_cast<std::uint16_t>(a), static_cast<std::uint16_t>(b),
                                static_cast<std::uint16_t>(c)},
                               material});
  }

  PersonMesh& mesh_;
  std::uint64_t seed_;
  std::uint64_t parts_ = 0;
};

Section Loosened(Section section, double slack_mm) {
  for (double* v : {&section.front, &section.back, &section.outer, &section.inner}) *v += slack_mm;
  return section;
}

void AddTorso(Builder& builder, const Anthropometry& body, const Outfit& outfit,
              const BonePoses& rest) {
  TubeStyle style{.rings = 30, .sectors = 22, .side = 1, .fold = 0.012, .material = {}};
  style.material = [&outfit](double s, double) {
    if (s > 0.985) return kSkin;
    if (s < 0.08) return kTrousers;
    return outfit.striped && std::fmod(s * 9, 2) < 1 ? kStripe : kShirt;
  };
  // From the neck downward, so that the rings run against z, as in the limbs.
  builder.AddTube(1.2, -0.19, style, [&](double s) {
    Ring ring;
    ring.X_WRing = {Matrix3::Identity(), rest[kPelvis].p + Vector3(0, 0, s * body.torso_mm)};
    ring.section = TorsoSection(body, s);
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

void AddHead(Builder& builder, const Anthropometry& body, const BonePoses& rest) {
  TubeStyle style{.rings = 18, .sectors = 18, .side = 1, .fold = 0, .material = {}};
  style.material = [](double s, double angle) {
    // Hair: the crown, and further down at the back.
    const double back = 0.5 - 0.5 * std::cos(angle);
    return s > 0.84 - 0.55 * back * back ? kHair : kSkin;
  };
  builder.AddTube(1, 0, style, [&](double s) {
    Ring ring;
    const Vector3 middle = HeadCenterInHead(body);
    ring.X_WRing = rest[kHead] * RigidTransform{Matrix3::Identity(),
                                                middle + Vector3(0, 0, (s - 0.5) * body.head_mm)};
    ring.section = HeadSection(body, s);
    ring.weights[kHead] = 1;
    return ring;
  });
}

void AddArm(Builder& builder, const Anthropometry& body, const Outfit& outfit, int side,
            const BonePoses& rest) {
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
    ring.X_WRing = rest[kUpperArmL + side] * RigidTransform{Matrix3::Identity(), {0, 0, z}};
    ring.section = ArmSection(body, s);
    if (s < outfit.sleeve_end) ring.section = Loosened(ring.section, 0.003 * body.stature_mm);
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
    ring.X_WRing = rest[kHandL + side] *
                   RigidTransform{Matrix3::Identity(),
                                  {(0.010 + 0.022 * s) * h, -SideSign(side) * 0.006 * s * h,
                                   -(0.10 + 0.50 * s) * body.hand_mm}};
    const double r = h * (0.0075 - 0.0035 * s * s) * (s > 0.95 ? 0.5 : 1);
    ring.section = {s, 0, 0, r, r, r, r};
    ring.weights[kHandL + side] = 1;
    return ring;
  });
}

void AddLeg(Builder& builder, const Anthropometry& body, const Outfit& outfit, int side,
            const BonePoses& rest) {
  TubeStyle style{
      .rings = 34, .sectors = 14, .side = SideSign(side), .fold = 0.015, .material = {}};
  style.material = [&outfit](double s, double) {
    return s > outfit.trouser_end ? kSkin : kTrousers;
  };
  builder.AddTube(-0.14, 2.06, style, [&](double s) {
    const double z = -(std::min(s, 1.0) * body.thigh_mm + std::max(s - 1, 0.0) * body.shank_mm);
    Ring ring;
    ring.X_WRing = rest[kThighL + side] * RigidTransform{Matrix3::Identity(), {0, 0, z}};
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

void AddFoot(Builder& builder, const Anthropometry& body, int side, const BonePoses& rest) {
  TubeStyle style{.rings = 16, .sectors = 14, .side = SideSign(side), .fold = 0, .material = {}};
  style.material = [](double, double) { return kShoes; };
  // The rings are upright: x is up and z backward, so that they run against z.
  Matrix3 R_FootRing;
  R_FootRing << Vector3::UnitZ(), Vector3::UnitY(), -Vector3::UnitX();
  builder.AddTube(0, 1, style, [&](double s) {
    const double x = s * body.foot_mm - body.heel_mm;
    Ring ring;
    ring.X_WRing = rest[kFootL + side] * RigidTransform{R_FootRing, {x, 0, -body.ankle_to_sole_mm}};
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
  Builder builder(mesh, Mix(seed, Tag("folds")));
  AddTorso(builder, body, outfit, mesh.rest);
  AddHead(builder, body, mesh.rest);
  for (const int side : {kLeft, kRight}) {
    AddArm(builder, body, outfit, side, mesh.rest);
    AddLeg(builder, body, outfit, side, mesh.rest);
    AddFoot(builder, body, side, mesh.rest);
  }
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
