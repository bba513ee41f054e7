#include "tools/report/body_outline.h"

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "tools/kinematics/rest_body.h"

namespace mocap {
namespace {

constexpr int kRingPoints = 20;

/// Appends an ellipse about a centre with two half axes.
void AddRing(const Vector3& center, const Vector3& a, const Vector3& b,
             std::vector<Vector3>& surface) {
  for (int i = 0; i < kRingPoints; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRingPoints;
    surface.push_back(center + std::cos(angle) * a + std::sin(angle) * b);
  }
}

std::vector<Vector3> Cylinder(const Vector3& from, const Vector3& to, double width_mm) {
  const Vector3 along = (to - from).stableNormalized();
  const Vector3 a = along.unitOrthogonal();
  const Vector3 b = along.cross(a);
  std::vector<Vector3> surface;
  AddRing(from, a * width_mm / 2, b * width_mm / 2, surface);
  AddRing(to, a * width_mm / 2, b * width_mm / 2, surface);
  return surface;
}

std::vector<Vector3> Ellipsoid(const Vector3& center, const Vector3& half_axis, double width_mm) {
  const Vector3 a = half_axis.unitOrthogonal() * width_mm / 2;
  const Vector3 b = half_axis.normalized().cross(a);
  std::vector<Vector3> surface;
  for (int i = 0; i <= kRingPoints / 2; ++i) {
    const double polar = 2 * std::numbers::pi * i / kRingPoints;
    AddRing(center + std::cos(polar) * half_axis, std::sin(polar) * a, std::sin(polar) * b,
            surface);
  }
  return surface;
}

/// From the hip line to the neck; the hips may be rotated relative to the chest.
std::vector<Vector3> Torso(const PoseRow& row, const BodySizes& sizes) {
  const Matrix3 R_WT = ExpRotation(row.paper.torso_axis * row.paper.torso_angle_rad);
  const Vector3 hips = (At(row, Point::kHipL) + At(row, Point::kHipR)) / 2;
  const Vector3 left_at_hips = (At(row, Point::kHipL) - At(row, Point::kHipR)).stableNormalized();
  const Vector3 forward = R_WT.col(0) * sizes.torso_depth / 2;
  std::vector<Vector3> surface;
  AddRing(At(row, Point::kNeck), forward, R_WT.col(1) * sizes.torso_width / 2, surface);
  AddRing(hips, forward, left_at_hips * sizes.torso_width / 2, surface);
  return surface;
}

/// The outline of a convex solid is the convex hull of its projected points.
void AddOutline(const std::vector<Vector3>& surface_W, BodySide side,
                const CameraCalibration& camera, const RigidTransform& X_CW,
                std::vector<BodyLine>& lines) {
  std::vector<cv::Point2f> pixels, hull;
  for (const Vector3& p_W : surface_W) {
    const auto pixel = ProjectPoint(camera, X_CW, p_W);
    if (!pixel) return;
    pixels.emplace_back(static_cast<float>(pixel->x()), static_cast<float>(pixel->y()));
  }
  cv::convexHull(pixels, hull);
  BodyLine& line = lines.emplace_back(BodyLine{side, {}});
  for (const cv::Point2f& p : hull) line.pixels.emplace_back(p.x, p.y);
}

}  // namespace

const std::vector<Stick>& Sticks() {
  using enum Point;
  using enum BodySide;
  static const std::vector<Stick> sticks = {
      {kHead, kNeck, kMiddle},        {kNeck, kTorso, kMiddle},
      {kNeck, kShoulderL, kLeft},     {kNeck, kShoulderR, kRight},
      {kShoulderL, kElbowL, kLeft},   {kShoulderR, kElbowR, kRight},
      {kElbowL, kFingertipsL, kLeft}, {kElbowR, kFingertipsR, kRight},
      {kTorso, kHipL, kLeft},         {kTorso, kHipR, kRight},
      {kHipL, kKneeL, kLeft},         {kHipR, kKneeR, kRight},
      {kKneeL, kFootL, kLeft},        {kKneeR, kFootR, kRight}};
  return sticks;
}

std::optional<Vector2> ProjectPoint(const CameraCalibration& camera, const RigidTransform& X_CW,
                                    const Vector3& p_WQ) {
  const Vector3 p_CQ = X_CW * p_WQ;
  if (p_CQ.z() <= 0) return std::nullopt;
  return PixelFromNormalized(camera.lens, p_CQ.head<2>() / p_CQ.z());
}

std::vector<BodyLine> PartOutlines(const PoseRow& row, const BodySizes& sizes,
                                   const CameraCalibration& camera, const RigidTransform& X_CW) {
  using enum Point;
  struct Limb {
    Point from, to;
    double width_mm;
    BodySide side;
  };
  const Limb limbs[] = {{kShoulderL, kElbowL, sizes.upper_arm_width, BodySide::kLeft},
                        {kShoulderR, kElbowR, sizes.upper_arm_width, BodySide::kRight},
                        {kElbowL, kFingertipsL, sizes.lower_arm_width, BodySide::kLeft},
                        {kElbowR, kFingertipsR, sizes.lower_arm_width, BodySide::kRight},
                        {kHipL, kKneeL, sizes.thigh_width, BodySide::kLeft},
                        {kHipR, kKneeR, sizes.thigh_width, BodySide::kRight},
                        {kKneeL, kFootL, sizes.calf_width, BodySide::kLeft},
                        {kKneeR, kFootR, sizes.calf_width, BodySide::kRight}};
  std::vector<BodyLine> lines;
  AddOutline(Torso(row, sizes), BodySide::kMiddle, camera, X_CW, lines);
  const Vector3 up = (At(row, kHead) - At(row, kNeck)).stableNormalized();
  AddOutline(Ellipsoid(At(row, kHead), up * sizes.head / 2, sizes.head_width), BodySide::kMiddle,
             camera, X_CW, lines);
  for (const Limb& limb : limbs) {
    AddOutline(Cylinder(At(row, limb.from), At(row, limb.to), limb.width_mm), limb.side, camera,
               X_CW, lines);
  }
  return lines;
}

std::vector<BodyLine> StickFigure(const PoseRow& row, const CameraCalibration& camera,
                                  const RigidTransform& X_CW) {
  std::vector<BodyLine> lines;
  for (const Stick& stick : Sticks()) {
    const auto from = ProjectPoint(camera, X_CW, At(row, stick.from));
    const auto to = ProjectPoint(camera, X_CW, At(row, stick.to));
    if (from && to) lines.push_back({stick.side, {*from, *to}});
  }
  return lines;
}

}  // namespace mocap
