#include "core/reconstruction/carving/carver.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <vector>

#include "core/errors.h"
#include "core/reconstruction/carving/octant_view.h"
#include "core/reconstruction/carving/room_blocks.h"
#include "core/reconstruction/carving/sample_bits.h"
#include "core/reconstruction/carving/window_map.h"

namespace mocap {
namespace {

constexpr int kMostViews = Carver::kMostViews;
constexpr int kLargestBlock_voxels = RoomBlocks::kBlock_voxels;
constexpr int kLevels = 5;  // From the largest block to a voxel.
static_assert(1 << (kLevels - 1) == kLargestBlock_voxels);

int Fewest(std::size_t views) { return std::max(2, (static_cast<int>(views) + 1) / 2); }

}  // namespace

// One descent through the grid. Blocks that all cameras agree on are decided whole. The result is
// the same as testing every sample of every voxel in every camera.
class Carver::Walk {
 public:
  explicit Walk(const CarvingOptions& options)
      : voxel_mm_(options.voxel_mm),
        several_people_(options.several_people),
        is_hard_(options.hard_silhouettes) {}

  void Carve(std::span<const CarvingView> views, VoxelGrid& grid,
             std::vector<Eigen::Vector3i>* doubtful);
  const Eigen::AlignedBox3d& person_box_W() const { return person_box_W_; }

 private:
  enum class Content { kEmpty, kDoubtful, kPerson };
  // A cube of voxels and what is known about it.
  struct Block {
    Eigen::Vector3i first;  // Within the grid.
    int side = 0;           // [voxels]
    int level = 0;
    int seeing = 0;       // Cameras that have all of it in their silhouette.
    int outweighing = 0;  // Cameras that must show it, since some call it empty.
    int undecided = 0;    // Cameras that have not decided yet: the first in `views`.
    std::array<std::uint8_t, kMostViews> views;
    // Index of the view's frame that contains the block: kLanes · level + octant, or kNoFrame.
    std::array<std::uint8_t, kMostViews> frames;
  };
  static constexpr std::uint8_t kNoFrame = 255;

  void Prepare();
  void Visit(const Block& block);
  bool VisitSamples(const Block& block);
  void VisitVoxel(const Block& voxel);
  void Decide(const Block& block, std::span<const SampleDecisions> decisions, std::uint8_t asked,
              std::uint64_t alive);
  OctantDecisions Judge(const Block& block, int i, float spread, float half, std::uint8_t& framed);
  std::uint8_t OctantsInGrid(const Block& block) const;
  void Fill(const Block& block);
  Content AskSamples(const Block& block, std::span<const SampleDecisions> decisions, int voxel,
                     unsigned agrees, unsigned doubtful, unsigned open) const;
  Content AskSample(const Block& block, std::span<const SampleDecisions> decisions, int voxel,
                    int sample) const;
  std::optional<WindowMap::Kind> Look(int view, const Vector3& p_W) const;

  static Eigen::Vector3i VoxelAt(const Block& block, int voxel) {
    return block.first + Eigen::Vector3i(voxel & 1, voxel >> 1 & 1, voxel >> 2);
  }
  // What a view carves at once of that which it calls empty: enough others can no longer show it.
  template <typename Bits>
  Bits Carved(std::size_t view, Bits outside, Bits denied) const {
    const auto others = static_cast<int>(views_.size()) - 1;
    const int outweighed_by = views_[view].outweighed_by;
    if (outweighed_by > others) return outside;
    return outweighed_by + least_outweighed_by_ > others - 1 ? outside & denied : 0;
  }
  float VoxelMm() const { return static_cast<float>(voxel_mm_); }
  Eigen::Vector3f MiddleOf(const Block& block) const {
    return (block.first.cast<float>().array() + static_cast<float>(block.side) / 2) * VoxelMm();
  }
  const OctantFrames& FramesOf(const Block& block, int i) const {
    return frames_[block.views[i]][block.frames[i] / OctantFrames::kLanes];
  }

  double voxel_mm_;
  bool several_people_, is_hard_;
  int fewest_ = 0;
  int least_outweighed_by_ = 0;
  VoxelGrid* grid_ = nullptr;
  std::vector<Eigen::Vector3i>* doubtful_ = nullptr;
  RoomBlocks room_;
  VolumeOfInterest volume_;
  Eigen::AlignedBox3d person_box_W_;
  std::vector<CarvingView> all_;    // Of the set.
  std::vector<CarvingView> views_;  // Those that see something.
  std::vector<WindowMap> windows_;
  std::vector<OctantView> octant_views_;
  // One per view, indexed by the level of the block that is split into octants.
  std::vector<std::array<OctantFrames, kLevels>> frames_;
};

void Carver::Walk::Carve(std::span<const CarvingView> views, VoxelGrid& grid,
                         std::vector<Eigen::Vector3i>* doubtful) {
  MOCAP_CHECK(views.size() <= kMostViews);
  grid.Reset(Eigen::Vector3i::Zero(), Eigen::Vector3i::Zero(), voxel_mm_);
  if (doubtful) doubtful->clear();
  all_.assign(views.begin(), views.end());
  if (is_hard_) std::ranges::for_each(all_, [](CarvingView& view) { view.unknown = nullptr; });
  fewest_ = Fewest(all_.size());
  person_box_W_ = volume_.Find(all_).value_or(Eigen::AlignedBox3d());
  if (person_box_W_.isEmpty() && !several_people_) return;
  room_.Find(all_, fewest_, voxel_mm_, several_people_ ? Eigen::AlignedBox3d() : person_box_W_);
  if (room_.blocks().empty()) return;
  grid.Reset(room_.first_voxel(), room_.size_voxels(), voxel_mm_);
  Prepare();
  grid_ = &grid;
  doubtful_ = doubtful;
  for (std::size_t i = 0; i < views_.size(); ++i)
    octant_views_[i].Set(views_[i], grid.origin_W(), windows_[i]);

  Block block;
  block.side = kLargestBlock_voxels;
  block.undecided = static_cast<int>(views_.size());
  for (int i = 0; i < block.undecided; ++i) {
    block.views[i] = static_cast<std::uint8_t>(i);
    block.frames[i] = kNoFrame;
  }
  for (const Eigen::Vector3i& first : room_.blocks()) {
    block.first = first;
    Visit(block);
  }
}

// Measures the silhouettes of all cameras that see something.
void Carver::Walk::Prepare() {
  views_.clear();
  if (windows_.size() < all_.size()) {
    windows_.resize(all_.size());
    octant_views_.resize(all_.size());
    frames_.resize(all_.size());
  }
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const std::optional<PixelBox>& box = volume_.boxes()[i];
    if (!box) continue;
    windows_[views_.size()].Measure(*all_[i].silhouette, all_[i].unknown, *box);
    views_.push_back(all_[i]);
  }
  least_outweighed_by_ = kNeverOutweighed;
  for (const CarvingView& view : views_)
    least_outweighed_by_ = std::min(least_outweighed_by_, view.outweighed_by);
}

// Tests the octants of a block in its i-th undecided view.
OctantDecisions Carver::Walk::Judge(const Block& block, int i, float spread, float half,
                                    std::uint8_t& framed) {
  const std::uint8_t view = block.views[i];
  const OctantView& eye = octant_views_[view];
  framed = 0;
  if (block.frames[i] != kNoFrame)
    return eye.JudgeByFrame(FramesOf(block, i), block.frames[i] % OctantFrames::kLanes,
                            MiddleOf(block), spread, half);
  return eye.Project(MiddleOf(block), spread, half, frames_[view][block.level], framed);
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
  if (block.side == 2 && VisitSamples(block)) return;
  const int side = block.side / 2;
  const float spread = static_cast<float>(side) / 2 * VoxelMm();
  // Samples lie closer to the centre than the corners of the voxels.
  const float half = (static_cast<float>(side) - 1.0f / kSamplesPerSide) / 2 * VoxelMm();
  std::uint8_t alive = OctantsInGrid(block);
  std::uint8_t denied = block.outweighing > 0 ? 0xff : 0;
  std::array<std::uint8_t, kMostViews> inside, outside, decided, framed;
  for (int i = 0; i < block.undecided; ++i) {
    const OctantDecisions decisions = Judge(block, i, spread, half, framed[i]);
    alive &= static_cast<std::uint8_t>(~Carved(block.views[i], decisions.outside, denied));
    if (alive == 0) return;
    denied |= decisions.outside;
    inside[i] = decisions.inside;
    outside[i] = decisions.outside;
    decided[i] = decisions.inside | decisions.unseen | decisions.outside;
  }
  Block octant;
  octant.side = side;
  octant.level = block.level + 1;
  for (; alive != 0; alive &= static_cast<std::uint8_t>(alive - 1)) {
    const int bit = std::countr_zero(alive);
    octant.seeing = block.seeing;
    octant.outweighing = block.outweighing;
    octant.undecided = 0;
    for (int i = 0; i < block.undecided; ++i) {
      const bool is_framed = block.frames[i] == kNoFrame && (framed[i] >> bit & 1);
      octant.seeing += inside[i] >> bit & 1;
      octant.outweighing += (outside[i] >> bit & 1) * views_[block.views[i]].outweighed_by;
      // The next view overwrites the entry if this one is decided: faster than a branch.
      octant.views[octant.undecided] = block.views[i];
      octant.frames[octant.undecided] =
          is_framed ? static_cast<std::uint8_t>(block.level * OctantFrames::kLanes + bit)
                    : block.frames[i];
      octant.undecided += ~decided[i] >> bit & 1;
    }
    if (octant.seeing + octant.undecided < std::max(fewest_, octant.outweighing)) continue;
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

// Decides eight voxels at a time if all cameras have frames.
bool Carver::Walk::VisitSamples(const Block& block) {
  for (int i = 0; i < block.undecided; ++i)
    if (block.frames[i] == kNoFrame) return false;
  std::uint8_t asked = OctantsInGrid(block);
  std::uint64_t alive = ~std::uint64_t{0};
  std::uint64_t denied = block.outweighing > 0 ? alive : 0;
  std::array<SampleDecisions, kMostViews> decisions;
  const Eigen::Vector3f middle = MiddleOf(block);
  for (int i = 0; i < block.undecided; ++i) {
    decisions[i] = octant_views_[block.views[i]].JudgeSamplesByFrame(
        FramesOf(block, i), block.frames[i] % OctantFrames::kLanes, middle, VoxelMm() / 2,
        VoxelMm() / kSamplesPerSide / 2, asked);
    alive &= ~Carved(block.views[i], decisions[i].outside, denied);
    denied |= decisions[i].outside;
    asked &= Majorities(alive);
    if (asked == 0) return true;
  }
  Decide(block, {decisions.data(), static_cast<std::size_t>(block.undecided)}, asked, alive);
  return true;
}

// The octants of a voxel are its samples.
void Carver::Walk::VisitVoxel(const Block& voxel) {
  std::uint64_t alive = SpreadBits(0xff);
  std::uint64_t denied = voxel.outweighing > 0 ? alive : 0;
  std::array<SampleDecisions, kMostViews> decisions;
  for (int i = 0; i < voxel.undecided; ++i) {
    std::uint8_t framed;
    const OctantDecisions samples = Judge(voxel, i, VoxelMm() / kSamplesPerSide / 2, 0, framed);
    decisions[i] = {SpreadBits(samples.inside), SpreadBits(samples.outside),
                    SpreadBits(samples.unseen), SpreadBits(samples.unknown)};
    alive &= ~Carved(voxel.views[i], decisions[i].outside, denied);
    if (alive == 0) return;
    denied |= decisions[i].outside;
  }
  Decide(voxel, {decisions.data(), static_cast<std::size_t>(voxel.undecided)}, 1, alive);
}

// Decides the voxels in `asked`, up to eight, from what each undecided view knows about the
// samples.
void Carver::Walk::Decide(const Block& block, std::span<const SampleDecisions> decisions,
                          std::uint8_t asked, std::uint64_t alive) {
  // Samples that at least n views show as the person, do not know, and do either.
  std::array<std::uint64_t, kMostViews + 1> person, unknown, seen;
  const auto views = static_cast<int>(decisions.size());
  for (auto* const counts : {&person, &unknown, &seen}) {
    (*counts)[0] = ~std::uint64_t{0};
    std::fill_n(counts->begin() + 1, views, 0);
  }
  std::uint64_t open = 0;
  int counted = 0;
  for (const SampleDecisions& v : decisions) {
    ++counted;
    for (int n = counted; n > 0; --n) {
      person[n] |= person[n - 1] & v.inside;
      unknown[n] |= unknown[n - 1] & v.unknown;
      seen[n] |= seen[n - 1] & (v.inside | v.unknown);
    }
    open |= ~(v.inside | v.unseen | v.unknown);
  }
  open &= alive;
  const int needed = std::max(fewest_ - block.seeing, 0);
  const std::uint64_t possible = needed <= views ? alive & seen[needed] & ~open : 0;
  std::uint64_t agrees = possible;
  for (int n = 0; n <= views; ++n) {
    const int shown = std::max(n + block.outweighing - block.seeing, 0);
    agrees &= ~unknown[n] | (shown <= views ? person[shown] : 0);
  }
  const bool may_doubt = doubtful_ && block.outweighing == 0;
  const std::uint64_t doubtful = may_doubt ? possible & ~agrees : 0;
  asked &= Majorities(agrees | doubtful | open);
  const std::uint8_t agreed = Majorities(agrees);
  for (; asked != 0; asked &= static_cast<std::uint8_t>(asked - 1)) {
    const int voxel = std::countr_zero(asked);
    const Content content = agreed >> voxel & 1
                                ? Content::kPerson
                                : AskSamples(block, decisions, voxel, SamplesOf(agrees, voxel),
                                             SamplesOf(doubtful, voxel), SamplesOf(open, voxel));
    const Eigen::Vector3i at = VoxelAt(block, voxel);
    if (content == Content::kPerson) grid_->Set(at.x(), at.y(), at.z());
    if (content == Content::kDoubtful && doubtful_) doubtful_->push_back(at);
  }
}

// Tests a voxel's open samples exactly, as long as the result depends on them.
Carver::Walk::Content Carver::Walk::AskSamples(const Block& block,
                                               std::span<const SampleDecisions> decisions,
                                               int voxel, unsigned agrees, unsigned doubtful,
                                               unsigned open) const {
  for (; open != 0; open &= open - 1) {
    const int sample = std::countr_zero(open);
    const Content content = AskSample(block, decisions, voxel, sample);
    if (content == Content::kPerson) agrees |= 1u << sample;
    if (content == Content::kDoubtful) doubtful |= 1u << sample;
    if (std::popcount(agrees) >= kMajority) return Content::kPerson;
    if (std::popcount(agrees | doubtful | (open & (open - 1))) < kMajority) return Content::kEmpty;
  }
  return std::popcount(agrees | doubtful) >= kMajority ? Content::kDoubtful : Content::kEmpty;
}

// Tests a sample exactly in those cameras that have not decided it yet.
Carver::Walk::Content Carver::Walk::AskSample(const Block& block,
                                              std::span<const SampleDecisions> decisions, int voxel,
                                              int sample) const {
  const Vector3 corner_W =
      (grid_->first_voxel() + VoxelAt(block, voxel)).cast<double>() * voxel_mm_;
  const Vector3 p_W =
      corner_W + Vector3((sample & 1) + 0.5, (sample >> 1 & 1) + 0.5, (sample >> 2) + 0.5) *
                     (voxel_mm_ / kSamplesPerSide);
  const int bit = 8 * sample + voxel;
  int persons = block.seeing;
  int unknown = 0;
  int outweighing = block.outweighing;
  for (std::size_t i = 0; i < decisions.size(); ++i) {
    const SampleDecisions& known = decisions[i];
    if (known.unseen >> bit & 1) continue;
    std::optional<WindowMap::Kind> kind;
    if (known.inside >> bit & 1)
      kind = WindowMap::Kind::kInside;
    else if (known.unknown >> bit & 1)
      kind = WindowMap::Kind::kUnknown;
    else if (known.outside >> bit & 1)
      kind = WindowMap::Kind::kOutside;
    else
      kind = Look(block.views[i], p_W);
    if (kind == WindowMap::Kind::kOutside) {
      outweighing += views_[block.views[i]].outweighed_by;
      if (outweighing >= static_cast<int>(views_.size())) return Content::kEmpty;
    }
    if (kind == WindowMap::Kind::kInside) ++persons;
    if (kind == WindowMap::Kind::kUnknown) ++unknown;
  }
  if (persons + unknown < fewest_) return Content::kEmpty;
  if (persons >= unknown + outweighing) return Content::kPerson;
  return outweighing > 0 ? Content::kEmpty : Content::kDoubtful;
}

// Evaluates the definition at one point; empty if the camera does not see it.
std::optional<WindowMap::Kind> Carver::Walk::Look(int view, const Vector3& p_W) const {
  const CarvingView& eye = views_[view];
  const Vector3 p_C = eye.X_CW * p_W;
  if (p_C.z() <= 0) return std::nullopt;
  const SensorPlaneTable::Pixel pixel = eye.table->Lookup(p_C.x() / p_C.z(), p_C.y() / p_C.z());
  if (pixel.x < 0) return std::nullopt;
  return windows_[view].At(pixel.x, pixel.y);
}

Carver::Carver(const CarvingOptions& options) : walk_(std::make_unique<Walk>(options)) {}
Carver::Carver(Carver&&) noexcept = default;
Carver& Carver::operator=(Carver&&) noexcept = default;
Carver::~Carver() = default;

void Carver::Carve(std::span<const CarvingView> views, VoxelGrid& grid,
                   std::vector<Eigen::Vector3i>* doubtful) {
  walk_->Carve(views, grid, doubtful);
}
const Eigen::AlignedBox3d& Carver::person_box_W() const { return walk_->person_box_W(); }

}  // namespace mocap
