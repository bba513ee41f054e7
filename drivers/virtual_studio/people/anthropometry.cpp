#include "drivers/virtual_studio/people/anthropometry.h"

#include <algorithm>

#include "drivers/virtual_studio/random.h"

namespace mocap::simulation {

// Shares of stature: Drillis and Contini (1966) as in Winter, Biomechanics and Motor Control of
// Human Movement, Fig. 4.1: ankle .039, knee .285, hip .530, shoulder .818, upper arm .186, forearm
// .146, hand .108, foot .152. Joint centres that differ from landmarks: distance of the hips, .72
// of that of the iliac spines (Bell et al. 1990); shoulder joint, 35 mm below the acromion; C7,
// .857 (cervicale, ANSUR, Gordon et al. 1989). A child's legs are shorter (sitting height ratio
// .555 at 1.1 m against .52; Bogin and Varela-Silva 2010). Its head is nearly as large as an
// adult's (195 mm at 1.15 m, 228 mm at 1.755 m; Snyder et al. 1977, ANSUR).
Anthropometry MakeAnthropometry(double stature_mm, std::uint64_t seed) {
  Random random(Mix(seed, Tag("build")));
  const double h = stature_mm;
  const double childhood = std::clamp((1600 - h) / 500, 0.0, 1.0);
  const double leg_share = (1 - 0.07 * childhood) * (1 + 0.012 * random.Uniform(-1, 1));
  const double arm_share = (1 - 0.03 * childhood) * (1 + 0.015 * random.Uniform(-1, 1));

  Anthropometry body;
  body.stature_mm = h;
  body.girth = random.Uniform(-1, 1);
  body.femininity = random.Uniform(0, 1) < 0.5 ? random.Uniform(0, 0.25) : random.Uniform(0.75, 1);
  if (childhood > 0) body.femininity *= 1 - 0.6 * childhood;
  body.ankle_to_sole_mm = 0.042 * h;
  body.shank_mm = 0.243 * h * leg_share;
  body.thigh_mm = 0.243 * h * leg_share;
  body.hip_half_mm = (0.052 + 0.002 * body.femininity) * h;
  body.head_mm = (228 + 0.0545 * (h - 1755)) * (1 + 0.02 * random.Uniform(-1, 1));
  body.torso_mm = h - 1.1 * body.head_mm - body.hip_height_mm();
  body.lumbar_mm = 0.22 * body.torso_mm;
  body.thorax_mm = 0.52 * body.torso_mm;
  body.shoulder_mm = 0.845 * body.torso_mm;
  body.shoulder_half_mm = (0.097 - 0.006 * body.femininity) * h;
  body.upper_arm_mm = 0.172 * h * arm_share;
  body.forearm_mm = 0.146 * h * arm_share;
  body.hand_mm = 0.106 * h * arm_share;
  body.skull_base_mm = 0.40 * body.head_mm;
  body.foot_mm = 0.152 * h;
  body.heel_mm = 0.040 * h;
  body.ball_mm = 0.072 * h;
  return body;
}

}  // namespace mocap::simulation
