#include "core/reconstruction/carver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/errors.h"
#include "core/reconstruction/bit_filters.h"
#include "core/reconstruction/volume_of_interest.h"

namespace mocap {
namespace {

constexpr int kMostViews = 32;
constexpr int kLargestBlock_voxels = 16;
constexpr int kSamplesPerSide = 2;
constexpr int kMajority = kSamplesPerSide * kSamplesPerSide * kSamplesPerSide / 2 + 1;
// More than the rounding of the table's floats can move a place.
constexpr double kRounding_px = 0.05;

// Half the width of the gaps in a silhouette that may be holes [px], and of how many cameras one
// may be wrong about them.
constexpr int kGap_px = 6;
constexpr int kCamerasPerDoubt = 5;

// kGap: not in the silhouette, but in a gap that it nearly surrounds.
enum class Verdict { kInside, kGap, kOutside, kUnseen, kUndecided };

int Fewest(std::size_t views) { return std::max(2, (static_cast<int>(views) + 1) / 2); }

// A silhouette with its gaps closed: dilated, then eroded by as much.
void CloseGaps(const Silhouette& silhouette, Silhouette& scratch, Silhouette& closed) {
  closed = silhouette;
  for (int width = 0; width < kGap_px; width += 2) {
    Dilate(closed, 2, scratch);
    std::swap(closed, scratch);
  }
  for (int width = 0; width < kGap_px; width += 2) {
    Erode(closed, 2, scratch);
    std::swap(closed, scratch);
  }
}

// How one camera judges one place.
Verdict JudgePlace(const CarvingView& view, const Silhouette& closed, const Vector3& p_W) {
  const Vector3 p_C = view.X_CW * p_W;
  if (p_C.z() <= 0) return Verdict::kUnseen;
  const SensorPlaneTable::Pixel pixel = view.table->Lookup(p_C.x() / p_C.z(), p_C.y() / p_C.z());
  if (pixel.x < 0) return Verdict::kUnseen;
  if (view.silhouette->Test(pixel.x, pixel.y)) return Verdict::kInside;
  return closed.Test(pixel.x, pixel.y) ? Verdict::kGap : Verdict::kOutside;
}

// How one camera judges all places within `radius_mm` around p_W at once; undecided where they may
// differ.
Verdict JudgeBall(const CarvingView& view, const DistanceMap& distances,
                  const DistanceMap& closed_distances, const Vector3& p_W, double radius_mm) {
  const Vector3 p_C = view.X_CW * p_W;
  if (p_C.z() <= -radius_mm) return Verdict::kUnseen;
  if (p_C.z() <= 2 * radius_mm) return Verdict::kUndecided;
  const double x = p_C.x() / p_C.z();
  const double y = p_C.y() / p_C.z();
  const double radius = radius_mm * std::sqrt(1 + x * x + y * y) / (p_C.z() - radius_mm);
  const SensorPlaneTable& table = *view.table;
  if (table.Misses(x, y, radius)) return Verdict::kUnseen;
  if (!table.Shows(x, y, radius)) return Verdict::kUndecided;
  SensorPlaneTable::Place place;
  if (!table.Locate(static_cast<float>(x), static_cast<float>(y), place))
    return Verdict::kUndecided;
  const int reach =
      static_cast<int>(radius * static_cast<double>(table.pixels_per_unit()) + kRounding_px) + 1;
  const int column = static_cast<int>(std::floor(place.x_px + 0.5f));
  const int row = static_cast<int>(std::floor(place.y_px + 0.5f));
  const int margin =
      std::min({column, row, table.width_px() - 1 - column, table.height_px() - 1 - row});
  if (margin < -reach) return Verdict::kUnseen;
  if (margin < reach) return Verdict::kUndecided;
  const int distance = distances.At(column, row);
  if (distance > reach) return Verdict::kInside;
  const int closed_distance = closed_distances.At(column, row);
  if (closed_distance < -reach) return Verdict::kOutside;
  if (distance < -reach && closed_distance > reach) return Verdict::kGap;
  return Verdict::kUndecided;
}

}  // namespace

// A cube of voxels, and what is known of it.
struct Carver::Block {
  Eigen::Vector3i first;  // Within the grid.
  int side = 0;           // [voxels]
  int seeing = 0;         // Cameras that have all of it in their silhouette.
  int gaps = 0;           // Cameras that have all of it in a gap.
  int undecided = 0;      // Cameras that are yet to be asked: the first in `views`.
  std::array<std::uint8_t, kMostViews> views;
};

// One descent through the grid. Blocks that all cameras agree on are decided whole; the outcome is
// that of asking every camera about every sample of every voxel.
class Carver::Walk {
 public:
  Walk(std::span<const CarvingView> views, std::span<const Outline> outlines, int fewest,
       int most_gaps, VoxelGrid& grid)
      : views_(views), outlines_(outlines), fewest_(fewest), most_gaps_(most_gaps), grid_(grid) {}

  void Visit(Block block) {
    if ((block.first.array() >= grid_.size().array()).any()) return;
    // The samples lie closer to the middle than the voxels' corners do.
    const double half_mm = (block.side - 1.0 / kSamplesPerSide) / 2 * grid_.voxel_mm();
    const Vector3 middle_W =
        grid_.origin_W() +
        (block.first.cast<double>().array() + block.side / 2.0).matrix() * grid_.voxel_mm();
    int undecided = 0;
    for (int i = 0; i < block.undecided; ++i) {
      const std::uint8_t view = block.views[i];
      const Verdict verdict =
          JudgeBall(views_[view], outlines_[view].distances, outlines_[view].closed_distances,
                    middle_W, half_mm * std::sqrt(3.0));
      if (verdict == Verdict::kOutside) return;
      if (verdict == Verdict::kGap && ++block.gaps > most_gaps_) return;
      if (verdict == Verdict::kInside) ++block.seeing;
      if (verdict == Verdict::kUndecided) block.views[undecided++] = view;
    }
    block.undecided = undecided;
    if (block.seeing + undecided < fewest_) return;
    if (undecided == 0) {
      Fill(block);
    } else if (block.side == 1) {
      if (MajorityAgrees(block)) grid_.Set(block.first.x(), block.first.y(), block.first.z());
    } else {
      VisitOctants(block);
    }
  }

 private:
  void VisitOctants(const Block& block) {
    Block octant = block;
    octant.side = block.side / 2;
    for (int i = 0; i < 8; ++i) {
      octant.first = block.first + octant.side * Eigen::Vector3i(i & 1, i >> 1 & 1, i >> 2);
      Visit(octant);
    }
  }

  void Fill(const Block& block) {
    const Eigen::Vector3i end = (block.first.array() + block.side).matrix().cwiseMin(grid_.size());
    for (int k = block.first.z(); k < end.z(); ++k)
      for (int j = block.first.y(); j < end.y(); ++j)
        for (int i = block.first.x(); i < end.x(); ++i) grid_.Set(i, j, k);
  }

  bool MajorityAgrees(const Block& voxel) const {
    const Vector3 corner_W = (grid_.first_voxel() + voxel.first).cast<double>() * grid_.voxel_mm();
    const double step_mm = grid_.voxel_mm() / kSamplesPerSide;
    int agreeing = 0;
    for (int k = 0; k < kSamplesPerSide; ++k)
      for (int j = 0; j < kSamplesPerSide; ++j)
        for (int i = 0; i < kSamplesPerSide; ++i)
          agreeing += SampleAgrees(voxel, corner_W + Vector3(i + 0.5, j + 0.5, k + 0.5) * step_mm);
    return agreeing >= kMajority;
  }

  bool SampleAgrees(const Block& voxel, const Vector3& p_W) const {
    int seeing = voxel.seeing;
    int gaps = voxel.gaps;
    for (int i = 0; i < voxel.undecided; ++i) {
      const std::uint8_t view = voxel.views[i];
      const Verdict verdict = JudgePlace(views_[view], outlines_[view].closed, p_W);
      if (verdict == Verdict::kOutside) return false;
      if (verdict == Verdict::kGap && ++gaps > most_gaps_) return false;
      seeing += verdict == Verdict::kInside;
    }
    return seeing >= fewest_;
  }

  std::span<const CarvingView> views_;
  std::span<const Outline> outlines_;
  int fewest_;
  int most_gaps_;
  VoxelGrid& grid_;
};

void Carver::Carve(std::span<const CarvingView> views, VoxelGrid& grid) {
  MOCAP_CHECK(views.size() <= kMostViews);
  const double voxel_mm = options_.voxel_mm;
  grid.Reset(Eigen::Vector3i::Zero(), Eigen::Vector3i::Zero(), voxel_mm);
  const std::optional<Eigen::AlignedBox3d> volume = FindVolumeOfInterest(views);
  if (!volume) return;
  seeing_.clear();
  for (const CarvingView& view : views)
    if (view.silhouette->BoundingBox()) seeing_.push_back(view);
  const int fewest = Fewest(views.size());
  if (static_cast<int>(seeing_.size()) < fewest) return;
  outlines_.resize(std::max(outlines_.size(), seeing_.size()));
  for (std::size_t i = 0; i < seeing_.size(); ++i) {
    Outline& outline = outlines_[i];
    CloseGaps(*seeing_[i].silhouette, scratch_, outline.closed);
    outline.distances.Measure(*seeing_[i].silhouette);
    outline.closed_distances.Measure(outline.closed);
  }

  const Vector3 first = (volume->min() / voxel_mm).array().floor();
  const Vector3 end = (volume->max() / voxel_mm).array().ceil();
  grid.Reset(first.cast<int>(), (end - first).cast<int>(), voxel_mm);
  Block block;
  block.side = kLargestBlock_voxels;
  block.undecided = static_cast<int>(seeing_.size());
  for (int i = 0; i < block.undecided; ++i) block.views[i] = static_cast<std::uint8_t>(i);
  const int most_gaps = static_cast<int>(views.size()) / kCamerasPerDoubt;
  Walk walk(seeing_, outlines_, fewest, most_gaps, grid);
  for (int k = 0; k < grid.size().z(); k += block.side)
    for (int j = 0; j < grid.size().y(); j += block.side)
      for (int i = 0; i < grid.size().x(); i += block.side) {
        block.first = {i, j, k};
        walk.Visit(block);
      }
}

}  // namespace mocap
