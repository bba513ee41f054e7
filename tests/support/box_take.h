// A take of a box in a grey room, with a truth and a result that differ by 12 mm.
#pragma once

#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "core/body/body_model.h"
#include "core/evaluation/accuracy.h"
#include "drivers/take/take_writer.h"
#include "tools/results/result.h"

namespace mocap::testing {

inline constexpr int kWidth = 320, kHeight = 240, kFrames = 20;
inline constexpr std::int64_t kFirstNs = 1'000'000'000'000, kPeriodNs = 100'000'000;

/// A camera 3 m from (0, 0, 1 m) in a direction of the floor, looking at it.
inline CameraCalibration CameraAt(const std::string& name, const Vector3& direction_W) {
  CameraCalibration camera;
  camera.name = name;
  camera.width_px = kWidth;
  camera.height_px = kHeight;
  OpenCvLens lens;
  lens.K << 400, 0, kWidth / 2.0, 0, 400, kHeight / 2.0, 0, 0, 1;
  camera.lens = lens;
  Matrix3 R_CW;
  R_CW.row(2) = -direction_W.transpose();
  R_CW.row(1) = -Vector3::UnitZ().transpose();
  R_CW.row(0) = Vector3(R_CW.row(1)).cross(Vector3(R_CW.row(2))).transpose();
  camera.X_CW = {R_CW, -(R_CW * (3000 * direction_W + Vector3(0, 0, 1000)))};
  return camera;
}

/// A grey room with a little noise, and a dark box of 450 mm in its middle.
inline Image<Bgr> Picture(bool with_box, std::uint32_t seed) {
  std::mt19937 random(seed);
  Image<Bgr> image(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool in_box =
          with_box && std::abs(x - kWidth / 2) < 30 && std::abs(y - kHeight / 2) < 30;
      const auto value = static_cast<std::uint8_t>((in_box ? 20 : 140) + random() % 7);
      image(x, y) = {value, value, static_cast<std::uint8_t>(value + (in_box ? 60 : 0))};
    }
  }
  return image;
}

inline BodyPoints TruePoints(int frame) {
  BodyPoints points = BodyPoints::Zero();
  for (int i = 0; i < kPointCount; ++i) {
    points.col(i) = Vector3(10 * i, (i % 3) * 50 - 50, 400 + 40 * i) + Vector3(3 * frame, 0, 0);
  }
  return points;
}

/// Three cameras, of which the third misses the second half, and what is true.
inline void WriteBoxTake(const std::filesystem::path& take) {
  TakeDescription description{"<box>", 10, {}, {}};
  description.cameras = {CameraAt("east", {1, 0, 0}), CameraAt("north", {0, 1, 0}),
                         CameraAt("west", {-1, 0, 0})};
  TakeWriter writer(take, description);
  std::vector<std::string> joints;
  for (const Point point : kScoredPoints) {
    const std::string name(kPointNames[static_cast<int>(point)]);
    joints.push_back(name.starts_with("foot") ? "ankle" + name.substr(4) : name);
  }
  writer.SetTruthColumns({joints});
  for (int camera = 0; camera < 3; ++camera) {
    for (int i = 0; i < 12; ++i) {
      writer.WriteBackground(camera, Picture(false, 50 * camera + i).view(), i * kPeriodNs);
    }
  }
  for (int frame = 0; frame < kFrames; ++frame) {
    const std::int64_t time_ns = kFirstNs + frame * kPeriodNs;
    for (int camera = 0; camera < 3; ++camera) {
      // The camera in the west misses the second half.
      if (camera == 2 && frame >= kFrames / 2) continue;
      writer.WriteFrame(camera, Picture(true, 1000 + 3 * frame + camera).view(),
                        time_ns + 1'000'000 * camera);
    }
    const ScoredPoints points = ScoredPointsOf(TruePoints(frame));
    const std::vector<Vector3> points_W(points.colwise().begin(), points.colwise().end());
    writer.WriteTruth(frame, time_ns, {points_W});
  }
  writer.WriteTruthSizes({1700, 0, {{"torso_mm", 550}}});
  writer.Finish();
}

/// A result that is 12 mm off in z.
inline void WriteBoxResult(const std::filesystem::path& folder) {
  Result result;
  result.body.model = "full";
  result.body.stature_mm = 1712;
  result.body.sizes.torso = 560;
  for (int frame = 0; frame < kFrames; ++frame) {
    PoseRow& row = result.poses.emplace_back();
    row.frame = frame;
    row.timestamp_ns = kFirstNs + frame * kPeriodNs;
    row.state = frame < 2 ? CaptureState::kAcquiring : CaptureState::kTracking;
    row.has_pose = true;
    row.points_W = TruePoints(frame).colwise() + Vector3(0, 0, 12);
    row.residual_mm = 8;
    row.voxels = 5000;
  }
  WriteResult(folder, result);
}

}  // namespace mocap::testing
