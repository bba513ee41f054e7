// §4: a camera's view of the eight octants of a block of voxels.
#pragma once

#include <array>
#include <cstdint>

namespace mocap::kernels {

/// A position in a picture, between pixel centres.
struct PicturePlace {
  float x_px = 0;
  float y_px = 0;
};

/// Within this many cells of a cell, its bend holds.
inline constexpr int kBendReach_cells = 2;

/// A table of the places where directions meet a camera's picture (SensorPlaneTable).
struct SensorPlaneNodes {
  const PicturePlace* nodes = nullptr;
  int columns = 0;
  float origin_x = 0, origin_y = 0;
  float cells_per_unit = 0;
  float last_column = 0, last_row = 0;
  float field_radius = 0;
  /// The part of the sensor plane that the picture shows.
  float low_x = 0, low_y = 0, high_x = 0, high_y = 0;
  /// For each cell: an upper bound on the change of the slope of positions [px per cell] from one
  /// cell to the next, within kBendReach_cells of it.
  const float* bends_px = nullptr;
};

/// Windows of the first plane are one pixel wide. Each further plane doubles the width.
inline constexpr int kWindowPlanes = 6;
inline constexpr int kWidestWindow_px = 1 << (kWindowPlanes - 1);

/// Whether square windows of a silhouette are inside or outside (WindowMap).
struct WindowPlanes {
  const std::uint32_t* words = nullptr;
  int words_per_column = 0, words_per_plane = 0;
  /// Everything beside this region is outside; its last column and row are included.
  int left = 0, top = 0, right = -1, bottom = -1;
  int width_px = 0, height_px = 0;  ///< Of the picture.
};

/// A camera and what it sees.
struct OctantCamera {
  std::array<std::array<float, 3>, 3> R;
  std::array<float, 3> p;
  SensorPlaneNodes table;
  WindowPlanes planes;
};

/// Positions of eight points in a camera's picture, and how they change around each point.
///
/// A point at offset `o` [mm] from `middle` appears at (x, y) + (along · o) / (1 + depth · o), up
/// to `error` [px].
struct OctantFrames {
  static constexpr int kLanes = 8;
  using Lanes = std::array<float, kLanes>;

  alignas(32) std::array<Lanes, 3> middle;  ///< From the common origin [mm].
  Lanes x, y;
  std::array<Lanes, 3> along_x, along_y;  ///< [px per mm]
  std::array<Lanes, 3> depth;             ///< [1/mm]
  Lanes reach_x, reach_y;  ///< Largest extent of a cube [px per mm of half its side].
  Lanes error;
};

/// Directions of the octants from the middle of a block. Octant 0 is nearest to the origin; x grows
/// with the lowest bit, then y, then z.
inline constexpr OctantFrames::Lanes kOctantX = {-1, 1, -1, 1, -1, 1, -1, 1};
inline constexpr OctantFrames::Lanes kOctantY = {-1, -1, 1, 1, -1, -1, 1, 1};
inline constexpr OctantFrames::Lanes kOctantZ = {-1, -1, -1, -1, 1, 1, 1, 1};

/// More than the rounding of floats moves a point.
inline constexpr float kOctantRounding_px = 0.01f;
/// Closer than this many half sides of a cube, a camera decides nothing about it.
inline constexpr float kNearestOctant = 4;
/// Keeps positions positive before they are rounded down, and distant ones from overflowing.
inline constexpr int kPlaceBias_px = 8192;
inline constexpr float kFarthestPlace_px = 32768;
/// Four of the largest windows cover this much.
inline constexpr int kWidestOctant_px = 2 * kWidestWindow_px;
/// The error of a frame that decides nothing.
inline constexpr float kNoFrame_px = 1e6f;

/// Decisions about eight octants, one bit per octant in each byte: inside the silhouette, outside,
/// unseen, in unknown pixels; the first byte is the lowest.
using OctantBits = std::uint32_t;

/// Projects octants by the camera's table, and looks them up in its windows.
/// @param middle  of the block [mm].
/// @param spread  from there to the centres of the octants, along each axis [mm].
/// @param half    half the side of the cubes to test there [mm].
OctantBits ProjectOctants(const OctantCamera& camera, const std::array<float, 3>& middle,
                          float spread, float half, OctantFrames& frames);

/// Does so by the frame of an octant that contains all of these.
OctantBits JudgeOctants(const WindowPlanes& planes, const OctantFrames& frames, int octant,
                        const std::array<float, 3>& middle, float spread, float half);

/// What a camera knows about the samples of eight voxels: one byte per sample, one bit per voxel.
struct SampleDecisions {
  std::uint64_t inside, outside, unseen, unknown;
};

/// Tests the samples of eight voxels by windows of one or two pixels. Returns whether all of them
/// lie in the region of the planes; otherwise nothing is decided.
/// @param asked  voxels whose samples matter; others may stay undecided.
bool JudgeSamples(const WindowPlanes& planes, const OctantFrames& frames, int octant,
                  const std::array<float, 3>& middle, float voxel_spread, float sample_spread,
                  unsigned asked, SampleDecisions& decisions);

}  // namespace mocap::kernels
