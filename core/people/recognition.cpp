#include "core/people/recognition.h"

#include <cmath>

namespace mocap {
namespace {

// By how much a size differs when one person is measured twice, and among people.
struct Spread {
  double again;
  double people;
};
// Of the stature's logarithm: shoes, hair and outlines that are cut short, against a population of
// both sexes (ANSUR). Of the torso's share of the stature, likewise.
constexpr Spread kStature = {0.01, 0.06};
constexpr Spread kTorsoShare = {0.012, 0.025};
// How likely somebody is to come whose sizes are not kept, over any one of those whose are.
constexpr double kStranger = 0.25;

constexpr double Square(double x) { return x * x; }

// But for a factor that all have in common.
double NormalDensity(double x, double deviation) {
  return std::exp(-0.5 * Square(x / deviation)) / deviation;
}

double TorsoShare(const BodySizes& sizes) { return sizes.torso / sizes.Stature(); }

// How likely it is to measure sizes where those of a person were measured before.
double LikelihoodOf(const BodySizes& measured, const BodySizes& known) {
  // Both were measured.
  const double stature = std::sqrt(2) * kStature.again;
  const double torso = std::sqrt(2) * kTorsoShare.again;
  return NormalDensity(std::log(measured.Stature() / known.Stature()), stature) *
         NormalDensity(std::log(TorsoShare(measured) / TorsoShare(known)), torso);
}

// Likewise of anybody: whoever is as tall as those that are known is where strangers are common.
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
