// Body shape of the simulated person: cross-sections along torso, limbs, feet and head. No part is
// an ellipsoid or a cylinder.
#pragma once

#include <span>

#include "drivers/virtual_studio/people/anthropometry.h"

namespace mocap::simulation {

/// An oval cross-section. Its centre need not lie on the bone.
struct Section {
  double s = 0;                ///< Position along the part.
  double cx = 0, cy = 0;       ///< Centre: forward, outward (towards the limb's side).
  double front = 0, back = 0;  ///< Extents from the centre.
  double outer = 0, inner = 0;
};

/// Interpolates sections smoothly. Outside the table, the end sections hold.
Section Interpolate(std::span<const Section> table, double s);

/// Multiplies the extents.
Section Thickened(Section section, double factor);
/// Adds to the extents, as loose cloth does.
Section Loosened(Section section, double slack_mm);

/// Torso and neck [mm]; s: 0 at the hips, 1 at C7.
Section TorsoSection(const Anthropometry& body, double s);
/// Leg [mm]; s: 0 at the hip, 1 at the knee, 2 at the ankle.
Section LegSection(const Anthropometry& body, double s);
/// Arm and hand [mm]; s: 0 at the shoulder, 1 at the elbow, 2 at the wrist, 3 at the fingertips.
Section ArmSection(const Anthropometry& body, double s);
/// Head [mm]; s: 0 at the chin, 1 at the vertex; centres relative to the middle of the skull.
Section HeadSection(const Anthropometry& body, double s);
/// Cross-section of foot and shoe [mm]; s: 0 at the heel, 1 at the tip. `front` is the height of
/// the top above the sole, `back` is 0; outer and inner are half widths.
Section FootSection(const Anthropometry& body, double s);

}  // namespace mocap::simulation
