// Beyond the paper: how much of the people each camera takes for the empty studio.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "core/reconstruction/carving/carver.h"
#include "core/reconstruction/carving/carving_view.h"
#include "core/reconstruction/carving/voxel_pieces.h"

namespace mocap {

/// Share of a hull of k cameras that one more camera carves, mean over true masks of three
/// simulated people. It falls as 1 / k²; `mocap benchmark --parts evidence` prints it.
constexpr double CarvedByOneMore(int k) { return 1.7 / (k * k); }

/// Finds cameras that call empty what the others show, and weighs them. What one camera calls empty
/// is rightly carved or missed. Once that is missed more often than one more camera would carve
/// rightly, its word no longer holds against the others. Thread-bound; reuses its memory.
class MissRates {
 public:
  MissRates(std::size_t cameras, bool several_people);

  /// Sets how many others outweigh each view. Looks at the people once a second of capture time.
  /// @param cameras  bit i: camera i is in the set. The views are those, in this order.
  void Weigh(std::span<CarvingView> views, std::uint64_t cameras, std::int64_t capture_ns);

  /// Share of the people that a camera missed, beyond what one more camera rightly carves, 0 to 1:
  /// mean of the latest moments. Empty before, and if fewer than three others see them.
  std::optional<double> Of(int camera) const;

 private:
  struct Count {
    std::int64_t shown = 0, missed = 0;
  };

  void Look(std::span<const CarvingView> views, std::uint64_t cameras);
  void CountCell(const VoxelPieces::Run& run, int i, std::span<const CarvingView> views);
  int OutweighedBy(int camera) const;

  Carver carver_;
  VoxelGrid hull_;
  VoxelPieces pieces_;
  std::vector<CarvingView> views_;
  std::vector<bool> sees_people_;            // By view; who sees nobody carves nothing.
  std::vector<Count> pieces_missed_;         // By piece: cells that any view misses.
  std::vector<std::vector<Count>> counts_;   // By piece and view.
  std::vector<std::deque<double>> moments_;  // The latest shares of each camera.
  std::optional<std::int64_t> last_ns_;      // When people were looked at.
};

/// Sets by how many others each view of a single set is outweighed.
void WeighOnce(std::span<CarvingView> views, bool several_people);

}  // namespace mocap
