#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/errors.h"
#include "core/kernels/expected_pixels.h"
#include "core/kernels/mixing.h"
#include "core/quantile.h"
#include "core/reconstruction/camera/sensor_plane_table.h"
#include "core/reconstruction/silhouette/background_model.h"
#include "core/reconstruction/silhouette/coarse_scan.h"

namespace mocap {
namespace {

// Directions are computed at the corners of these cells and interpolated within. Runs begin at
// corners.
constexpr int kCell_px = 8;
static_assert(HalfPicture::kTile_px % kCell_px == 0);
// Assumed distance of everything unless the floor is nearer. Half or twice this distance moves a
// pixel by a third of a pixel at most, from one learned view to the next.
constexpr double kRoomDepth_mm = 6000;
constexpr int kMostViews = 4;
constexpr double kSameDirection_rad = 1e-4;
constexpr float kLeastSigma = 1.5f;
// Slopes [grey levels per pixel]: flatter ones show noise alone, steeper ones shifts of contours.
constexpr int kFlat = 4;
constexpr int kSteep = 20;

float Median(std::vector<float>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The empty studio as seen in one direction, at full and at half the resolution.
struct BackgroundView {
  BackgroundView(const PanTiltAngles& view_angles, const RigidTransform& X_CW_of_view,
                 const Image<Bgr>& image)
      : angles(view_angles), X_CW(X_CW_of_view) {
    std::vector<float> brightness;
    for (const Bgr& p : image.pixels())
      brightness.push_back(static_cast<float>(p.b + p.g + p.r) / 3);
    const std::vector<std::uint8_t> slope = SlopeOf(brightness, image.width(), image.height());
    for (std::size_t i = 0; i < slope.size(); ++i) {
      const Bgr& p = image.pixels()[i];
      pixels.push_back(Pack(p.b, p.g, p.r, slope[i]));
    }
    const WholeHalf whole(image.view());
    for (std::size_t i = 0; i < whole.slope.size(); ++i) {
      const Bgr& p = whole.color.pixels()[i];
      half.push_back(Pack(p.b, p.g, p.r, whole.slope[i]));
    }
  }
  static kernels::PackedPixel Pack(std::uint8_t b, std::uint8_t g, std::uint8_t r,
                                   std::uint8_t slope) {
    return b | g << 8 | r << 16 | static_cast<kernels::PackedPixel>(slope) << 24;
  }

  PanTiltAngles angles;
  RigidTransform X_CW;
  std::vector<kernels::PackedPixel> pixels, half;
};

class PanTiltBackground final : public BackgroundModel {
 public:
  PanTiltBackground(const CameraCalibration& camera, std::span<const BackgroundFrame> frames,
                    double detection_rate)
      : camera_(camera),
        table_(camera),
        half_(camera.width_px, camera.height_px),
        expected_(camera.width_px, camera.height_px),
        is_known_(static_cast<std::size_t>(camera.width_px)) {
    MOCAP_CHECK(camera.head && frames.size() >= 2);
    CollectViews(frames);
    LookUpDirections();
    for (auto* values : {&cells_x_, &cells_y_, &places_x_, &places_y_})
      values->resize(static_cast<std::size_t>(node_columns_) * kCell_px);
    LearnVariation();
    LearnThresholds(detection_rate);
  }

  const ExpectedHalf& CoarsePass(const PanTiltAngles& angles,
                                 const Displacement& displacement) override {
    TurnTo(angles, displacement, std::nullopt);
    return half_;
  }

  const ExpectedPicture& Expect(const RegionOfInterest& roi,
                                const Conditions& conditions) override {
    for (int y = 0; y < camera_.height_px; ++y)
      roi.ForEachMeasured(y, [&](const PixelRun& run) { DrawRun(y, run, conditions); });
    return expected_;
  }

 private:
  // A view that covers part of the present picture, with the positions of the cell corners in it.
  struct Source {
    std::size_t view = 0;
    bool is_projected = false;
    // NaN where the view does not reach.
    std::vector<float> nodes_x, nodes_y;
  };

  // Merges frames of one direction into one view, their mean.
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
      views_.emplace_back(frames[f].angles, camera_.PoseAt(frames[f].angles), mean);
      images_.push_back(std::move(mean));
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

  // Draws what the other views know of a view, and compares the two.
  void LookFrom(std::size_t v, CoarseScan& scan) {
    TurnTo(views_[v].angles, {}, v);
    scan.Compare(half_, images_[v].view());
    RegionOfInterest everything;
    everything.SetAll(camera_.width_px, camera_.height_px);
    Expect(everything, {});
  }

  // Learns how far two views of the same place differ: by noise everywhere, and by residual
  // parallax where the picture is steep.
  void LearnVariation() {
    CoarseScan scan;
    std::vector<float> flat, steep;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      LookFrom(v, scan);
      const float gain = scan.conditions().gain[1];
      const std::vector<Bgr>& pixels = images_[v].pixels();
      for (std::size_t i = v % 7; i < pixels.size(); i += 7) {
        if (expected_.variance[1][i] >= kUnknownVariance) continue;
        const float difference = std::abs(pixels[i].g * gain - expected_.mean[1][i]);
        const auto slope = static_cast<int>(views_[v].pixels[i] >> 24);
        if (slope < kFlat) flat.push_back(difference);
        if (slope > kSteep) steep.push_back(difference / static_cast<float>(slope));
      }
    }
    const float sigma =
        std::max(static_cast<float>(kDeviationPerMedian) * Median(flat), kLeastSigma);
    variance_ = sigma * sigma;
    shift_px_ = static_cast<float>(kDeviationPerMedian) * Median(steep);
  }

  void LearnThresholds(double detection_rate) {
    DistortionHistograms histograms;
    CoarseScan scan;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      LookFrom(v, scan);
      histograms.Add(expected_, images_[v].view(), scan.conditions().gain);
      half_.usual_distance = std::max(half_.usual_distance, scan.distance());
      half_.usual_shift_px = std::max(half_.usual_shift_px, scan.shift_px());
    }
    thresholds_ = histograms.At(detection_rate);
    images_ = {};
  }

  void TurnTo(const PanTiltAngles& angles, const Displacement& displacement,
              std::optional<std::size_t> left_out) {
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
    displacement_ = displacement;
    for (std::size_t k = 0; k < used_; ++k) {
      sources_[k].view = order_[k];
      sources_[k].is_projected = false;
    }
    for (int y = 0; y * HalfPicture::kRowStep_px + 1 < camera_.height_px; ++y) DrawHalfRow(y);
    half_.Finish();
  }

  // Finds the cell corners of a picture from X_CW_ in a source's view. Views have nearly the size
  // and orientation of the picture, so the picture's displacement applies to them too.
  void ProjectNodes(Source& source) {
    source.is_projected = true;
    source.nodes_x.assign(directions_.size(), std::numeric_limits<float>::quiet_NaN());
    source.nodes_y.assign(directions_.size(), 0);
    const RigidTransform X_WC = X_CW_.Inverse();
    const RigidTransform X_VC = views_[source.view].X_CW * X_WC;
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      if (!directions_[i]) continue;
      const Vector3 ray_C = directions_[i]->homogeneous();
      double depth = kRoomDepth_mm;
      const double descent = -X_WC.R.row(2).dot(ray_C);
      if (descent > 0 && X_WC.p.z() > 0) depth = std::min(depth, X_WC.p.z() / descent);
      const Vector3 p_V = X_VC * Vector3(depth * ray_C);
      SensorPlaneTable::Place place;
      if (p_V.z() <= 0 || !table_.Locate(static_cast<float>(p_V.x() / p_V.z()),
                                         static_cast<float>(p_V.y() / p_V.z()), place))
        continue;
      source.nodes_x[i] = place.x_px - displacement_.x_px;
      source.nodes_y[i] = place.y_px - displacement_.y_px;
    }
  }

  // Finds the positions of cells [first, end) of a row in a source's view. A cell is `width` pixels
  // wide; the first of them lies at the fraction `into` of the cell. Returns whether all lie in the
  // view.
  bool FindPlaces(Source& source, int width, float y, float into, int first, int end, float last_x,
                  float last_y) {
    if (!source.is_projected) ProjectNodes(source);
    const int row = static_cast<int>(y) / kCell_px;
    const float b = y / kCell_px - static_cast<float>(row);
    const std::size_t top = static_cast<std::size_t>(row) * node_columns_ + first;
    const int count = end - first + 1;
    kernels::MixRows(&source.nodes_x[top], &source.nodes_x[top + node_columns_], count, b,
                     cells_x_.data());
    kernels::MixRows(&source.nodes_y[top], &source.nodes_y[top + node_columns_], count, b,
                     cells_y_.data());
    kernels::SpreadCells(cells_x_.data(), end - first, width, into, places_x_.data());
    kernels::SpreadCells(cells_y_.data(), end - first, width, into, places_y_.data());
    // Also false for NaN.
    const auto lies_within = [](const std::vector<float>& cells, int n, float last) {
      return std::all_of(cells.begin(), cells.begin() + n,
                         [last](float place) { return place >= 0 && place < last; });
    };
    return lies_within(cells_x_, count, last_x) && lies_within(cells_y_, count, last_y);
  }

  // Draws `count` pixels of the cells [first, end) of a row, `width` pixels each: calls draw(view,
  // x, y, begin, count) for runs of pixels whose places x, y lie in that view, up to the last ones.
  // The nearest views come first. Pixels that were drawn are marked in is_known_.
  template <typename Draw>
  void DrawRow(int width, float y, float into, int first, int end, int count, float last_x,
               float last_y, Draw draw) {
    std::fill_n(is_known_.begin(), count, std::uint8_t{0});
    int known = 0;
    for (std::size_t k = 0; k < used_ && known < count; ++k) {
      const bool has_all = FindPlaces(sources_[k], width, y, into, first, end, last_x, last_y);
      const float *const px = places_x_.data(), *const py = places_y_.data();
      if (has_all && k == 0) {
        std::fill_n(is_known_.begin(), count, std::uint8_t{1});
        return draw(views_[sources_[k].view], px, py, 0, count);
      }
      // Also false for NaN.
      const auto is_new = [&](int i) {
        return !is_known_[i] && px[i] >= 0 && py[i] >= 0 && px[i] < last_x && py[i] < last_y;
      };
      for (int i = 0; i < count; ++i) {
        const int begin = i;
        while (i < count && is_new(i)) is_known_[i++] = 1;
        if (i > begin) draw(views_[sources_[k].view], px + begin, py + begin, begin, i - begin);
        known += i - begin;
      }
    }
  }

  void DrawHalfRow(int y) {
    const int columns = camera_.width_px / 2, rows = camera_.height_px / 2;
    const std::size_t row = static_cast<std::size_t>(y) * half_.mean.width;
    DrawRow(
        kCell_px / 2, static_cast<float>(y * HalfPicture::kRowStep_px) + 0.5f, 0.5f / kCell_px, 0,
        node_columns_ - 1, columns, static_cast<float>(2 * columns - 1),
        static_cast<float>(2 * rows - 1),
        [&](const BackgroundView& view, const float* px, const float* py, int begin, int count) {
          auto& color = half_.mean.color;
          const std::size_t to = row + begin;
          kernels::ReadNearestHalf(view.half.data(), columns, px, py, count,
                                   {&color[0][to], &color[1][to], &color[2][to]}, &half_.slope[to]);
        });
    for (int x = 0; x < columns; ++x)
      half_.variance[row + x] = is_known_[x] ? variance_ : kUnknownVariance;
  }

  void DrawRun(int y, const PixelRun& run, const Conditions& conditions) {
    const int length = run.end - run.begin;
    const std::size_t row = static_cast<std::size_t>(y) * camera_.width_px + run.begin;
    auto& mean = expected_.mean;
    DrawRow(
        kCell_px, static_cast<float>(y), 0, run.begin / kCell_px,
        (run.end + kCell_px - 1) / kCell_px, length, static_cast<float>(camera_.width_px - 1),
        static_cast<float>(camera_.height_px - 1),
        [&](const BackgroundView& view, const float* px, const float* py, int begin, int count) {
          const std::size_t to = row + begin;
          kernels::ReadBetween(view.pixels.data(), camera_.width_px, px, py, count,
                               {&mean[0][to], &mean[1][to], &mean[2][to]}, &expected_.slope[to]);
        });
    for (int c = 0; c < 3; ++c)
      kernels::FinishDrawn(is_known_.data(), length, variance_, kUnknownVariance, &mean[c][row],
                           &expected_.variance[c][row]);
    expected_.Weigh(std::hypot(shift_px_, conditions.shift_px), y, run.begin, run.end);
  }

  CameraCalibration camera_;
  SensorPlaneTable table_;
  std::vector<BackgroundView> views_;
  std::vector<Image<Bgr>> images_;  // Of the views; only while learning.
  float variance_ = kLeastSigma * kLeastSigma;
  float shift_px_ = 0;

  int node_columns_ = 0, node_rows_ = 0;
  std::vector<std::optional<Vector2>> directions_;

  RigidTransform X_CW_;
  Displacement displacement_;
  std::vector<std::size_t> order_;
  std::array<Source, kMostViews> sources_;
  std::size_t used_ = 0;
  ExpectedHalf half_;
  ExpectedPicture expected_;
  std::vector<float> cells_x_, cells_y_, places_x_, places_y_;
  std::vector<std::uint8_t> is_known_;
};

}  // namespace

std::unique_ptr<BackgroundModel> LearnPanTiltBackground(const CameraCalibration& camera,
                                                        std::span<const BackgroundFrame> frames,
                                                        double detection_rate) {
  return std::make_unique<PanTiltBackground>(camera, frames, detection_rate);
}

}  // namespace mocap
