#include "tools/calibration/board_hints.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace mocap {
namespace {

constexpr int kEnoughViews = 25;
constexpr int kEnoughShared = 8;

using SharedViews = std::vector<std::vector<int>>;  // [camera][camera]

SharedViews CountShared(const BoardDetections& detections) {
  const std::size_t n = detections.cameras.size();
  std::vector<std::vector<int>> seen_by(static_cast<std::size_t>(detections.moments));
  for (const BoardDetection& s : detections.detections) seen_by[s.moment].push_back(s.camera);
  SharedViews shared(n, std::vector<int>(n, 0));
  for (const std::vector<int>& cameras : seen_by) {
    for (const int a : cameras) {
      for (const int b : cameras) shared[a][b] += a != b;
    }
  }
  return shared;
}

// Cameras connected to the first by shared views.
std::vector<bool> LinkedToFirst(const SharedViews& shared) {
  std::vector<bool> linked(shared.size(), false);
  std::vector<std::size_t> next = {0};
  linked[0] = true;
  while (!next.empty()) {
    const std::size_t a = next.back();
    next.pop_back();
    for (std::size_t b = 0; b < shared.size(); ++b) {
      if (linked[b] || shared[a][b] < kEnoughShared) continue;
      linked[b] = true;
      next.push_back(b);
    }
  }
  return linked;
}

// Where to show the board to connect a camera to the others.
std::string LinkHint(const BoardDetections& detections, const SharedViews& shared,
                     const std::vector<bool>& linked, std::size_t camera) {
  std::size_t nearest = 0;
  for (std::size_t other = 0; other < linked.size(); ++other) {
    if (linked[other] && shared[camera][other] >= shared[camera][nearest]) nearest = other;
  }
  return fmt::format("show it to {} at the same time ({} of {} views)",
                     detections.cameras[nearest].name, shared[camera][nearest], kEnoughShared);
}

}  // namespace

std::vector<CameraHint> HintsFor(const BoardDetections& detections) {
  const SharedViews shared = CountShared(detections);
  const std::vector<bool> linked = LinkedToFirst(shared);
  std::vector<CameraHint> hints;
  for (std::size_t c = 0; c < detections.cameras.size(); ++c) {
    const int camera = static_cast<int>(c);
    const Coverage coverage = CoverageOf(detections, camera);
    CameraHint hint{detections.cameras[c].name, detections.CountOf(camera), coverage.share, ""};
    if (hint.views == 0) {
      const std::string& mismatch = detections.cameras[c].mismatch;
      hint.missing = mismatch.empty() ? "has not seen the board" : mismatch;
    } else if (const std::string parts = coverage.Hint(); !parts.empty()) {
      hint.missing = parts;
    } else if (hint.views < kEnoughViews) {
      hint.missing = fmt::format("more views ({} of {}), tilted", hint.views, kEnoughViews);
    } else if (!linked[c]) {
      hint.missing = LinkHint(detections, shared, linked, c);
    }
    hints.push_back(std::move(hint));
  }
  return hints;
}

}  // namespace mocap
