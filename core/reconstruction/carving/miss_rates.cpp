#include "core/reconstruction/carving/miss_rates.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace mocap {
namespace {

constexpr double kCell_mm = 25;
constexpr std::int64_t kPeriod_ns = 1'000'000'000;
constexpr std::size_t kMoments = 4;
// Fewer cannot tell what one camera misses from what it rightly carves.
constexpr int kFewestToOutweigh = 3;
// So many outweigh one in the hull that is looked at: up to one in five may miss the same cell.
constexpr int kOutweighing = 4;
// Where nobody is, each cell is called empty by some camera. Of a person, at least this share is
// missed by none, even if he is dressed like the wall.
constexpr double kLeastHeld = 0.1;

// Whether a view calls a point empty; nothing if it does not see it.
std::optional<bool> Misses(const CarvingView& view, const Vector3& p_W) {
  const Vector3 p_C = view.X_CW * p_W;
  if (p_C.z() <= 0) return {};
  const auto pixel = view.table->Lookup(p_C.x() / p_C.z(), p_C.y() / p_C.z());
  if (pixel.x < 0) return {};
  const bool has_unknown = view.unknown && view.unknown->width() > 0;
  return !view.silhouette->Test(pixel.x, pixel.y) &&
         !(has_unknown && view.unknown->Test(pixel.x, pixel.y));
}

}  // namespace

MissRates::MissRates(std::size_t cameras, bool several_people)
    : carver_({.voxel_mm = kCell_mm, .several_people = several_people}), moments_(cameras) {}

void MissRates::Weigh(std::span<CarvingView> views, std::uint64_t cameras,
                      std::int64_t capture_ns) {
  // The clock may be set back.
  const bool is_due = !last_ns_ || std::abs(capture_ns - *last_ns_) >= kPeriod_ns;
  if (is_due && static_cast<int>(views.size()) > kFewestToOutweigh) {
    Look(views, cameras);
    last_ns_ = capture_ns;
  }
  auto view = views.begin();
  for (std::size_t camera = 0; camera < moments_.size(); ++camera) {
    if (cameras >> camera & 1) (view++)->outweighed_by = OutweighedBy(static_cast<int>(camera));
  }
}

void MissRates::Look(std::span<const CarvingView> views, std::uint64_t cameras) {
  const int others = static_cast<int>(views.size()) - 1;
  views_.assign(views.begin(), views.end());
  sees_people_.clear();
  for (CarvingView& view : views_) {
    view.outweighed_by = std::min(kOutweighing, others);
    sees_people_.push_back(view.silhouette->BoundingBox().has_value());
  }
  carver_.Carve(views_, hull_);
  pieces_.Find(hull_);
  counts_.assign(pieces_.sizes().size(), std::vector<Count>(views.size()));
  pieces_missed_.assign(pieces_.sizes().size(), {});
  for (const VoxelPieces::Run& run : pieces_.runs()) {
    for (int i = run.begin; i < run.end; ++i) {
      // At the hull's surface, good silhouettes differ too.
      if (hull_.IsEnclosed(i, run.j, run.k)) CountCell(run, i, views);
    }
  }
  std::size_t view = 0;
  for (std::size_t camera = 0; camera < moments_.size(); ++camera) {
    if (!(cameras >> camera & 1)) continue;
    Count sum;
    for (std::size_t piece = 0; piece < counts_.size(); ++piece) {
      const auto [cells, missed] = pieces_missed_[piece];
      if (static_cast<double>(cells - missed) < kLeastHeld * static_cast<double>(cells)) continue;
      sum.shown += counts_[piece][view].shown;
      sum.missed += counts_[piece][view].missed;
    }
    ++view;
    if (sum.shown == 0) continue;
    const double share = static_cast<double>(sum.missed) / static_cast<double>(sum.shown);
    moments_[camera].push_back(std::max(0.0, share - CarvedByOneMore(others)));
    if (moments_[camera].size() > kMoments) moments_[camera].pop_front();
  }
}

void MissRates::CountCell(const VoxelPieces::Run& run, int i, std::span<const CarvingView> views) {
  const auto piece = static_cast<std::size_t>(run.piece);
  const Vector3 p_W = hull_.CenterOf(i, run.j, run.k);
  bool is_missed = false;
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (!sees_people_[v]) continue;
    const std::optional<bool> misses = Misses(views[v], p_W);
    if (!misses) continue;
    ++counts_[piece][v].shown;
    counts_[piece][v].missed += *misses;
    is_missed = is_missed || *misses;
  }
  ++pieces_missed_[piece].shown;
  pieces_missed_[piece].missed += is_missed;
}

std::optional<double> MissRates::Of(int camera) const {
  const auto& moments = moments_[static_cast<std::size_t>(camera)];
  if (moments.empty()) return {};
  return std::accumulate(moments.begin(), moments.end(), 0.0) / static_cast<double>(moments.size());
}

// The fewest others for whom one more would rightly carve less than this camera misses.
int MissRates::OutweighedBy(int camera) const {
  const double rate = Of(camera).value_or(0);
  for (int others = kFewestToOutweigh; others < kNeverOutweighed; ++others) {
    if (CarvedByOneMore(others) < rate) return others;
  }
  return kNeverOutweighed;
}

void WeighOnce(std::span<CarvingView> views, bool several_people) {
  if (views.empty()) return;
  const std::uint64_t all = ~std::uint64_t{0} >> (Carver::kMostViews - views.size());
  MissRates(views.size(), several_people).Weigh(views, all, 0);
}

}  // namespace mocap
