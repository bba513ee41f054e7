#include "core/body/recognition.h"

#include <cmath>

namespace mocap {
namespace {

// Standard deviations of a size between two measurements of one person, and among people.
struct Spread {
  double again;
  double people;
};
// Of the stature's logarithm: shoes, hair and cut outlines, compared with a population of both
// sexes (ANSUR). Likewise of the torso's share of the stature.
constexpr Spread kStature = {0.01, 0.06};
constexpr Spread kTorsoShare = {0.012, 0.025};
// Prior odds of a person without stored sizes, relative to any one person with stored sizes.
constexpr double kStranger = 0.25;

constexpr double Square(double x) { return x * x; }

// Without a common factor.
double NormalDensity(double x, double deviation) {
  return std::exp(-0.5 * Square(x / deviation)) / deviation;
}

double TorsoShare(const BodySizes& sizes) { return sizes.torso / sizes.Stature(); }

// Likelihood of measured sizes, given earlier measurements of a person.
double LikelihoodOf(const BodySizes& measured, const BodySizes& known) {
  // Both were measured.
  const double stature = std::sqrt(2) * kStature.again;
  const double torso = std::sqrt(2) * kTorsoShare.again;
  return NormalDensity(std::log(measured.Stature() / known.Stature()), stature) *
         NormalDensity(std::log(TorsoShare(measured) / TorsoShare(known)), torso);
}

// The same for strangers: a stranger as tall as a known person is assumed to be common.
double LikelihoodOfStranger() {
  const double stature = std::hypot(kStature.people, kStature.again);
  const double torso = std::hypot(kTorsoShare.people, kTorsoShare.again);
  return NormalDensity(0, stature) * NormalDensity(0, torso);
}

}  // namespace

Likeness WhoIs(const BodySizes& measured, std::span<const KnownPerson> known) {
  Likeness likeness;
  double sum = kStranger * LikelihoodOfStranger(), most = sum;
  for (const KnownPerson& person : known) {
    const double weight = LikelihoodOf(measured, person.sizes);
    sum += weight;
    if (weight <= most) continue;
    most = weight;
    likeness.person = &person;
  }
  likeness.certainty = most / sum;
  return likeness;
}

}  // namespace mocap
