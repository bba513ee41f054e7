// A wheelchair that fits a person.
#pragma once

#include "drivers/virtual_studio/people/anthropometry.h"

namespace mocap::simulation {

class TubeBuilder;

/// Measures of a wheelchair that fits a person [mm].
struct Wheelchair {
  double hips_mm = 0;          ///< Height of the hip joints.
  double wheel_radius_mm = 0;  ///< Of the large wheels, to the outside of the tyre.
  double axle_forward_mm = 0;  ///< Before the hips.
  double wheel_out_mm = 0;     ///< Distance of their planes from the middle.
  double footrest_mm = 0;      ///< Height of the footrest's top.
  double feet_forward_mm = 0;  ///< Ankles before the hips.
};

Wheelchair FitWheelchair(const Anthropometry& body);

/// Adds the chair to the surface of a person, fixed to the pelvis.
void AddWheelchair(const Anthropometry& body, TubeBuilder& builder);

}  // namespace mocap::simulation
