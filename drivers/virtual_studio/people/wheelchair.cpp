#include "drivers/virtual_studio/people/wheelchair.h"

#include <algorithm>
#include <cmath>

#include "drivers/virtual_studio/curve.h"
#include "drivers/virtual_studio/people/tube_builder.h"

namespace mocap::simulation {
namespace {

constexpr double kTyre_mm = 14;  // Half its thickness.

// A tube or box of the chair, in the pelvis's frame.
Ring ChairRing(const TubeBuilder& builder, const RigidTransform& X_PRing, double half_x_mm,
               double half_y_mm) {
  Ring ring;
  ring.X_WRing = builder.rest()[kPelvis] * X_PRing;
  ring.section.front = ring.section.back = half_x_mm;
  ring.section.outer = ring.section.inner = half_y_mm;
  ring.weights[kPelvis] = 1;
  return ring;
}

void AddBox(const Vector3& middle_P, const Vector3& half_mm, TubeBuilder& builder) {
  builder.AddTube(1, -1, PlainStyle(kLoad, 4, 16), [&](double s) {
    Ring ring = ChairRing(builder, {Matrix3::Identity(), middle_P + Vector3(0, 0, s * half_mm.z())},
                          half_mm.x(), half_mm.y());
    ring.roundness = 5;
    return ring;
  });
}

// A tyre: one sees through the wheel.
void AddTyre(const Vector3& axle_P, const Wheelchair& chair, TubeBuilder& builder) {
  constexpr double kAlmostAround = 0.999;
  builder.AddTube(0, kAlmostAround, PlainStyle(kLoad, 36, 8), [&](double s) {
    const double c = std::cos(kTurn * s), d = std::sin(kTurn * s);
    Matrix3 R_PRing;
    R_PRing << d, 0, -c,  //
        0, 1, 0,          //
        c, 0, d;
    const Vector3 p_P = axle_P + (chair.wheel_radius_mm - kTyre_mm) * Vector3(d, 0, c);
    return ChairRing(builder, {R_PRing, p_P}, kTyre_mm, kTyre_mm);
  });
}

}  // namespace

Wheelchair FitWheelchair(const Anthropometry& body) {
  const double h = body.stature_mm;
  Wheelchair chair;
  chair.footrest_mm = 0.03 * h;
  chair.hips_mm = chair.footrest_mm + body.ankle_to_sole_mm + 0.94 * body.shank_mm;
  chair.wheel_radius_mm = 0.158 * h;
  chair.axle_forward_mm = 0.02 * h;
  chair.wheel_out_mm = (0.125 + 0.015 * std::max(body.girth, 0.0)) * h;
  chair.feet_forward_mm = 0.97 * body.thigh_mm + 0.1 * body.shank_mm;
  return chair;
}

void AddWheelchair(const Anthropometry& body, TubeBuilder& builder) {
  const Wheelchair chair = FitWheelchair(body);
  const double h = body.stature_mm, seat_half = chair.wheel_out_mm - 2 * kTyre_mm;
  constexpr double kPlate_mm = 15;
  const double seat_mm = -0.052 * h - kPlate_mm;  // Below the thighs.
  AddBox({0.38 * body.thigh_mm, 0, seat_mm}, {0.5 * body.thigh_mm, seat_half, kPlate_mm}, builder);
  AddBox({-0.085 * h, 0, 0.09 * h}, {kPlate_mm, seat_half, 0.15 * h}, builder);
  AddBox({chair.feet_forward_mm + 0.03 * h, 0, chair.footrest_mm - kPlate_mm - chair.hips_mm},
         {0.07 * h, 0.09 * h, kPlate_mm}, builder);
  const double front_mm = 0.88 * body.thigh_mm, low_mm = chair.footrest_mm - chair.hips_mm;
  for (const double side : {1.0, -1.0}) {
    AddTyre(
        {chair.axle_forward_mm, side * chair.wheel_out_mm, chair.wheel_radius_mm - chair.hips_mm},
        chair, builder);
    AddBox({front_mm, side * 0.09 * h, 0.5 * (seat_mm + low_mm)},
           {kTyre_mm, kTyre_mm, 0.5 * (seat_mm - low_mm)}, builder);
  }
}

}  // namespace mocap::simulation
