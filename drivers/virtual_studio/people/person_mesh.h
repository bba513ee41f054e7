// The simulated person's skin and clothes as a triangle mesh that follows the bones.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "drivers/virtual_studio/people/costume.h"
#include "drivers/virtual_studio/people/skeleton.h"

namespace mocap::simulation {

enum Material : std::uint8_t { kSkin, kHair, kShirt, kStripe, kTrousers, kShoes, kHat, kLoad };
inline constexpr int kMaterialCount = 8;

/// Clothes of the person.
struct Outfit {
  std::array<Bgr, kMaterialCount> colors;
  double sleeve_end = 2;   ///< Along the arm: 1 is the elbow, 2 the wrist.
  double trouser_end = 2;  ///< Along the leg: 1 is the knee, 2 the ankle.
  double trouser_slack_mm = 0;
  bool striped = false;
  Costume costume = {};
};

/// Chooses clothes, sometimes close to the colour `wall`.
Outfit MakeOutfit(std::uint64_t seed, Bgr wall);

/// Vertices in the rest posture (arms held out), each bound to at most three bones.
struct PersonMesh {
  struct Vertex {
    Eigen::Vector3f p_rest = Eigen::Vector3f::Zero();
    Eigen::Vector3f n_rest = Eigen::Vector3f::Zero();
    std::array<std::uint8_t, 3> bones{};
    std::array<float, 3> weights{};  ///< Sum 1, largest first; unused ones are 0.
    float albedo = 1;                ///< Folds and wear of the cloth.
  };
  struct Triangle {
    std::array<std::uint16_t, 3> v{};
    Material material = kSkin;
  };
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;  ///< Counter-clockwise seen from outside.
  /// The same surface with a sixth of the triangles, for shadows: vertex indices, and triangles
  /// that index this list.
  std::vector<std::uint16_t> coarse_vertices;
  std::vector<std::array<std::uint16_t, 3>> coarse_triangles;
  BonePoses rest;
};

PersonMesh BuildPersonMesh(const Anthropometry& body, const Outfit& outfit, std::uint64_t seed);

/// Computes the mesh in a posture, in single precision: p_W of every vertex [mm] and its normal
/// (not of unit length). Overwrites both.
void SkinMesh(const PersonMesh& mesh, const BonePoses& bones, std::vector<Eigen::Vector3f>& p_W,
              std::vector<Eigen::Vector3f>& n_W);

}  // namespace mocap::simulation
