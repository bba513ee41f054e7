#include "tools/view/wire.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "tools/byte_writer.h"

namespace mocap {
namespace {

/// More voxels than any room has; larger messages are rejected.
constexpr std::int64_t kMostVoxels = std::int64_t{1} << 26;
/// More than people occupy, at a voxel size of 10 mm.
constexpr std::int64_t kMostOccupied = std::int64_t{1} << 21;

/// Occupied voxels of a grid, by index along x, then y, then z.
struct OccupiedVoxels {
  static constexpr std::int32_t kEmpty = -1;

  std::int64_t width, depth, height;
  std::vector<std::int32_t> number;  ///< By index; kEmpty: not occupied.

  bool IsOccupied(std::int64_t x, std::int64_t y, std::int64_t z) const {
    const bool is_inside = x >= 0 && y >= 0 && z >= 0 && x < width && y < depth && z < height;
    return is_inside && number[static_cast<std::size_t>((z * depth + y) * width + x)] != kEmpty;
  }
  bool IsInside(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return IsOccupied(x - 1, y, z) && IsOccupied(x + 1, y, z) && IsOccupied(x, y - 1, z) &&
           IsOccupied(x, y + 1, z) && IsOccupied(x, y, z - 1) && IsOccupied(x, y, z + 1);
  }
};

bool IsSound(const voxels_t& voxels) {
  std::int64_t count = 1;
  for (const std::int32_t size : voxels.size) {
    if (size < 0 || size > std::numeric_limits<std::uint16_t>::max()) return false;
    count *= size;
    if (count > kMostVoxels) return false;
  }
  std::int64_t at = 0, occupied = 0;
  for (std::size_t i = 0; i < voxels.run.size(); ++i) {
    const std::int64_t until = std::min(count, at + std::max(0, voxels.run[i]));
    if (i % 2 == 1) occupied += until - at;
    at = until;
  }
  return occupied <= kMostOccupied;
}

OccupiedVoxels Unpack(const voxels_t& voxels) {
  OccupiedVoxels grid{voxels.size[0], voxels.size[1], voxels.size[2], {}};
  grid.number.assign(static_cast<std::size_t>(grid.width * grid.depth * grid.height),
                     OccupiedVoxels::kEmpty);
  const auto end = static_cast<std::int64_t>(grid.number.size());
  std::int64_t at = 0;
  std::int32_t number = 0;
  bool is_occupied = false;
  for (const std::int32_t run : voxels.run) {
    const std::int64_t until = std::min(end, at + std::max(0, run));
    for (; is_occupied && at < until; ++at) grid.number[static_cast<std::size_t>(at)] = number++;
    at = until;
    is_occupied = !is_occupied;
  }
  return grid;
}

template <typename Points>
void AddLine(int kind, const Points& points, ByteWriter& writer) {
  writer.Add(static_cast<float>(points.size()));
  writer.Add(static_cast<float>(kind));
  for (const Vector2& p : points) writer.AddFloats(p);
}

}  // namespace

std::string PoseBytes(const DrawnPose& pose) {
  ByteWriter writer;
  const PoseRow& row = pose.row;
  writer.Add(std::uint8_t{1});
  writer.Add(static_cast<std::uint8_t>(pose.person));
  writer.Add(static_cast<std::uint8_t>(row.state));
  writer.Add(static_cast<std::uint8_t>(row.has_pose));
  writer.Add(static_cast<std::uint16_t>(kPointCount));
  writer.Add(static_cast<std::uint16_t>(pose.capsules.size()));
  writer.Add(static_cast<double>(row.timestamp_ns) / kNsPerMs);
  writer.Add(pose.publish_ms);
  writer.Add(static_cast<double>(row.frame));
  writer.Add(static_cast<float>(row.residual_mm));
  writer.Add(static_cast<std::uint32_t>(std::max(0, row.voxels)));
  for (int i = 0; i < kPointCount; ++i) writer.AddFloats(row.points_W.col(i));
  for (const PosedCapsule& capsule : pose.capsules) {
    writer.AddFloats(capsule.a_W);
    writer.Add(static_cast<float>(capsule.radius_a_mm));
    writer.AddFloats(capsule.b_W);
    writer.Add(static_cast<float>(capsule.radius_b_mm));
  }
  writer.Add(static_cast<std::uint32_t>(pose.id));
  writer.Add(static_cast<float>(row.probability));
  writer.Add(static_cast<float>(pose.rival ? pose.rival->probability : 0));
  if (pose.rival) writer.AddFloats(pose.rival->points_W.reshaped());
  for (int i = 0; i < kContactCount; ++i) {
    writer.AddFloats(FurtherOf(row.further_W, kContactPoints[i]));
    writer.Add(static_cast<float>(row.contacts[i]));
  }
  return writer.Take();
}

std::string VoxelBytes(const voxels_t& voxels, int person) {
  if (!IsSound(voxels)) return {};
  const OccupiedVoxels grid = Unpack(voxels);
  ByteWriter cells;
  std::uint32_t count = 0;
  for (std::int64_t z = 0, at = 0; z < grid.height; ++z) {
    for (std::int64_t y = 0; y < grid.depth; ++y) {
      for (std::int64_t x = 0; x < grid.width; ++x, ++at) {
        const std::int32_t number = grid.number[static_cast<std::size_t>(at)];
        if (number == OccupiedVoxels::kEmpty || grid.IsInside(x, y, z)) continue;
        const auto label = static_cast<std::size_t>(number);
        cells.Add(static_cast<std::uint16_t>(x));
        cells.Add(static_cast<std::uint16_t>(y));
        cells.Add(static_cast<std::uint16_t>(z));
        cells.Add(static_cast<std::int16_t>(label < voxels.label.size() ? voxels.label[label]
                                                                        : std::int16_t{-1}));
        ++count;
      }
    }
  }
  ByteWriter writer;
  writer.Add(std::uint8_t{2});
  writer.Add(static_cast<std::uint8_t>(person));
  writer.Add(std::uint16_t{0});
  writer.Add(count);
  writer.Add(static_cast<double>(voxels.utime) / 1000);
  writer.Add(static_cast<float>(voxels.voxel_mm));
  for (const double origin : voxels.origin_mm) writer.Add(static_cast<float>(origin));
  return writer.Take() + cells.Take();
}

std::string PictureBytes(const DrawnPicture& picture) {
  constexpr int kSides = 4;
  ByteWriter trimap, body;
  for (const std::vector<Vector2>& line : picture.silhouette) AddLine(0, line, trimap);
  for (const std::vector<Vector2>& line : picture.unknown) AddLine(1, line, trimap);
  for (const DrawnOutlines& one : picture.bodies) {
    for (const BodyLine& line : one.lines) {
      AddLine(static_cast<int>(line.side) + kSides * (one.person + 1), line.pixels, body);
    }
  }
  const std::string lines = trimap.Take(), body_lines = body.Take();
  ByteWriter writer;
  writer.Add(std::uint8_t{3});
  writer.Add(static_cast<std::uint8_t>(picture.camera));
  writer.Add(static_cast<std::uint16_t>(picture.width_px));
  writer.Add(static_cast<std::uint16_t>(picture.height_px));
  writer.Add(std::uint16_t{0});
  writer.Add(picture.capture_ms);
  writer.Add(static_cast<std::uint32_t>(lines.size() / sizeof(float)));
  writer.Add(static_cast<std::uint32_t>(body_lines.size() / sizeof(float)));
  writer.Add(static_cast<std::uint32_t>(picture.jpeg.size()));
  writer.Add(static_cast<float>(picture.unknown_share.value_or(-1)));
  std::string bytes = writer.Take() + lines + body_lines;
  bytes.append(picture.jpeg.begin(), picture.jpeg.end());
  bytes.resize((bytes.size() + 7) / 8 * 8, '\0');
  return bytes;
}

std::string KeypointBytes(const KeypointView& view, int camera) {
  ByteWriter writer;
  writer.Add(std::uint8_t{4});
  writer.Add(static_cast<std::uint8_t>(camera));
  writer.Add(static_cast<std::uint16_t>(view.points.size()));
  writer.Add(static_cast<std::uint32_t>(view.person));
  writer.Add(static_cast<double>(view.capture_ns) / kNsPerMs);
  for (const Keypoint& point : view.points) {
    writer.Add(static_cast<float>(point.landmark));
    writer.AddFloats(point.px);
    writer.Add(point.score);
  }
  return writer.Take();
}

}  // namespace mocap
