#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/errors.h"
#include "core/reconstruction/background_model.h"
#include "core/reconstruction/sensor_plane_table.h"

namespace mocap {
namespace {

// Directions are looked up at the corners of such cells and interpolated within.
constexpr int kCell_px = 8;
// Beyond this, and unless the floor is nearer, everything is taken to be so far away. Half as much
// or twice as much moves a pixel by a third of a pixel at most, from one learned view to the next.
constexpr double kRoomDepth_mm = 6000;
constexpr int kMostViews = 4;
constexpr double kSameDirection_rad = 1e-4;
// The standard deviation [grey levels] where nothing is known: anything goes.
constexpr float kUnknownSigma = 1e4f;
constexpr float kLeastSigma = 1.5f;

// The empty studio as it was seen in one direction.
struct View {
  PanTiltAngles angles;
  RigidTransform X_CW;
  Image<Bgr> image;
  Image<std::uint8_t> slope;  // Of the brightness [grey levels per pixel].
};

Image<std::uint8_t> SlopeOf(const Image<Bgr>& image) {
  const int width = image.width();
  const int height = image.height();
  Image<std::uint8_t> slope(width, height);
  const auto brightness = [&](int x, int y) {
    const Bgr& p = image(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1));
    return static_cast<float>(p.b + p.g + p.r) / 3;
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      // The steeper side: an edge is as steep as its step, not half of it.
      const float here = brightness(x, y);
      const float dx =
          std::max(std::abs(brightness(x + 1, y) - here), std::abs(brightness(x - 1, y) - here));
      const float dy =
          std::max(std::abs(brightness(x, y + 1) - here), std::abs(brightness(x, y - 1) - here));
      slope(x, y) = static_cast<std::uint8_t>(std::min(std::hypot(dx, dy), 255.0f));
    }
  }
  return slope;
}

float Median(std::vector<float>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class PanTiltBackground final : public BackgroundModel {
 public:
  PanTiltBackground(const CameraCalibration& camera, std::span<const BackgroundFrame> frames,
                    double detection_rate)
      : camera_(camera),
        table_(camera),
        expected_(camera.width_px, camera.height_px),
        covered_(camera.width_px, camera.height_px) {
    MOCAP_CHECK(camera.head && frames.size() >= 2);
    CollectViews(frames);
    LookUpDirections();
    LearnSigmas();
    DistortionHistograms histograms;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      Render(views_[v].angles, v);
      histograms.Add(expected_, views_[v].image.view());
    }
    thresholds_ = histograms.At(detection_rate);
  }

  const ExpectedPicture& Expect(const PanTiltAngles& angles) override {
    if (!rendered_ || !(*rendered_ == angles)) Render(angles, std::nullopt);
    rendered_ = angles;
    return expected_;
  }

 private:
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
      View view{frames[f].angles, camera_.PoseAt(frames[f].angles), frames[f].image, {}};
      const auto rounded = [&](float sum) {
        return static_cast<std::uint8_t>(std::lround(sum / static_cast<float>(count)));
      };
      for (std::size_t i = 0; i < sums.size(); ++i)
        view.image.pixels()[i] = {rounded(sums[i][0]), rounded(sums[i][1]), rounded(sums[i][2])};
      view.slope = SlopeOf(view.image);
      views_.push_back(std::move(view));
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
    nodes_.resize(directions_.size());
  }

  // How far two views of the same place differ: by noise everywhere, and by what is left of the
  // parallax where the picture is steep.
  void LearnSigmas() {
    sigmas_.fill(kLeastSigma);
    std::vector<float> flat, steep;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      Render(views_[v].angles, v);
      const View& view = views_[v];
      std::vector<float> scratch;
      const float gain = MeasureGain(expected_, view.image.view(), scratch);
      for (std::size_t i = v % 7; i < view.image.pixels().size(); i += 7) {
        if (!covered_.pixels()[i]) continue;
        const float difference = std::abs(view.image.pixels()[i].g * gain - expected_.MeanOf(i, 1));
        const float slope = view.slope.pixels()[i];
        if (slope < 4) flat.push_back(difference);
        if (slope > 20) steep.push_back(difference / slope);
      }
    }
    // From the median to the standard deviation of a normal distribution.
    constexpr float kDeviationPerMedian = 1.4826f;
    const float noise = std::max(kDeviationPerMedian * Median(flat), kLeastSigma);
    const float shift_px = kDeviationPerMedian * Median(steep);
    for (std::size_t slope = 0; slope < sigmas_.size(); ++slope)
      sigmas_[slope] = std::hypot(noise, shift_px * static_cast<float>(slope));
  }

  void Render(const PanTiltAngles& angles, std::optional<std::size_t> left_out) {
    std::vector<std::size_t>& order = order_;
    order.clear();
    for (std::size_t v = 0; v < views_.size(); ++v)
      if (v != left_out) order.push_back(v);
    const std::size_t used = std::min<std::size_t>(order.size(), kMostViews);
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(used), order.end(),
                      [&](std::size_t a, std::size_t b) {
                        return Distance(views_[a].angles, angles) <
                               Distance(views_[b].angles, angles);
                      });
    std::fill(covered_.pixels().begin(), covered_.pixels().end(), std::uint8_t{0});
    for (std::size_t k = 0; k < used; ++k) {
      ProjectNodes(camera_.PoseAt(angles), views_[order[k]]);
      CopyFrom(views_[order[k]]);
    }
    for (std::size_t i = 0; i < covered_.pixels().size(); ++i)
      if (!covered_.pixels()[i])
        expected_.SetPixel(i, {255, 255, 255}, {kUnknownSigma, kUnknownSigma, kUnknownSigma}, 0);
    rendered_.reset();
  }

  // Where in a view the corners of the cells of a picture from X_CW lie.
  void ProjectNodes(const RigidTransform& X_CW, const View& view) {
    const RigidTransform X_WC = X_CW.Inverse();
    const RigidTransform X_VC = view.X_CW * X_WC;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      nodes_[i] = {std::numeric_limits<float>::quiet_NaN(), 0};
      if (!directions_[i]) continue;
      const Vector3 ray_C = directions_[i]->homogeneous();
      double depth = kRoomDepth_mm;
      const double descent = -X_WC.R.row(2).dot(ray_C);
      if (descent > 0 && X_WC.p.z() > 0) depth = std::min(depth, X_WC.p.z() / descent);
      const Vector3 p_V = X_VC * Vector3(depth * ray_C);
      SensorPlaneTable::Place place;
      if (p_V.z() > 0 && table_.Locate(static_cast<float>(p_V.x() / p_V.z()),
                                       static_cast<float>(p_V.y() / p_V.z()), place))
        nodes_[i] = place;
    }
  }

  // Fills what no nearer view has covered.
  void CopyFrom(const View& view) {
    const int width = camera_.width_px;
    const int height = camera_.height_px;
    for (int y = 0; y < height; ++y) {
      const float b = static_cast<float>(y % kCell_px) / kCell_px;
      const SensorPlaneTable::Place* top =
          &nodes_[static_cast<std::size_t>(y / kCell_px) * node_columns_];
      const SensorPlaneTable::Place* bottom = top + node_columns_;
      for (int cell = 0; cell * kCell_px < width; ++cell) {
        const float left_x = top[cell].x_px + b * (bottom[cell].x_px - top[cell].x_px);
        const float left_y = top[cell].y_px + b * (bottom[cell].y_px - top[cell].y_px);
        const float right_x = top[cell + 1].x_px + b * (bottom[cell + 1].x_px - top[cell + 1].x_px);
        const float right_y = top[cell + 1].y_px + b * (bottom[cell + 1].y_px - top[cell + 1].y_px);
        const int end = std::min((cell + 1) * kCell_px, width);
        for (int x = cell * kCell_px; x < end; ++x) {
          if (covered_(x, y)) continue;
          const float a = static_cast<float>(x % kCell_px) / kCell_px;
          CopyPixel(view, left_x + a * (right_x - left_x), left_y + a * (right_y - left_y), x, y);
        }
      }
    }
  }

  void CopyPixel(const View& view, float from_x, float from_y, int x, int y) {
    // Also false for what is not a number.
    if (!(from_x >= 0 && from_y >= 0 && from_x < static_cast<float>(camera_.width_px - 1) &&
          from_y < static_cast<float>(camera_.height_px - 1)))
      return;
    const int column = static_cast<int>(from_x);
    const int row = static_cast<int>(from_y);
    const float a = from_x - static_cast<float>(column);
    const float b = from_y - static_cast<float>(row);
    const Bgr* top = view.image.row(row) + column;
    const Bgr* bottom = view.image.row(row + 1) + column;
    const float w[4] = {(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b};
    const std::array<float, 3> mean = {
        w[0] * top[0].b + w[1] * top[1].b + w[2] * bottom[0].b + w[3] * bottom[1].b,
        w[0] * top[0].g + w[1] * top[1].g + w[2] * bottom[0].g + w[3] * bottom[1].g,
        w[0] * top[0].r + w[1] * top[1].r + w[2] * bottom[0].r + w[3] * bottom[1].r};
    const float sigma = sigmas_[view.slope(column + (a > 0.5f ? 1 : 0), row + (b > 0.5f ? 1 : 0))];
    expected_.SetPixel(static_cast<std::size_t>(y) * camera_.width_px + x, mean,
                       {sigma, sigma, sigma}, 0);
    covered_(x, y) = 1;
  }

  CameraCalibration camera_;
  SensorPlaneTable table_;
  std::vector<View> views_;
  std::array<float, 256> sigmas_{};  // By the slope of the picture.

  int node_columns_ = 0, node_rows_ = 0;
  std::vector<std::optional<Vector2>> directions_;
  std::vector<SensorPlaneTable::Place> nodes_;

  std::optional<PanTiltAngles> rendered_;
  ExpectedPicture expected_;
  Image<std::uint8_t> covered_;
  std::vector<std::size_t> order_;
};

}  // namespace

std::unique_ptr<BackgroundModel> LearnPanTiltBackground(const CameraCalibration& camera,
                                                        std::span<const BackgroundFrame> frames,
                                                        double detection_rate) {
  return std::make_unique<PanTiltBackground>(camera, frames, detection_rate);
}

}  // namespace mocap
