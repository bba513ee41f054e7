#include "tools/witness/keypoint_decoders.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mocap {
namespace {

/// A quarter of a cell towards the higher neighbour.
double PeakAt(double peak, float before, float after) {
  if (before == after) return peak;
  return peak + (after > before ? 0.25 : -0.25);
}

FoundPoint HighestOf(std::span<const float> map, int height, int width) {
  const auto highest = std::ranges::max_element(map);
  const auto at = static_cast<int>(highest - map.begin());
  const int x = at % width, y = at / width;
  FoundPoint found{.crop_px = Vector2(x, y), .score = *highest};
  if (x > 0 && x + 1 < width) found.crop_px.x() = PeakAt(x, map[at - 1], map[at + 1]);
  if (y > 0 && y + 1 < height) found.crop_px.y() = PeakAt(y, map[at - width], map[at + width]);
  return found;
}

}  // namespace

double Sigmoid(double logit) { return 1 / (1 + std::exp(-logit)); }

std::vector<FoundPoint> DecodeHeatmaps(std::span<const float> values, int height, int width,
                                       int width_px, int height_px) {
  const std::size_t size = static_cast<std::size_t>(height) * width;
  std::vector<FoundPoint> found;
  for (std::size_t at = 0; at + size <= values.size(); at += size) {
    FoundPoint point = HighestOf(values.subspan(at, size), height, width);
    // Networks are trained with cell 0 at pixel 0.
    point.crop_px.x() *= static_cast<double>(width_px) / width;
    point.crop_px.y() *= static_cast<double>(height_px) / height;
    found.push_back(point);
  }
  return found;
}

std::vector<FoundPoint> DecodeSimcc(std::span<const float> x, std::span<const float> y, int points,
                                    int width_px, int height_px) {
  const std::size_t columns = x.size() / points, rows = y.size() / points;
  std::vector<FoundPoint> found;
  for (int i = 0; i < points; ++i) {
    const auto along_x = x.subspan(i * columns, columns), along_y = y.subspan(i * rows, rows);
    const auto best_x = std::ranges::max_element(along_x);
    const auto best_y = std::ranges::max_element(along_y);
    const auto bin_x = static_cast<double>(best_x - along_x.begin());
    const auto bin_y = static_cast<double>(best_y - along_y.begin());
    found.push_back({.crop_px = {bin_x * width_px / static_cast<double>(columns),
                                 bin_y * height_px / static_cast<double>(rows)},
                     .score = std::min(*best_x, *best_y)});
  }
  return found;
}

std::vector<FoundPoint> DecodeCoordinates(std::span<const float> values,
                                          std::span<const AnswerColumn> columns, bool are_logits) {
  std::vector<FoundPoint> found;
  for (std::size_t at = 0; at + columns.size() <= values.size(); at += columns.size()) {
    FoundPoint point{.score = 1};
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const double value = values[at + i];
      if (columns[i] == AnswerColumn::kX) point.crop_px.x() = value - 0.5;
      if (columns[i] == AnswerColumn::kY) point.crop_px.y() = value - 0.5;
      if (columns[i] == AnswerColumn::kScore) point.score *= are_logits ? Sigmoid(value) : value;
    }
    found.push_back(point);
  }
  return found;
}

}  // namespace mocap
