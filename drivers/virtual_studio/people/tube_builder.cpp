#include "drivers/virtual_studio/people/tube_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/errors.h"
#include "drivers/virtual_studio/curve.h"
#include "drivers/virtual_studio/random.h"

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

// Weights of a ring at an angle; opposite sides may follow different bones.
BoneWeights WeightsAt(const Ring& ring, double sine) {
  if (!ring.right_weights) return ring.weights;
  const double left = Smoothstep(-0.6, 0.6, sine);
  BoneWeights weights = ring.weights;
  for (int i = 0; i < kBoneCount; ++i)
    weights[i] = left * ring.weights[i] + (1 - left) * (*ring.right_weights)[i];
  return weights;
}

}  // namespace

void TubeBuilder::AddTube(double first, double last, const TubeStyle& style,
                          const std::function<Ring(double s)>& ring_at) {
  const Folds folds(Mix(seed_, ++parts_));
  const int base = static_cast<int>(mesh_.vertices.size());
  for (int r = 0; r < style.rings; ++r) {
    const double s = first + (last - first) * r / (style.rings - 1);
    const Ring ring = ring_at(s);
    for (int c = 0; c < style.sectors; ++c) {
      const double angle = 2 * std::numbers::pi * c / style.sectors;
      AddVertex(ring, angle, folds.At(angle, s), style);
    }
  }
  AddCap(ring_at(first), base, style, false, style.material(first, 0));
  AddSides(base, first, last, style);
  AddCoarseSides(base, style);
  AddCap(ring_at(last), base + (style.rings - 1) * style.sectors, style, true,
         style.material(last, 0));
}

void TubeBuilder::FinishNormals() {
  for (const PersonMesh::Triangle& t : mesh_.triangles) {
    const auto& p = mesh_.vertices;
    const Eigen::Vector3f n =
        (p[t.v[1]].p_rest - p[t.v[0]].p_rest).cross(p[t.v[2]].p_rest - p[t.v[0]].p_rest);
    for (const int i : t.v) mesh_.vertices[i].n_rest += n;
  }
  for (PersonMesh::Vertex& v : mesh_.vertices) v.n_rest.normalize();
}

void TubeBuilder::AddVertex(const Ring& ring, double angle, double fold, const TubeStyle& style) {
  const double c = std::cos(angle), d = std::sin(angle);
  const double n = ring.roundness;
  double radius = std::pow(std::pow(std::abs(c), n) + std::pow(std::abs(d), n), -1 / n);
  radius *= 1 + style.fold * fold;
  const Section& q = ring.section;
  const bool outward = d * style.side >= 0;
  const Vector3 p(q.cx + radius * c * (c >= 0 ? q.front : q.back),
                  style.side * q.cy + radius * d * (outward ? q.outer : q.inner), 0);
  Push(ring, p, static_cast<float>(1 + 0.10 * fold), WeightsAt(ring, d));
}

int TubeBuilder::Push(const Ring& ring, const Vector3& p_Ring, float albedo, BoneWeights weights) {
  PersonMesh::Vertex vertex;
  vertex.p_rest = (ring.X_WRing * p_Ring).cast<float>();
  vertex.albedo = albedo;
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

void TubeBuilder::AddCap(const Ring& ring, int base, const TubeStyle& style, bool end,
                         Material material) {
  const int center =
      Push(ring, {ring.section.cx, style.side * ring.section.cy, 0}, 1, WeightsAt(ring, 0));
  for (int c = 0; c < style.sectors; ++c) {
    const int a = base + c, b = base + (c + 1) % style.sectors;
    AddTriangle(center, end ? b : a, end ? a : b, material);
  }
}

void TubeBuilder::AddSides(int base, double first, double last, const TubeStyle& style) {
  for (int r = 0; r + 1 < style.rings; ++r) {
    const double s = first + (last - first) * (r + 0.5) / (style.rings - 1);
    for (int c = 0; c < style.sectors; ++c) {
      const int next = (c + 1) % style.sectors;
      const int a = base + r * style.sectors + c, b = base + r * style.sectors + next;
      const int d = a + style.sectors, e = b + style.sectors;
      const Material material = style.material(s, 2 * std::numbers::pi * (c + 0.5) / style.sectors);
      AddTriangle(a, d, b, material);
      AddTriangle(b, d, e, material);
    }
  }
}

// Every third ring and second sector.
void TubeBuilder::AddCoarseSides(int base, const TubeStyle& style) {
  const int first = static_cast<int>(mesh_.coarse_vertices.size());
  const int columns = style.sectors / 2;
  int rows = 0;
  for (int r = 0; r < style.rings;
       r = r + 3 < style.rings || r == style.rings - 1 ? r + 3 : style.rings - 1) {
    for (int c = 0; c < columns; ++c)
      mesh_.coarse_vertices.push_back(static_cast<std::uint16_t>(base + r * style.sectors + 2 * c));
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

void TubeBuilder::AddTriangle(int a, int b, int c, Material material) {
  mesh_.triangles.push_back({{static_cast<std::uint16_t>(a), static_cast<std::uint16_t>(b),
                              static_cast<std::uint16_t>(c)},
                             material});
}

}  // namespace mocap::simulation
