#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/errors.h"
#include "core/reconstruction/background_model.h"
#include "core/reconstruction/coarse_scan.h"
#include "core/reconstruction/sensor_plane_table.h"
#include "core/vectorized.h"

namespace mocap {
namespace {

// Directions are looked up at the corners of such cells and interpolated within.
constexpr int kCell_px = 8;
// Beyond this, and unless the floor is nearer, everything is taken to be so far away. Half as much
// or twice as much moves a pixel by a third of a pixel at most, from one learned view to the next.
constexpr double kRoomDepth_mm = 6000;
constexpr int kMostViews = 4;
constexpr double kSameDirection_rad = 1e-4;
constexpr float kLeastSigma = 1.5f;
// Slopes [grey levels per pixel] that show noise alone, and those that show how contours shift.
constexpr int kFlat = 4;
constexpr int kSteep = 20;
// From the median to the standard deviation of a normal distribution.
constexpr float kDeviationPerMedian = 1.4826f;

// Blue, green, red and the slope of one pixel, from the lowest byte up.
using PackedPixel = std::uint32_t;

PackedPixel Pack(std::uint8_t b, std::uint8_t g, std::uint8_t r, std::uint8_t slope) {
  return b | g << 8 | r << 16 | static_cast<PackedPixel>(slope) << 24;
}

// The empty studio as it was seen in one direction.
struct View {
  PanTiltAngles angles;
  RigidTransform X_CW;
  Image<Bgr> image;
  std::vector<PackedPixel> pixels, half;
};

// Places in a view for the pixels of a row, [pixels].
struct Places {
  std::vector<float> x, y;
};

float Median(std::vector<float>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

View MakeView(const PanTiltAngles& angles, const RigidTransform& X_CW, Image<Bgr> image) {
  View view{angles, X_CW, std::move(image), {}, {}};
  const int width = view.image.width();
  const int height = view.image.height();
  const std::vector<Bgr>& pixels = view.image.pixels();
  std::vector<float> brightness(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
    brightness[i] = static_cast<float>(pixels[i].b + pixels[i].g + pixels[i].r) / 3;
  const std::vector<std::uint8_t> slope = SlopeOf(brightness, width, height);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    view.pixels.push_back(Pack(pixels[i].b, pixels[i].g, pixels[i].r, slope[i]));
  ExpectedHalf half(width, height);
  half.LearnFrom(view.image.view());
  const auto& color = half.mean.color;
  for (std::size_t i = 0; i < half.mean.size(); ++i)
    view.half.push_back(Pack(color[0][i], color[1][i], color[2][i], half.slope[i]));
  return view;
}

// What is drawn of one row; `known` is 1 where a view has been found.
struct DrawnRow {
  std::uint8_t* known;
  std::array<float*, 3> color;
  std::uint8_t* slope;
};

// Draws what is not known yet and lies in the view, between its pixels.
MOCAP_VECTORIZED
void Draw(const View& view, const float* from_x, const float* from_y, int count,
          const DrawnRow& row) {
  const int stride = view.image.width();
  const auto last_x = static_cast<float>(view.image.width() - 1);
  const auto last_y = static_cast<float>(view.image.height() - 1);
  const PackedPixel* const pixels = view.pixels.data();
  const auto [b, g, r] = row.color;
  std::uint8_t *const known = row.known, *const slope = row.slope;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    // Also false for what is not a number.
    const int inside = (from_x[i] >= 0 ? 1 : 0) & (from_y[i] >= 0 ? 1 : 0) &
                       (from_x[i] < last_x ? 1 : 0) & (from_y[i] < last_y ? 1 : 0);
    const int take = inside & (known[i] ^ 1);
    const float x = take ? from_x[i] : 0;
    const float y = take ? from_y[i] : 0;
    const int column = static_cast<int>(x);
    const int line = static_cast<int>(y);
    const float a = x - static_cast<float>(column);
    const float c = y - static_cast<float>(line);
    const PackedPixel* const top = pixels + line * stride + column;
    const PackedPixel p0 = top[0], p1 = top[1], p2 = top[stride], p3 = top[stride + 1];
    const float w0 = (1 - a) * (1 - c), w1 = a * (1 - c), w2 = (1 - a) * c, w3 = a * c;
    const auto mix = [&](int shift) {
      return w0 * static_cast<float>(p0 >> shift & 255) +
             w1 * static_cast<float>(p1 >> shift & 255) +
             w2 * static_cast<float>(p2 >> shift & 255) +
             w3 * static_cast<float>(p3 >> shift & 255);
    };
    const float blue = mix(0), green = mix(8), red = mix(16);
    const PackedPixel near_top = a > 0.5f ? p1 : p0, near_bottom = a > 0.5f ? p3 : p2;
    const PackedPixel steep = (c > 0.5f ? near_bottom : near_top) >> 24;
    const float old_blue = b[i], old_green = g[i], old_red = r[i];
    b[i] = take ? blue : old_blue;
    g[i] = take ? green : old_green;
    r[i] = take ? red : old_red;
    slope[i] = static_cast<std::uint8_t>(take ? static_cast<int>(steep) : slope[i]);
    known[i] = static_cast<std::uint8_t>(known[i] | take);
  }
}

class PanTiltBackground final : public BackgroundModel {
 public:
  PanTiltBackground(const CameraCalibration& camera, std::span<const BackgroundFrame> frames,
                    double detection_rate)
      : camera_(camera),
        table_(camera),
        half_(camera.width_px, camera.height_px),
        expected_(camera.width_px, camera.height_px),
        places_{std::vector<float>(camera.width_px), std::vector<float>(camera.width_px)},
        known_(static_cast<std::size_t>(camera.width_px)) {
    MOCAP_CHECK(camera.head && frames.size() >= 2);
    CollectViews(frames);
    LookUpDirections();
    LearnVariation();
    LearnThresholds(detection_rate);
  }

  const ExpectedHalf& Glance(const PanTiltAngles& angles) override {
    if (!turned_to_ || !(*turned_to_ == angles)) TurnTo(angles, std::nullopt);
    turned_to_ = angles;
    return half_;
  }

  const ExpectedPicture& Expect(const Closeup& closeup) override {
    for (int y = 0; y < camera_.height_px; ++y)
      for (const PixelRun& run : closeup.Measured(y)) DrawRun(y, run);
    return expected_;
  }

 private:
  // A view that shows a part of the present picture, and where in it the corners of the cells lie.
  struct Source {
    std::size_t view = 0;
    bool is_projected = false;
    std::vector<SensorPlaneTable::Place> nodes;
  };

  // Frames of one direction become one view, their mean.
  void CollectViews(std::span<const BackgroundFrame> frames) {
    std::vector<bool> taken(frames.size());
    for (std::size_t f = 0; f < frames.size(); ++f) {
      if (taken[f]) continue;
      std::vector<std::array<float, 3>> sums(frames[f].image.pixels().size());
      int count = 0;
      for (std::size_t g = f; g < frames.size(); ++g) {
        if (Distance(frames[f].angles, frames[g].angles) > kSameDirection_rad) continue;
        taken[g] = true;
        ++count;
        for (std::size_t i = 0; i < sums.size(); ++i) {
          const Bgr& p = frames[g].image.pixels()[i];
          sums[i][0] += p.b, sums[i][1] += p.g, sums[i][2] += p.r;
        }
      }
      const auto rounded = [&](float sum) {
        return static_cast<std::uint8_t>(std::lround(sum / static_cast<float>(count)));
      };
      Image<Bgr> mean(camera_.width_px, camera_.height_px);
      for (std::size_t i = 0; i < sums.size(); ++i)
        mean.pixels()[i] = {rounded(sums[i][0]), rounded(sums[i][1]), rounded(sums[i][2])};
      views_.push_back(
          MakeView(frames[f].angles, camera_.PoseAt(frames[f].angles), std::move(mean)));
    }
  }

  static double Distance(const PanTiltAngles& a, const PanTiltAngles& b) {
    return std::hypot(a.pan_rad - b.pan_rad, a.tilt_rad - b.tilt_rad);
  }

  void LookUpDirections() {
    node_columns_ = (camera_.width_px - 1) / kCell_px + 2;
    node_rows_ = (camera_.height_px - 1) / kCell_px + 2;
    for (int row = 0; row < node_rows_; ++row)
      for (int column = 0; column < node_columns_; ++column)
        directions_.push_back(
            NormalizedFromPixel(camera_.lens, Vector2(column * kCell_px, row * kCell_px)));
  }

  // Draws what is known of a view from the others, and compares it.
  void LookFrom(std::size_t v, CoarseScan& scan) {
    TurnTo(views_[v].angles, v);
    scan.Compare(half_, views_[v].image.view());
    Closeup everything;
    everything.SetAll(camera_.width_px, camera_.height_px);
    Expect(everything);
  }

  // How far two views of the same place differ: by noise everywhere, and by what is left of the
  // parallax where the picture is steep.
  void LearnVariation() {
    CoarseScan scan;
    std::vector<float> flat, steep;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      LookFrom(v, scan);
      const float gain = scan.conditions().gain[1];
      const std::vector<Bgr>& pixels = views_[v].image.pixels();
      for (std::size_t i = v % 7; i < pixels.size(); i += 7) {
        if (expected_.variance[1][i] >= kUnknownVariance) continue;
        const float difference = std::abs(pixels[i].g * gain - expected_.mean[1][i]);
        const auto slope = static_cast<int>(views_[v].pixels[i] >> 24);
        if (slope < kFlat) flat.push_back(difference);
        if (slope > kSteep) steep.push_back(difference / static_cast<float>(slope));
      }
    }
    const float sigma = std::max(kDeviationPerMedian * Median(flat), kLeastSigma);
    variance_ = sigma * sigma;
    shift_px_ = kDeviationPerMedian * Median(steep);
  }

  void LearnThresholds(double detection_rate) {
    DistortionHistograms histograms;
    CoarseScan scan;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      LookFrom(v, scan);
      histograms.Add(expected_, views_[v].image.view(), {.gain = scan.conditions().gain});
      half_.usual_distance = std::max(half_.usual_distance, scan.distance());
      half_.usual_shift_px = std::max(half_.usual_shift_px, scan.shift_px());
    }
    thresholds_ = histograms.At(detection_rate);
  }

  void TurnTo(const PanTiltAngles& angles, std::optional<std::size_t> left_out) {
    order_.clear();
    for (std::size_t v = 0; v < views_.size(); ++v)
      if (v != left_out) order_.push_back(v);
    used_ = std::min<std::size_t>(order_.size(), kMostViews);
    std::partial_sort(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(used_),
                      order_.end(), [&](std::size_t a, std::size_t b) {
                        return Distance(views_[a].angles, angles) <
                               Distance(views_[b].angles, angles);
                      });
    X_CW_ = camera_.PoseAt(angles);
    for (std::size_t k = 0; k < used_; ++k) {
      sources_[k].view = order_[k];
      sources_[k].is_projected = false;
    }
    for (int y = 0; y < camera_.height_px / 2; ++y) DrawHalfRow(y);
    turned_to_.reset();
  }

  const View& ViewOf(const Source& source) const { return views_[source.view]; }

  // Where in a source's view the corners of the cells of a picture from X_CW_ lie.
  void ProjectNodes(Source& source) {
    source.is_projected = true;
    source.nodes.assign(directions_.size(), {std::numeric_limits<float>::quiet_NaN(), 0});
    const RigidTransform X_WC = X_CW_.Inverse();
    const RigidTransform X_VC = ViewOf(source).X_CW * X_WC;
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      if (!directions_[i]) continue;
      const Vector3 ray_C = directions_[i]->homogeneous();
      double depth = kRoomDepth_mm;
      const double descent = -X_WC.R.row(2).dot(ray_C);
      if (descent > 0 && X_WC.p.z() > 0) depth = std::min(depth, X_WC.p.z() / descent);
      const Vector3 p_V = X_VC * Vector3(depth * ray_C);
      SensorPlaneTable::Place place;
      if (p_V.z() > 0 && table_.Locate(static_cast<float>(p_V.x() / p_V.z()),
                                       static_cast<float>(p_V.y() / p_V.z()), place))
        source.nodes[i] = place;
    }
  }

  // Finds places for the pixels first, first + step, … of a row.
  void FindPlaces(Source& source, float y, float first, float step, int count) {
    if (!source.is_projected) ProjectNodes(source);
    const int row = static_cast<int>(y) / kCell_px;
    const float b = y / kCell_px - static_cast<float>(row);
    const SensorPlaneTable::Place* const top =
        &source.nodes[static_cast<std::size_t>(row) * node_columns_];
    const SensorPlaneTable::Place* const bottom = top + node_columns_;
    for (int i = 0; i < count;) {
      const float x = first + step * static_cast<float>(i);
      const int cell = static_cast<int>(x) / kCell_px;
      const float left_x = top[cell].x_px + b * (bottom[cell].x_px - top[cell].x_px);
      const float left_y = top[cell].y_px + b * (bottom[cell].y_px - top[cell].y_px);
      const float right_x = top[cell + 1].x_px + b * (bottom[cell + 1].x_px - top[cell + 1].x_px);
      const float right_y = top[cell + 1].y_px + b * (bottom[cell + 1].y_px - top[cell + 1].y_px);
      const float begin = x / kCell_px - static_cast<float>(cell);
      const int left = static_cast<int>(std::ceil(kCell_px * (1 - begin) / step));
      const int end = std::min(i + left, count);
      for (int k = 0; i < end; ++i, ++k) {
        const float a = begin + static_cast<float>(k) * step / kCell_px;
        places_.x[i] = left_x + a * (right_x - left_x);
        places_.y[i] = left_y + a * (right_y - left_y);
      }
    }
  }

  // The nearest pixels of the half do: slopes make up for what that shifts.
  void DrawHalfRow(int y) {
    const int columns = camera_.width_px / 2;
    const std::size_t begin = static_cast<std::size_t>(y) * half_.mean.width;
    std::fill_n(half_.variance.begin() + static_cast<std::ptrdiff_t>(begin), columns,
                kUnknownVariance);
    int missing = columns;
    for (std::size_t k = 0; k < used_ && missing > 0; ++k) {
      FindPlaces(sources_[k], static_cast<float>(2 * y) + 0.5f, 0.5f, 2, columns);
      const View& view = ViewOf(sources_[k]);
      const auto last_x = static_cast<float>(camera_.width_px / 2 * 2 - 1);
      const auto last_y = static_cast<float>(camera_.height_px / 2 * 2 - 1);
      for (int i = 0; i < columns; ++i) {
        const float from_x = places_.x[i], from_y = places_.y[i];
        // Also false for what is not a number.
        if (!(from_x >= 0 && from_y >= 0 && from_x <= last_x && from_y <= last_y)) continue;
        if (half_.variance[begin + i] < kUnknownVariance) continue;
        const PackedPixel p =
            view.half[static_cast<std::size_t>(from_y / 2 + 0.25f) * half_.mean.width +
                      static_cast<std::size_t>(from_x / 2 + 0.25f)];
        half_.mean.color[0][begin + i] = static_cast<std::uint8_t>(p);
        half_.mean.color[1][begin + i] = static_cast<std::uint8_t>(p >> 8);
        half_.mean.color[2][begin + i] = static_cast<std::uint8_t>(p >> 16);
        half_.slope[begin + i] = static_cast<std::uint8_t>(p >> 24);
        half_.variance[begin + i] = variance_;
        --missing;
      }
    }
  }

  void DrawRun(int y, const PixelRun& run) {
    const int count = run.end - run.begin;
    const std::size_t begin = static_cast<std::size_t>(y) * camera_.width_px + run.begin;
    std::fill_n(known_.begin(), count, std::uint8_t{0});
    const DrawnRow row{
        known_.data(),
        {&expected_.mean[0][begin], &expected_.mean[1][begin], &expected_.mean[2][begin]},
        &expected_.slope[begin]};
    for (std::size_t k = 0; k < used_; ++k) {
      FindPlaces(sources_[k], static_cast<float>(y), static_cast<float>(run.begin), 1, count);
      Draw(ViewOf(sources_[k]), places_.x.data(), places_.y.data(), count, row);
      if (std::all_of(known_.begin(), known_.begin() + count, [](auto known) { return known; }))
        break;
    }
    for (int i = 0; i < count; ++i) {
      const float shift = shift_px_ * expected_.slope[begin + i];
      const float variance = variance_ + shift * shift;
      for (int c = 0; c < 3; ++c) {
        float& mean = expected_.mean[c][begin + i];
        mean = known_[i] ? std::max(mean, ExpectedPicture::kDarkestMean) : 255;
        expected_.variance[c][begin + i] = known_[i] ? variance : kUnknownVariance;
      }
      expected_.alpha_weight[begin + i] = 1e6f;
    }
  }

  CameraCalibration camera_;
  SensorPlaneTable table_;
  std::vector<View> views_;
  float variance_ = kLeastSigma * kLeastSigma;
  float shift_px_ = 0;

  int node_columns_ = 0, node_rows_ = 0;
  std::vector<std::optional<Vector2>> directions_;

  std::optional<PanTiltAngles> turned_to_;
  RigidTransform X_CW_;
  std::vector<std::size_t> order_;
  std::array<Source, kMostViews> sources_;
  std::size_t used_ = 0;
  ExpectedHalf half_;
  ExpectedPicture expected_;
  Places places_;
  std::vector<std::uint8_t> known_;
};

}  // namespace

std::unique_ptr<BackgroundModel> LearnPanTiltBackground(const CameraCalibration& camera,
                                                        std::span<const BackgroundFrame> frames,
                                                        double detection_rate) {
  return std::make_unique<PanTiltBackground>(camera, frames, detection_rate);
}

}  // namespace mocap
