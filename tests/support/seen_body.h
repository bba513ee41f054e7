// A person made of the model's own flesh, as six ideal cameras see it: outlines and visual hull.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/body/body_model.h"
#include "core/evidence/evidence.h"
#include "core/reconstruction/carving/carver.h"
#include "core/reconstruction/silhouette/outline.h"

namespace mocap {

/// Six cameras of 320 x 240 pixels in a circle around the origin, 2.4 m above the floor.
class RoundStudio {
 public:
  explicit RoundStudio(double radius_mm = 3200) {
    Matrix3 K = Matrix3::Identity();
    K(0, 0) = K(1, 1) = 260;
    K(0, 2) = 159.5;
    K(1, 2) = 119.5;
    for (int i = 0; i < 6; ++i) {
      const double angle = i * EIGEN_PI / 3;
      CameraCalibration camera;
      camera.width_px = 320;
      camera.height_px = 240;
      camera.lens = OpenCvLens{.K = K, .distortion = {}};
      camera.X_CW =
          LookingAt({radius_mm * std::cos(angle), radius_mm * std::sin(angle), 2400}, {0, 0, 950});
      cameras_.push_back(camera);
      tables_.emplace_back(camera);
    }
  }

  const std::vector<CameraCalibration>& cameras() const { return cameras_; }
  std::vector<CameraEye> Eyes() const {
    std::vector<CameraEye> eyes;
    for (std::size_t i = 0; i < cameras_.size(); ++i)
      eyes.push_back({&tables_[i], cameras_[i].X_CW});
    return eyes;
  }

  /// What camera `index` sees of flesh.
  Silhouette See(std::size_t index, const std::vector<PosedCapsule>& flesh) const {
    const CameraCalibration& camera = cameras_[index];
    const RigidTransform X_WC = camera.X_CW.Inverse();
    Silhouette silhouette(camera.width_px, camera.height_px);
    for (const PosedCapsule& capsule : flesh) {
      const PixelBox box = BoxAround(camera, capsule);
      for (int y = box.top; y <= box.bottom; ++y) {
        for (int x = box.left; x <= box.right; ++x) {
          if (silhouette.Test(x, y)) continue;
          const Vector3 far_W = X_WC * (8000 * NormalizedOf(camera, x, y).homogeneous());
          const Vector3 direction_W = (far_W - X_WC.p).normalized();
          const double aside_mm = direction_W.cross(capsule.middle_W - X_WC.p).norm();
          if (aside_mm <= capsule.reach_mm && capsule.DistanceTo(X_WC.p, far_W).outside_mm <= 0)
            silhouette.Set(x, y);
        }
      }
    }
    return silhouette;
  }

  /// What tracking gets of a person.
  struct CarvedBody {
    VoxelGrid hull;
    std::vector<Outline> outlines;
  };

  CarvedBody Carve(const BodyModel& body, const PoseState& pose) const {
    std::vector<PosedCapsule> flesh;
    body.PoseShape(body.PostureAt(pose), flesh);
    return Carve(flesh, 100);
  }

  /// What it gets of flesh, with so many rays a camera.
  CarvedBody Carve(const std::vector<PosedCapsule>& flesh, int rays) const {
    return CarveAsSeen(std::vector(cameras_.size(), flesh), rays);
  }

  /// What it gets where each camera sees other parts.
  CarvedBody CarveAsSeen(const std::vector<std::vector<PosedCapsule>>& flesh, int rays) const {
    std::vector<Silhouette> silhouettes;
    CarvedBody carved{{}, std::vector<Outline>(cameras_.size())};
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      silhouettes.push_back(See(i, flesh[i]));
      TraceOutline(cameras_[i], cameras_[i].X_CW, {silhouettes[i], {}}, rays, carved.outlines[i]);
    }
    std::vector<CarvingView> views;
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      views.push_back({&tables_[i], &silhouettes[i], cameras_[i].X_CW});
    }
    Carver(CarvingOptions{}).Carve(views, carved.hull);
    return carved;
  }

  Evidence Show(const BodyModel& body, const PoseState& pose) const {
    const CarvedBody carved = Carve(body, pose);
    Evidence evidence;
    evidence.Gather({carved.hull, carved.outlines});
    return evidence;
  }

 private:
  /// All cameras have the same lens.
  static const Vector2& NormalizedOf(const CameraCalibration& camera, int x, int y) {
    static const std::vector<Vector2> directions = [&camera] {
      std::vector<Vector2> of_pixels;
      for (int v = 0; v < camera.height_px; ++v) {
        for (int u = 0; u < camera.width_px; ++u)
          of_pixels.push_back(*NormalizedFromPixel(camera.lens, Vector2(u, v)));
      }
      return of_pixels;
    }();
    return directions[static_cast<std::size_t>(y) * camera.width_px + x];
  }

  /// Contains every pixel whose ray meets the capsule's bounding sphere.
  static PixelBox BoxAround(const CameraCalibration& camera, const PosedCapsule& capsule) {
    const PixelBox all{0, 0, camera.width_px - 1, camera.height_px - 1};
    const Vector3 p_C = camera.X_CW * capsule.middle_W;
    const double off_axis = std::atan2(p_C.head<2>().norm(), p_C.z());
    const double half_angle = std::asin(std::min(1.0, capsule.reach_mm / p_C.norm()));
    if (off_axis + half_angle > 1.4) return all;
    const auto middle = PixelFromNormalized(camera.lens, p_C.head<2>() / p_C.z());
    // The cone's section with the picture's plane reaches farthest away from its middle.
    const double reach_px = 2 + std::get<OpenCvLens>(camera.lens).K(0, 0) *
                                    (std::tan(off_axis + half_angle) - std::tan(off_axis));
    return {std::max(all.left, static_cast<int>(middle->x() - reach_px)),
            std::max(all.top, static_cast<int>(middle->y() - reach_px)),
            std::min(all.right, static_cast<int>(middle->x() + reach_px)),
            std::min(all.bottom, static_cast<int>(middle->y() + reach_px))};
  }

  static RigidTransform LookingAt(const Vector3& eye_W, const Vector3& target_W) {
    const Vector3 forward = (target_W - eye_W).normalized();
    const Vector3 right = forward.cross(Vector3::UnitZ()).normalized();
    RigidTransform X_CW;
    X_CW.R << right.transpose(), forward.cross(right).transpose(), forward.transpose();
    X_CW.p = -(X_CW.R * eye_W);
    return X_CW;
  }

  std::vector<CameraCalibration> cameras_;
  std::vector<SensorPlaneTable> tables_;
};

}  // namespace mocap
