#include "drivers/virtual_studio/room/printed_board.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "drivers/virtual_studio/curve.h"
#include "drivers/virtual_studio/random.h"

namespace mocap::simulation {
namespace {

constexpr double kArmReach_mm = 1500;
constexpr double kBehind = 0.36, kDark = 0.16, kWhite = 0.92;
constexpr int kBoardSamples = 3;  // Per pixel, in each direction.
// A board that lies on something is not hidden by it.
constexpr double kAsNear = 1.01;

RigidTransform Centred(const Matrix3& R_WB, const Vector3& middle_W) {
  return {R_WB, middle_W - R_WB * PrintedBoard::Middle()};
}

// At a height between knee and head, tilted towards the cameras at the ceiling.
RigidTransform HeldUp(Random& random) {
  const double heading = random.Uniform(-std::numbers::pi, std::numbers::pi);
  const double up = random.Uniform(0, 1);
  const Vector3 into =
      -Vector3(std::cos(heading) * std::cos(up), std::sin(heading) * std::cos(up), std::sin(up));
  const Vector3 right = into.cross(Vector3::UnitZ()).normalized();
  Matrix3 R_WB;
  R_WB << right, into.cross(right), into;
  const Range reach{-kArmReach_mm, kArmReach_mm};
  const Vector3 middle_W = random.UniformIn(reach, reach, {600, 1500});
  return Centred(R_WB * ExpRotation({0, 0, random.Uniform(-0.6, 0.6)}), middle_W);
}

// Within a camera's picture, filling a large part of it.
RigidTransform HeldBefore(const CameraCalibration& camera, Random& random) {
  const double near = random.Uniform(1100, 2000);
  const Vector2 aside = near * random.UniformIn({-0.5, 0.5}, {-0.38, 0.38});
  const Vector3 middle_C(aside.x(), aside.y(), near);
  const Matrix3 R_CB = ExpRotation(
      {random.Uniform(-0.6, 0.6), random.Uniform(-0.6, 0.6), random.Uniform(-0.8, 0.8)});
  const RigidTransform X_WC = camera.X_CW.Inverse();
  return Centred(X_WC.R * R_CB, X_WC * middle_C);
}

// Reflectance at a point of the front [mm]; empty outside the board.
std::optional<double> InkAt(const Vector2& p_B) {
  const double x = p_B.x() / PrintedBoard::kSquare_mm, y = p_B.y() / PrintedBoard::kSquare_mm;
  constexpr int kColumns = PrintedBoard::kColumns, kRows = PrintedBoard::kRows;
  constexpr double kRim = 0.6;
  if (x < -1 - kRim || y < -1 - kRim || x > kColumns + kRim || y > kRows + kRim) return {};
  if (x < -1 || y < -1 || x > kColumns || y > kRows) return kWhite;
  const bool is_dark = (static_cast<int>(std::floor(x)) + static_cast<int>(std::floor(y))) % 2 == 0;
  return is_dark ? kDark : kWhite;
}

struct BoardBox {
  int x0, y0, x1, y1;  // Half open.
};

// The pixels that may show the board; the whole picture if part of the rim is outside the lens'
// field.
BoardBox BoxOf(const CameraCalibration& camera, const RigidTransform& X_CB) {
  const BoardBox whole{0, 0, camera.width_px, camera.height_px};
  Vector2 low = Vector2::Constant(1e9), high = -low;
  constexpr int kSteps = 6;
  constexpr double kRim = 1.6;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const double u = static_cast<double>(i) / kSteps, v = static_cast<double>(j) / kSteps;
      const Vector3 p_B =
          PrintedBoard::kSquare_mm * Vector3(-kRim + u * (PrintedBoard::kColumns - 1 + 2 * kRim),
                                             -kRim + v * (PrintedBoard::kRows - 1 + 2 * kRim), 0);
      const Vector3 p_C = X_CB * p_B;
      if (p_C.z() < 50) return whole;
      const auto pixel = PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z());
      if (!pixel) return whole;
      low = low.cwiseMin(*pixel);
      high = high.cwiseMax(*pixel);
    }
  }
  const auto within = [](double v, int size) {
    return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(size)));
  };
  return {within(low.x() - 3, whole.x1), within(low.y() - 3, whole.y1),
          within(high.x() + 4, whole.x1), within(high.y() + 4, whole.y1)};
}

Bgr Mixed(Bgr background, double covered, double light) {
  const auto mix = [&](std::uint8_t behind) {
    return static_cast<std::uint8_t>(std::clamp(behind * (1 - covered) + 255 * light, 0.0, 255.0) +
                                     0.5);
  };
  return {mix(background.b), mix(background.g), mix(background.r)};
}

}  // namespace

BoardPath::BoardPath(const std::vector<CameraCalibration>& cameras, std::uint64_t seed)
    : cameras_(cameras), seed_(seed) {}

RigidTransform BoardPath::PlaceOf(std::uint64_t number) const {
  Random random(Mix(seed_, Tag("board"), number));
  return number % 3 == 0 ? HeldBefore(cameras_[number / 3 % cameras_.size()], random)
                         : HeldUp(random);
}

RigidTransform BoardPath::PoseAt(double t_s) const {
  const double places = std::max(0.0, t_s) / (kMoveBoard_s + kHoldBoard_s);
  const auto number = static_cast<std::uint64_t>(places);
  const double within_s = (places - static_cast<double>(number)) * (kMoveBoard_s + kHoldBoard_s);
  const double share = Smoothstep(0, 1, (within_s - kHoldBoard_s) / kMoveBoard_s);
  const RigidTransform from = PlaceOf(number), to = PlaceOf(number + 1);
  const Matrix3 R_WB = from.R * ExpRotation(share * LogRotation(from.R.transpose() * to.R));
  return Centred(
      R_WB, (1 - share) * (from * PrintedBoard::Middle()) + share * (to * PrintedBoard::Middle()));
}

RigidTransform BoardOnFloor() {
  const Matrix3 R_WB = Vector3(1, -1, -1).asDiagonal();
  return {R_WB, Vector3::Zero()};
}

RigidTransform BoardOnDesk(std::uint64_t seed, int place) {
  Random random(Mix(seed, Tag("desk"), static_cast<std::uint64_t>(place)));
  const Vector3 middle_W = random.UniformIn({-800, 800}, {-800, 800}, {500, 1100});
  const Matrix3 turned = ExpRotation({0, 0, random.Uniform(-std::numbers::pi, std::numbers::pi)});
  const Matrix3 tilted = ExpRotation({random.Uniform(-0.3, 0.3), random.Uniform(-0.3, 0.3), 0});
  return Centred(turned * tilted * BoardOnFloor().R, middle_W);
}

void PaintBoard(const CameraCalibration& camera, const RigidTransform& X_CW,
                const RigidTransform& X_WB, const Image<float>& nearness, Image<Bgr>& canvas) {
  const RigidTransform X_CB = X_CW * X_WB;
  const RigidTransform X_BC = X_CB.Inverse();
  const bool is_front = X_BC.p.z() < 0;
  // Lamps are above; surfaces that face down are lit by the floor.
  const double light = 0.72 - 0.25 * (is_front ? X_WB.R(2, 2) : -X_WB.R(2, 2));
  const BoardBox box = BoxOf(camera, X_CB);
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      int covered = 0;
      double ink = 0;
      for (int sample = 0; sample < kBoardSamples * kBoardSamples; ++sample) {
        const Vector2 pixel(x + (sample % kBoardSamples + 0.5) / kBoardSamples - 0.5,
                            y + (sample / kBoardSamples + 0.5) / kBoardSamples - 0.5);
        const auto direction = NormalizedFromPixel(camera.lens, pixel);
        if (!direction) continue;
        const Vector3 ray_B = X_BC.R * direction->homogeneous();
        const double depth_mm = -X_BC.p.z() / ray_B.z();
        if (!(depth_mm > 0 && depth_mm * nearness(x, y) < kAsNear)) continue;
        const auto here = InkAt((X_BC.p + depth_mm * ray_B).head<2>());
        if (!here) continue;
        ++covered;
        ink += is_front ? *here : kBehind;
      }
      constexpr double kAll = kBoardSamples * kBoardSamples;
      if (covered > 0) canvas(x, y) = Mixed(canvas(x, y), covered / kAll, light * ink / kAll);
    }
  }
}

}  // namespace mocap::simulation
