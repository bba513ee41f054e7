#include "drivers/virtual_studio/people/body_profiles.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mocap::simulation {
namespace {

// Shares of stature for an average man; breadths, depths and girths from ANSUR (Gordon et al.
// 1989): at 1755 mm chest 320 × 240, waist 310 × 225, hips 345 × 245, thigh 597 around, knee 386,
// calf 378, ankle 222, upper arm 335, forearm 300, wrist 173, neck 380.
// clang-format off
constexpr std::array<Section, 15> kTorsoSections = {{
    // s      cx      cy  front  back   outer  inner
    {-0.19,  0.000, 0, 0.022, 0.024, 0.022, 0.022},
    {-0.15,  0.000, 0, 0.046, 0.052, 0.055, 0.055},
    {-0.07,  0.000, 0, 0.058, 0.070, 0.086, 0.086},
    { 0.02,  0.000, 0, 0.062, 0.073, 0.097, 0.097},
    { 0.15,  0.002, 0, 0.062, 0.064, 0.092, 0.092},
    { 0.30,  0.004, 0, 0.062, 0.054, 0.084, 0.084},
    { 0.45,  0.002, 0, 0.066, 0.058, 0.085, 0.085},
    { 0.60,  0.000, 0, 0.070, 0.066, 0.090, 0.090},
    { 0.72, -0.004, 0, 0.069, 0.066, 0.096, 0.096},
    { 0.82, -0.007, 0, 0.054, 0.060, 0.097, 0.097},
    { 0.885,-0.009, 0, 0.043, 0.050, 0.087, 0.087},
    { 0.94, -0.008, 0, 0.036, 0.043, 0.060, 0.060},
    { 1.00, -0.005, 0, 0.032, 0.037, 0.037, 0.037},
    { 1.08,  0.002, 0, 0.031, 0.033, 0.0325, 0.0325},
    { 1.20,  0.006, 0, 0.029, 0.032, 0.031, 0.031},
}};

constexpr std::array<Section, 15> kLegSections = {{
    {-0.14, -0.006, 0.004, 0.012, 0.012, 0.010, 0.010},
    {-0.12, -0.004, 0.003, 0.036, 0.040, 0.030, 0.032},
    {-0.06, -0.002, 0.000, 0.052, 0.064, 0.044, 0.040},
    { 0.00,  0.000, 0.000, 0.055, 0.068, 0.048, 0.043},
    { 0.15,  0.001, 0.000, 0.055, 0.060, 0.047, 0.046},
    { 0.40,  0.004, 0.000, 0.050, 0.047, 0.043, 0.041},
    { 0.70,  0.004, 0.000, 0.041, 0.037, 0.036, 0.035},
    { 0.92,  0.003, 0.000, 0.036, 0.031, 0.031, 0.032},
    { 1.03,  0.003, 0.000, 0.034, 0.030, 0.031, 0.031},
    { 1.15,  0.000, 0.001, 0.029, 0.033, 0.030, 0.030},
    { 1.32, -0.003, 0.001, 0.026, 0.039, 0.033, 0.033},
    { 1.55, -0.003, 0.000, 0.023, 0.034, 0.028, 0.028},
    { 1.80, -0.002, 0.000, 0.019, 0.023, 0.020, 0.020},
    { 1.98, -0.002, 0.000, 0.019, 0.021, 0.0185, 0.0185},
    { 2.06, -0.002, 0.000, 0.019, 0.021, 0.018, 0.018},
}};

constexpr std::array<Section, 19> kArmSections = {{
    {-0.20,  0.000, -0.014, 0.006, 0.006, 0.005, 0.006},
    {-0.18,  0.000, -0.012, 0.017, 0.017, 0.011, 0.016},
    {-0.10,  0.000, -0.006, 0.028, 0.029, 0.018, 0.028},
    { 0.00,  0.000, -0.002, 0.034, 0.035, 0.025, 0.033},
    { 0.20,  0.000,  0.001, 0.034, 0.034, 0.031, 0.031},
    { 0.50,  0.001,  0.000, 0.031, 0.030, 0.026, 0.027},
    { 0.80,  0.000,  0.000, 0.026, 0.026, 0.023, 0.024},
    { 1.00,  0.000,  0.000, 0.024, 0.025, 0.023, 0.023},
    { 1.20,  0.001,  0.001, 0.028, 0.027, 0.025, 0.024},
    { 1.50,  0.000,  0.000, 0.024, 0.023, 0.021, 0.021},
    { 1.80,  0.000,  0.000, 0.0185, 0.0175, 0.015, 0.015},
    { 2.00,  0.000,  0.000, 0.0165, 0.0165, 0.012, 0.012},
    { 2.12,  0.001,  0.000, 0.020, 0.019, 0.012, 0.013},
    { 2.35,  0.000,  0.000, 0.0235, 0.0225, 0.010, 0.012},
    { 2.50,  0.000,  0.000, 0.0225, 0.0225, 0.009, 0.010},
    { 2.70,  0.000, -0.001, 0.0205, 0.0205, 0.007, 0.008},
    { 2.88,  0.000, -0.002, 0.016, 0.016, 0.005, 0.006},
    { 2.97,  0.000, -0.002, 0.009, 0.009, 0.003, 0.004},
    { 3.00,  0.000, -0.002, 0.004, 0.004, 0.002, 0.002},
}};

// Shares of the head's height.
constexpr std::array<Section, 11> kHeadSections = {{
    {0.00, 0.20, 0, 0.10, 0.10, 0.08, 0.08},
    {0.04, 0.14, 0, 0.23, 0.18, 0.17, 0.17},
    {0.15, 0.06, 0, 0.35, 0.26, 0.245, 0.245},
    {0.30, 0.00, 0, 0.43, 0.33, 0.29, 0.29},
    {0.38, 0.00, 0, 0.465, 0.38, 0.31, 0.31},
    {0.48, 0.00, 0, 0.435, 0.42, 0.33, 0.33},
    {0.62, 0.00, 0, 0.43, 0.44, 0.34, 0.34},
    {0.76, 0.00, 0, 0.395, 0.42, 0.325, 0.325},
    {0.88, 0.00, 0, 0.30, 0.33, 0.255, 0.255},
    {0.965,0.00, 0, 0.165, 0.18, 0.145, 0.145},
    {1.00, 0.00, 0, 0.04, 0.05, 0.04, 0.04},
}};

constexpr std::array<Section, 10> kFootSections = {{
    {0.00, 0, 0.000, 0.020, 0, 0.007, 0.007},
    {0.04, 0, 0.000, 0.034, 0, 0.015, 0.015},
    {0.14, 0, 0.000, 0.046, 0, 0.0185, 0.0185},
    {0.28, 0, 0.000, 0.053, 0, 0.0195, 0.0195},
    {0.42, 0, 0.000, 0.046, 0, 0.020, 0.0195},
    {0.58, 0, 0.001, 0.034, 0, 0.024, 0.0215},
    {0.75, 0, 0.001, 0.025, 0, 0.0275, 0.0245},
    {0.88, 0, -0.001, 0.019, 0, 0.0245, 0.0225},
    {0.97, 0, -0.004, 0.013, 0, 0.014, 0.014},
    {1.00, 0, -0.004, 0.009, 0, 0.006, 0.006},
}};
// clang-format on

double Bump(double s, double middle, double half_width) {
  const double d = (s - middle) / half_width;
  return std::abs(d) < 1 ? 0.5 + 0.5 * std::cos(std::numbers::pi * d) : 0;
}

Section Scaled(Section section, double scale) {
  for (double* v :
       {&section.cx, &section.cy, &section.front, &section.back, &section.outer, &section.inner})
    *v *= scale;
  return section;
}

// Catmull-Rom spline through v1 at 0 and v2 at 1, for unequal distances of the keys.
double Spline(double v0, double v1, double v2, double v3, double d0, double d1, double d2,
              double u) {
  const double m1 = d1 * ((v1 - v0) / d0 * d1 + (v2 - v1) / d1 * d0) / (d0 + d1);
  const double m2 = d1 * ((v2 - v1) / d1 * d2 + (v3 - v2) / d2 * d1) / (d1 + d2);
  const double u2 = u * u, u3 = u2 * u;
  return (2 * u3 - 3 * u2 + 1) * v1 + (u3 - 2 * u2 + u) * m1 + (3 * u2 - 2 * u3) * v2 +
         (u3 - u2) * m2;
}

}  // namespace

Section Thickened(Section section, double factor) {
  for (double* v : {&section.front, &section.back, &section.outer, &section.inner}) *v *= factor;
  return section;
}

Section Loosened(Section section, double slack_mm) {
  for (double* v : {&section.front, &section.back, &section.outer, &section.inner}) *v += slack_mm;
  return section;
}

Section Interpolate(std::span<const Section> table, double s) {
  s = std::clamp(s, table.front().s, table.back().s);
  std::size_t i = 0;
  while (i + 2 < table.size() && table[i + 1].s < s) ++i;
  const Section& b = table[i];
  const Section& c = table[i + 1];
  const Section& a = i > 0 ? table[i - 1] : b;
  const Section& d = i + 2 < table.size() ? table[i + 2] : c;
  const double width = c.s - b.s, u = (s - b.s) / width;
  const double before = i > 0 ? b.s - a.s : width;
  const double after = i + 2 < table.size() ? d.s - c.s : width;
  Section result;
  result.s = s;
  for (double Section::*v : {&Section::cx, &Section::cy, &Section::front, &Section::back,
                             &Section::outer, &Section::inner})
    result.*v = Spline(a.*v, b.*v, c.*v, d.*v, before, width, after, u);
  return result;
}

Section TorsoSection(const Anthropometry& body, double s) {
  Section section = Scaled(Interpolate(kTorsoSections, s), body.stature_mm);
  const double g = body.girth, f = body.femininity;
  const double trunk = 1 - Bump(s, 1.1, 0.35);
  section = Thickened(section, 1 + 0.10 * g * trunk + 0.04 * g);
  section.front *= 1 + std::max(g, 0.0) * 0.30 * Bump(s, 0.28, 0.4) + 0.16 * f * Bump(s, 0.62, 0.2);
  section.back *= 1 + 0.06 * f * Bump(s, -0.02, 0.2);
  const double side =
      1 + f * (0.05 * Bump(s, 0, 0.25) - 0.10 * Bump(s, 0.36, 0.25) - 0.05 * Bump(s, 0.8, 0.3));
  section.outer *= side;
  section.inner *= side;
  return section;
}

Section LegSection(const Anthropometry& body, double s) {
  const double thigh = 1 - std::clamp(s, 0.0, 1.0);
  return Thickened(Scaled(Interpolate(kLegSections, s), body.stature_mm),
                   1 + body.girth * (0.08 + 0.07 * thigh) + 0.03 * body.femininity * thigh);
}

Section ArmSection(const Anthropometry& body, double s) {
  const double hand = std::clamp(s - 1, 0.0, 1.0);
  return Thickened(Scaled(Interpolate(kArmSections, s), body.stature_mm),
                   (1 + body.girth * 0.11 * (1 - 0.6 * hand)) * (1 - 0.08 * body.femininity));
}

Section HeadSection(const Anthropometry& body, double s) {
  return Scaled(Interpolate(kHeadSections, s), body.head_mm);
}

Section FootSection(const Anthropometry& body, double s) {
  return Scaled(Interpolate(kFootSections, s), body.stature_mm);
}

}  // namespace mocap::simulation
