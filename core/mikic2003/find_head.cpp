#include "core/mikic2003/find_head.h"

#include <algorithm>
#include <cmath>

namespace mocap::mikic2003 {
namespace {

constexpr double kPaperVoxelMm = 25;
// Share of the most surface voxels in a crust that a head has at least; chosen on simulated people.
constexpr double kAlmostMost = 0.75;

// Counts the surface voxels in a crust around a cell.
class CrustCounter {
 public:
  CrustCounter(const VoxelCloud& cloud, const HeadCrust& crust)
      : stride_(std::max(1, static_cast<int>(kPaperVoxelMm / cloud.voxel_mm()))),
        margin_(static_cast<int>(std::ceil(crust.outer_mm / cloud.voxel_mm()))),
        size_(cloud.size_cells().array() + 2 * margin_) {
    is_surface_.assign(size_.cast<std::size_t>().prod(), false);
    for (const int voxel : cloud.surface()) is_surface_[SlotOf(cloud.voxels()[voxel].cell)] = true;
    ListCrust(cloud.voxel_mm(), crust);
  }

  bool IsTried(const Eigen::Vector3i& cell) const {
    return cell.x() % stride_ == 0 && cell.y() % stride_ == 0 && cell.z() % stride_ == 0;
  }

  std::ptrdiff_t CountAround(const Eigen::Vector3i& cell) const {
    const char* const center = is_surface_.data() + SlotOf(cell);
    return std::ranges::count_if(crust_, [center](std::ptrdiff_t step) { return center[step]; });
  }

 private:
  std::ptrdiff_t SlotOf(const Eigen::Vector3i& cell) const {
    const auto at = (cell.array() + margin_).cast<std::ptrdiff_t>();
    return (at.z() * size_.y() + at.y()) * size_.x() + at.x();
  }

  void ListCrust(double voxel_mm, const HeadCrust& crust) {
    const std::ptrdiff_t center = SlotOf(Eigen::Vector3i::Zero());
    for (int dz = -margin_; dz <= margin_; ++dz) {
      for (int dy = -margin_; dy <= margin_; ++dy) {
        for (int dx = -margin_; dx <= margin_; ++dx) {
          const Eigen::Vector3i step(dx, dy, dz);
          const double distance_mm = step.cast<double>().norm() * voxel_mm;
          if (distance_mm < crust.inner_mm || distance_mm > crust.outer_mm) continue;
          crust_.push_back(SlotOf(step) - center);
        }
      }
    }
  }

  int stride_;
  int margin_;  ///< Margin of empty cells around the cloud's, so that no crust leaves the array.
  Eigen::Vector3i size_;
  std::vector<char> is_surface_;
  std::vector<std::ptrdiff_t> crust_;  ///< Offsets of the crust's cells from its centre.
};

struct Candidate {
  int voxel;
  std::ptrdiff_t count;
};

// The candidates from the top down.
std::vector<Candidate> CandidatesIn(const VoxelCloud& cloud, const HeadCrust& crust,
                                    const std::optional<SearchRegion>& region) {
  const CrustCounter counter(cloud, crust);
  std::vector<Candidate> candidates;
  // Voxels are listed from the bottom up.
  for (int i = cloud.size() - 1; i >= 0; --i) {
    const Voxel& voxel = cloud.voxels()[i];
    if (voxel.surface || !counter.IsTried(voxel.cell)) continue;
    if (region && (voxel.center_W - region->center_W).norm() > region->radius_mm) continue;
    candidates.push_back({i, counter.CountAround(voxel.cell)});
  }
  return candidates;
}

// The voxel whose crust holds the most, near the uppermost that could be a head: the waist of a
// child fills a crust as well.
std::optional<int> FindCenter(const VoxelCloud& cloud, const HeadCrust& crust,
                              const std::optional<SearchRegion>& region) {
  const std::vector<Candidate> candidates = CandidatesIn(cloud, crust, region);
  const auto most = std::ranges::max_element(candidates, {}, &Candidate::count);
  if (most == candidates.end() || most->count == 0) return std::nullopt;
  const auto height = [&](const Candidate& at) { return cloud.voxels()[at.voxel].center_W.z(); };
  const auto first = std::ranges::find_if(candidates, [&](const Candidate& at) {
    return static_cast<double>(at.count) >= kAlmostMost * static_cast<double>(most->count);
  });
  const auto end = std::find_if(first, candidates.end(), [&](const Candidate& at) {
    return height(at) < height(*first) - crust.inner_mm;
  });
  return std::ranges::max_element(first, end, {}, &Candidate::count)->voxel;
}

// Adds hair to the head: pieces connected with the head alone.
void TakeHair(const VoxelCloud& cloud, Labels& labels, HeadFit& head) {
  std::vector<VoxelIndices> rest = ConnectedRegions(cloud, VoxelsLabeled(labels, kUnlabeled));
  const std::size_t sphere = head.voxels.size();
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (rest[i].size() > sphere) continue;
    if (BorderWith(cloud, labels, rest[i], LabelOf(BodyPart::kHead)).empty()) continue;
    head.voxels.insert(head.voxels.end(), rest[i].begin(), rest[i].end());
  }
  SetLabel(head.voxels, LabelOf(BodyPart::kHead), labels);
}

}  // namespace

HeadCrust CrustOf(const BodySizes& sizes, double voxel_mm) {
  constexpr double kBreadth = 0.87, kLength = 1.13;
  return {.inner_mm = (kBreadth * sizes.head_width - voxel_mm) / 2,
          .outer_mm = (kLength * sizes.head_width + voxel_mm) / 2,
          .reach_mm = sizes.head / 2};
}

std::optional<HeadFit> FindHead(const VoxelCloud& cloud, const HeadCrust& crust,
                                const std::optional<SearchRegion>& region) {
  const std::optional<int> center = FindCenter(cloud, crust, region);
  if (!center) return std::nullopt;

  HeadFit head;
  Labels labels(cloud.size(), kUnlabeled);
  const Vector3 center_W = cloud.voxels()[*center].center_W;
  for (int i = 0; i < cloud.size(); ++i) {
    if ((cloud.voxels()[i].center_W - center_W).norm() <= crust.reach_mm) head.voxels.push_back(i);
  }
  SetLabel(head.voxels, LabelOf(BodyPart::kHead), labels);
  TakeHair(cloud, labels, head);
  head.center_W = CentroidOf(cloud, head.voxels);
  const VoxelIndices border = BorderWith(cloud, labels, head.voxels, kUnlabeled);
  head.neck_W = border.empty() ? head.center_W : CentroidOf(cloud, border);
  return head;
}

}  // namespace mocap::mikic2003
