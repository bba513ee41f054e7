// Builds a skinned surface out of closed tubes.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "drivers/virtual_studio/people/body_profiles.h"
#include "drivers/virtual_studio/people/person_mesh.h"

namespace mocap::simulation {

using BoneWeights = std::array<double, kBoneCount>;

/// One ring of a tube.
struct Ring {
  RigidTransform X_WRing;  ///< At rest; the section lies in its x-y plane, y to the left.
  Section section;
  double roundness = 2;   ///< Exponent of the superellipse.
  BoneWeights weights{};  ///< Of the bones that move it.
  /// If set, `weights` holds on the left, this on the right, and a mixture in between.
  std::optional<BoneWeights> right_weights;
};

struct TubeStyle {
  int rings = 0, sectors = 0;
  double side = 1;  ///< +1: `outer` is to the left.
  double fold = 0;  ///< Depth of folds as a share of the radius.
  std::function<Material(double s, double angle)> material;
};

/// A round tube of one material, without folds.
inline TubeStyle PlainStyle(Material material, int rings, int sectors) {
  return {.rings = rings,
          .sectors = sectors,
          .side = 1,
          .fold = 0,
          .material = [material](double, double) { return material; }};
}

/// Adds tubes to a mesh.
class TubeBuilder {
 public:
  /// @param mesh  borrowed; its rest pose is set.
  /// @param seed  of the folds.
  TubeBuilder(PersonMesh& mesh, std::uint64_t seed) : mesh_(mesh), seed_(seed) {}

  const BonePoses& rest() const { return mesh_.rest; }
  /// Joins rings from `first` to `last` into a closed tube. They run against their z axis.
  void AddTube(double first, double last, const TubeStyle& style,
               const std::function<Ring(double s)>& ring_at);
  /// Computes the normals of all vertices.
  void FinishNormals();

 private:
  void AddVertex(const Ring& ring, double angle, double fold, const TubeStyle& style);
  int Push(const Ring& ring, const Vector3& p_Ring, float albedo, BoneWeights weights);
  void AddCap(const Ring& ring, int base, const TubeStyle& style, bool end, Material material);
  void AddSides(int base, double first, double last, const TubeStyle& style);
  void AddCoarseSides(int base, const TubeStyle& style);
  void AddTriangle(int a, int b, int c, Material material);

  PersonMesh& mesh_;
  std::uint64_t seed_;
  std::uint64_t parts_ = 0;
};

}  // namespace mocap::simulation
