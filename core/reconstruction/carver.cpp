#include "core/reconstruction/carver.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <vector>

#include "core/errors.h"
#include "core/reconstruction/octant_view.h"
#include "core/reconstruction/volume_of_interest.h"
#include "core/reconstruction/window_map.h"

namespace mocap {
namespace {

constexpr int kMostViews = 32;
constexpr int kLargestBlock_voxels = 16;
constexpr int kLevels = 5;  // From the largest block to a voxel.
static_assert(1 << (kLevels - 1) == kLargestBlock_voxels);
constexpr int kSamplesPerSide = 2;
constexpr int kSamples = kSamplesPerSide * kSamplesPerSide * kSamplesPerSide;
constexpr int kMajority = kSamples / 2 + 1;

// Of so many cameras one may be wrong about a gap.
constexpr int kCamerasPerDoubt = 5;

int Fewest(std::size_t views) { return std::max(2, (static_cast<int>(views) + 1) / 2); }

}  // namespace

// One descent through the grid. Blocks that all cameras agree on are decided whole; the outcome is
// that of asking every camera about every sample of every voxel.
class Carver::Walk {
 public:
  explicit Walk(double voxel_mm) : voxel_mm_(voxel_mm) {}

  void Carve(std::span<const CarvingView> views, VoxelGrid& grid);

 private:
  // A cube of voxels and what is known of it.
  struct Block {
    Eigen::Vector3i first;  // Within the grid.
    int side = 0;           // [voxels]
    int level = 0;
    int seeing = 0;     // Cameras that have all of it in their silhouette.
    int undecided = 0;  // Cameras that are yet to be asked: the first in `views`.
    std::array<std::uint8_t, kMostViews> views;
    // Where the view's frame is that holds the block: kLanes · level + octant, or kNoFrame.
    std::array<std::uint8_t, kMostViews> frames;
  };
  static constexpr std::uint8_t kNoFrame = 255;

  bool Prepare(std::span<const CarvingView> views);
  void Visit(const Block& block);
  void VisitVoxel(const Block& voxel);
  OctantVerdicts Judge(const Block& block, int i, float spread, float half, std::uint8_t& framed);
  std::uint8_t OctantsInGrid(const Block& block) const;
  void Fill(const Block& block);
  bool SampleAgrees(const Block& voxel, int sample) const;

  Eigen::Vector3f MiddleOf(const Block& block) const {
    return (block.first.cast<float>().array() + static_cast<float>(block.side) / 2) *
           static_cast<float>(voxel_mm_);
  }

  double voxel_mm_;
  int fewest_ = 0;
  int most_gaps_ = 0;
  VoxelGrid* grid_ = nullptr;
  std::vector<CarvingView> views_;
  std::vector<WindowMap> windows_;
  std::vector<OctantView> octant_views_;
  // Of each view, by the level of the block whose octants they are.
  struct Frames {
    OctantFrames octants;
    Eigen::Vector3f middle;
    float spread = 0;
  };
  std::vector<std::array<Frames, kLevels>> frames_;
};

void Carver::Walk::Carve(std::span<const CarvingView> views, VoxelGrid& grid) {
  MOCAP_CHECK(views.size() <= kMostViews);
  grid.Reset(Eigen::Vector3i::Zero(), Eigen::Vector3i::Zero(), voxel_mm_);
  const std::optional<Eigen::AlignedBox3d> volume = FindVolumeOfInterest(views);
  if (!volume || !Prepare(views)) return;
  const Vector3 first = (volume->min() / voxel_mm_).array().floor();
  const Vector3 end = (volume->max() / voxel_mm_).array().ceil();
  grid.Reset(first.cast<int>(), (end - first).cast<int>(), voxel_mm_);
  grid_ = &grid;
  for (std::size_t i = 0; i < views_.size(); ++i)
    octant_views_[i].Set(views_[i], grid.origin_W(), windows_[i]);

  Block block;
  block.side = kLargestBlock_voxels;
  block.undecided = static_cast<int>(views_.size());
  for (int i = 0; i < block.undecided; ++i) {
    block.views[i] = static_cast<std::uint8_t>(i);
    block.frames[i] = kNoFrame;
  }
  for (int k = 0; k < grid.size().z(); k += block.side)
    for (int j = 0; j < grid.size().y(); j += block.side)
      for (int i = 0; i < grid.size().x(); i += block.side) {
        block.first = {i, j, k};
        Visit(block);
      }
}

// Returns whether there are enough cameras that see something.
bool Carver::Walk::Prepare(std::span<const CarvingView> views) {
  fewest_ = Fewest(views.size());
  most_gaps_ = static_cast<int>(views.size()) / kCamerasPerDoubt;
  views_.clear();
  if (windows_.size() < views.size()) {
    windows_.resize(views.size());
    octant_views_.resize(views.size());
    frames_.resize(views.size());
  }
  for (const CarvingView& view : views) {
    const std::optional<PixelBox> box = view.silhouette->BoundingBox();
    if (!box) continue;
    windows_[views_.size()].Measure(*view.silhouette, *box, most_gaps_ > 0);
    views_.push_back(view);
  }
  return static_cast<int>(views_.size()) >= fewest_;
}

// Asks the view at place `i` of a block's about the octants.
OctantVerdicts Carver::Walk::Judge(const Block& block, int i, float spread, float half,
                                   std::uint8_t& framed) {
  const std::uint8_t view = block.views[i];
  const OctantView& eye = octant_views_[view];
  const Eigen::Vector3f middle = MiddleOf(block);
  if (block.frames[i] == kNoFrame) {
    Frames& frames = frames_[view][block.level];
    frames.middle = middle;
    frames.spread = spread;
    return eye.Project(middle, spread, half, frames.octants, framed);
  }
  const int octant = block.frames[i] % OctantFrames::kLanes;
  const Frames& frames = frames_[view][block.frames[i] / OctantFrames::kLanes];
  const Eigen::Vector3f sign((octant & 1) * 2.0f - 1, (octant >> 1 & 1) * 2.0f - 1,
                             (octant >> 2) * 2.0f - 1);
  framed = 0;
  return eye.Glance(frames.octants, octant, middle - frames.middle - frames.spread * sign, spread,
                    half);
}

std::uint8_t Carver::Walk::OctantsInGrid(const Block& block) const {
  const Eigen::Vector3i middle = block.first.array() + block.side / 2;
  std::uint8_t octants = 0xff;
  if (middle.x() >= grid_->size().x()) octants &= 0x55;
  if (middle.y() >= grid_->size().y()) octants &= 0x33;
  if (middle.z() >= grid_->size().z()) octants &= 0x0f;
  return octants;
}

void Carver::Walk::Visit(const Block& block) {
  if (block.side == 1) return VisitVoxel(block);
  const int side = block.side / 2;
  const float voxel = static_cast<float>(voxel_mm_);
  const float spread = static_cast<float>(side) / 2 * voxel;
  // The samples lie closer to the middle than the voxels' corners do.
  const float half = (static_cast<float>(side) - 1.0f / kSamplesPerSide) / 2 * voxel;
  std::uint8_t alive = OctantsInGrid(block);
  std::array<std::uint8_t, kMostViews> inside, decided, framed;
  for (int i = 0; i < block.undecided; ++i) {
    const OctantVerdicts verdicts = Judge(block, i, spread, half, framed[i]);
    alive &= static_cast<std::uint8_t>(~verdicts.outside);
    if (alive == 0) return;
    inside[i] = verdicts.inside;
    decided[i] = verdicts.inside | verdicts.unseen;
  }
  Block octant;
  octant.side = side;
  octant.level = block.level + 1;
  for (; alive != 0; alive &= static_cast<std::uint8_t>(alive - 1)) {
    const int bit = std::countr_zero(alive);
    octant.seeing = block.seeing;
    octant.undecided = 0;
    for (int i = 0; i < block.undecided; ++i) {
      octant.seeing += inside[i] >> bit & 1;
      if (decided[i] >> bit & 1) continue;
      octant.views[octant.undecided] = block.views[i];
      octant.frames[octant.undecided++] =
          block.frames[i] == kNoFrame && (framed[i] >> bit & 1)
              ? static_cast<std::uint8_t>(block.level * OctantFrames::kLanes + bit)
              : block.frames[i];
    }
    if (octant.seeing + octant.undecided < fewest_) continue;
    octant.first = block.first + side * Eigen::Vector3i(bit & 1, bit >> 1 & 1, bit >> 2);
    if (octant.undecided == 0)
      Fill(octant);
    else
      Visit(octant);
  }
}

void Carver::Walk::Fill(const Block& block) {
  const Eigen::Vector3i end = (block.first.array() + block.side).matrix().cwiseMin(grid_->size());
  for (int k = block.first.z(); k < end.z(); ++k)
    for (int j = block.first.y(); j < end.y(); ++j)
      for (int i = block.first.x(); i < end.x(); ++i) grid_->Set(i, j, k);
}

// Its octants are the samples.
void Carver::Walk::VisitVoxel(const Block& voxel) {
  const float spread = static_cast<float>(voxel_mm_ / kSamplesPerSide / 2);
  std::uint8_t alive = 0xff, unknown = 0, gaps = 0;
  std::array<std::uint8_t, kMostViews> inside, gap;
  for (int i = 0; i < voxel.undecided; ++i) {
    std::uint8_t framed;
    const OctantVerdicts verdicts = Judge(voxel, i, spread, 0, framed);
    alive &= static_cast<std::uint8_t>(~verdicts.outside);
    if (std::popcount(alive) < kMajority) return;
    inside[i] = verdicts.inside;
    gap[i] = verdicts.gap & static_cast<std::uint8_t>(~verdicts.unseen);
    gaps |= gap[i];
    unknown |= static_cast<std::uint8_t>(~(verdicts.inside | verdicts.unseen | gap[i]));
  }
  unknown &= alive;
  if (gaps != 0 || voxel.seeing < fewest_) {
    for (int sample = 0; sample < kSamples; ++sample) {
      if (~alive >> sample & 1 || unknown >> sample & 1) continue;
      int seeing = voxel.seeing, lacking = 0;
      for (int i = 0; i < voxel.undecided; ++i) {
        seeing += inside[i] >> sample & 1;
        lacking += gap[i] >> sample & 1;
      }
      if (seeing < fewest_ || lacking > most_gaps_)
        alive &= static_cast<std::uint8_t>(~(1 << sample));
    }
  }
  // The doubtful ones are asked only where it depends on them.
  int agreeing = std::popcount(static_cast<std::uint8_t>(alive & ~unknown));
  int open = std::popcount(unknown);
  for (; agreeing < kMajority && agreeing + open >= kMajority; --open) {
    const int sample = std::countr_zero(unknown);
    unknown &= static_cast<std::uint8_t>(unknown - 1);
    agreeing += SampleAgrees(voxel, sample);
  }
  if (agreeing >= kMajority) grid_->Set(voxel.first.x(), voxel.first.y(), voxel.first.z());
}

bool Carver::Walk::SampleAgrees(const Block& voxel, int sample) const {
  const Vector3 corner_W = (grid_->first_voxel() + voxel.first).cast<double>() * voxel_mm_;
  const Vector3 p_W =
      corner_W + Vector3((sample & 1) + 0.5, (sample >> 1 & 1) + 0.5, (sample >> 2) + 0.5) *
                     (voxel_mm_ / kSamplesPerSide);
  int seeing = voxel.seeing;
  int gaps = 0;
  for (int i = 0; i < voxel.undecided; ++i) {
    const CarvingView& view = views_[voxel.views[i]];
    const Vector3 p_C = view.X_CW * p_W;
    if (p_C.z() <= 0) continue;
    const SensorPlaneTable::Pixel pixel = view.table->Lookup(p_C.x() / p_C.z(), p_C.y() / p_C.z());
    if (pixel.x < 0) continue;
    switch (windows_[voxel.views[i]].At(pixel.x, pixel.y)) {
      case WindowMap::Kind::kInside:
        ++seeing;
        break;
      case WindowMap::Kind::kGap:
        if (++gaps > most_gaps_) return false;
        break;
      case WindowMap::Kind::kOutside:
        return false;
    }
  }
  return seeing >= fewest_;
}

Carver::Carver(const CarvingOptions& options)
    : options_(options), walk_(std::make_unique<Walk>(options.voxel_mm)) {}
Carver::Carver(Carver&&) noexcept = default;
Carver& Carver::operator=(Carver&&) noexcept = default;
Carver::~Carver() = default;

void Carver::Carve(std::span<const CarvingView> views, VoxelGrid& grid) {
  walk_->Carve(views, grid);
}

}  // namespace mocap
