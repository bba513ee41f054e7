#include "tools/import/empty_stretch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "core/quantile.h"
#include "core/reconstruction/background/change_meter.h"

namespace mocap {
namespace {

/// Width of the small copies: a person is some cells wide, noise is averaged.
constexpr int kColumns = 96;
constexpr double kShortestStretch_s = 2;
constexpr std::size_t kFewestStill = 5;
/// People are there if they fill so many times what may change in an empty room.
constexpr double kPeople = 5;
/// Noise of a cell, in times of its usual deviation; and what a codec adds [grey levels].
constexpr double kBeyondNoise = 6;
constexpr double kCodecNoise = 8;

int Brightness(const Bgr& color) { return color.b + color.g + color.r; }

Bgr MeanOf(ImageView<const Bgr> picture, int left, int top, int size) {
  std::array<int, 3> sum{};
  int count = 0;
  for (int y = top; y < std::min(top + size, picture.height()); ++y) {
    for (int x = left; x < std::min(left + size, picture.width()); ++x, ++count) {
      const Bgr& pixel = picture(x, y);
      sum[0] += pixel.b, sum[1] += pixel.g, sum[2] += pixel.r;
    }
  }
  const auto mean = [&](int c) { return static_cast<std::uint8_t>(sum[c] / std::max(count, 1)); };
  return {mean(0), mean(1), mean(2)};
}

}  // namespace

void EmptyStretch::Add(double time_s, ImageView<const Bgr> picture) {
  const int size = std::max(1, picture.width() / kColumns);
  columns_ = (picture.width() + size - 1) / size, rows_ = (picture.height() + size - 1) / size;
  std::vector<Bgr> cells;
  cells.reserve(static_cast<std::size_t>(columns_) * rows_);
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column)
      cells.push_back(MeanOf(picture, column * size, row * size, size));
  times_s_.push_back(time_s);
  small_.push_back(std::move(cells));
}

std::vector<double> EmptyStretch::OccupiedShares() const {
  std::vector<double> occupied(small_.size());
  const std::size_t cells = small_.front().size();
  std::vector<double> values(small_.size()), sorted;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    for (std::size_t i = 0; i < small_.size(); ++i) values[i] = Brightness(small_[i][cell]);
    sorted = values;
    const double usual = MedianOf(sorted);
    for (double& value : sorted) value = std::abs(value - usual);
    const double noise = kDeviationPerMedian * MedianOf(sorted);
    for (std::size_t i = 0; i < small_.size(); ++i)
      occupied[i] += std::abs(values[i] - usual) > kBeyondNoise * noise + 3 * kCodecNoise;
  }
  for (double& share : occupied) share /= static_cast<double>(cells);
  return occupied;
}

std::optional<EmptyStretch::Stretch> EmptyStretch::Longest() const {
  if (small_.size() < 2 * kFewestStill) return std::nullopt;
  const std::vector<double> occupied = OccupiedShares();
  std::vector<double> of_people;
  for (const double share : occupied)
    if (share >= kMostChange) of_people.push_back(share);
  if (of_people.empty() || MedianOf(of_people) < kPeople * kMostChange) return std::nullopt;
  std::optional<Stretch> longest;
  for (std::size_t begin = 0; begin < occupied.size();) {
    std::size_t end = begin;
    while (end < occupied.size() && occupied[end] < kMostChange) ++end;
    const bool is_enough = end - begin >= kFewestStill;
    const Stretch stretch{times_s_[begin], is_enough ? times_s_[end - 1] : times_s_[begin]};
    const double length_s = stretch.to_s - stretch.from_s;
    if (length_s >= kShortestStretch_s && (!longest || length_s > longest->to_s - longest->from_s))
      longest = stretch;
    begin = std::max(end, begin + 1);
  }
  return longest;
}

}  // namespace mocap
