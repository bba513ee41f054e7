// Binary messages of mocap view, little-endian; wire.js of the page decodes them.
#pragma once

#include <cstdint>
#include <mocap/voxels_t.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/body/body_shape.h"
#include "core/evidence/keypoint_view.h"
#include "core/geometry.h"
#include "core/motion_capture.h"
#include "tools/report/body_outline.h"
#include "tools/results/result.h"

namespace mocap {

/// The page counts time in milliseconds.
inline constexpr double kNsPerMs = 1e6;

/// A pose for drawing.
struct DrawnPose {
  int person = 0;  ///< Index of its colour.
  int id = 0;      ///< As in person_t; 0: unknown.
  PoseRow row;
  double publish_ms = 0;  ///< Since the Unix epoch.
  std::vector<PosedCapsule> capsules;
  std::optional<RivalPose> rival;
};

/// 392 bytes and 32 per capsule, 276 for a rival: u8 kind = 1, person, state, has_pose; u16 points,
/// capsules; f64 capture [ms], publish [ms], frame; f32 residual [mm]; u32 voxels; f32
/// points[23][3] [mm]; f32 capsules[n][8]: a, its radius, b, its radius [mm]; u32 id; f32
/// probability (NaN: not known); f32 rival's probability (0: there is none), then f32 rival's
/// points[23][3] [mm]; f32 contacts[4][4]: place [mm] of each of kContactPoints, and how likely it
/// touches the floor (NaN: not known).
std::string PoseBytes(const DrawnPose& pose);

/// 32 bytes and 8 per voxel: u8 kind = 2, person; u16 0; u32 count; f64 capture [ms]; f32 voxel
/// [mm], origin[3] [mm]; then u16 x, y, z and i16 label of the surface voxels. Empty for an invalid
/// message.
std::string VoxelBytes(const voxels_t& voxels, int person);

/// Outlines of a person's body in a picture.
struct DrawnOutlines {
  int person = kAlone;  ///< Index of their colour; kAlone: colours of the sides.
  std::vector<BodyLine> lines;

  static constexpr int kAlone = -1;
};

/// A picture with its overlays.
struct DrawnPicture {
  int camera = 0;  ///< Index in the studio.
  int width_px = 0, height_px = 0;
  double capture_ms = 0;
  /// Closed lines around the people and around unknown pixels [px].
  std::vector<std::vector<Vector2>> silhouette, unknown;
  std::optional<double> unknown_share;  ///< Of the pixels that show people; if known.
  std::vector<DrawnOutlines> bodies;
  std::span<const std::uint8_t> jpeg;
};

/// 32 bytes and the contents: u8 kind = 3, camera; u16 width, height, 0; f64 capture [ms]; u32
/// floats of the trimap's lines, floats of the bodies', bytes of the JPEG; f32 share of unknown
/// pixels where people are, -1 if not known; then these, padded with zeros to a multiple of 8. A
/// line is f32 count, f32 kind and count × f32 x, y. The kind is, in the trimap, 0 for people and 1
/// for unknown pixels; of bodies, the side (0 middle, 1 left, 2 right) + 4 × (person + 1).
std::string PictureBytes(const DrawnPicture& picture);

/// 16 bytes and 16 per point: u8 kind = 4, camera; u16 points; u32 person; f64 capture [ms]; then
/// f32 number of the landmark, x, y [px], score.
std::string KeypointBytes(const KeypointView& view, int camera);

}  // namespace mocap
