#include <algorithm>

#include "drivers/virtual_studio/people/person_mesh.h"
#include "drivers/virtual_studio/random.h"

namespace mocap::simulation {
namespace {

Bgr Color(double r, double g, double b) {
  const auto byte = [](double v) { return static_cast<std::uint8_t>(std::clamp(v, 0.0, 255.0)); };
  return {byte(b), byte(g), byte(r)};
}

// A cloth colour: any hue, a grey, or a colour close to the wall's.
Bgr Cloth(Random& random, Bgr wall) {
  const double kind = random.Uniform(0, 1);
  if (kind < 0.2) {
    const Vector3 off = random.UniformIn({-18, 18}, {-18, 18}, {-18, 18});
    return Color(wall.r + off.x(), wall.g + off.y(), wall.b + off.z());
  }
  const double value = random.Uniform(60, 190);
  if (kind < 0.4) return Color(value, value * 0.98, value * 0.94);
  const double low = value * random.Uniform(0.25, 0.6), middle = random.Uniform(low, value);
  switch (random.Bits() % 6) {
    case 0:
      return Color(value, middle, low);
    case 1:
      return Color(value, low, middle);
    case 2:
      return Color(middle, value, low);
    case 3:
      return Color(low, value, middle);
    case 4:
      return Color(middle, low, value);
    default:
      return Color(low, middle, value);
  }
}

}  // namespace

Outfit MakeOutfit(std::uint64_t seed, Bgr wall) {
  Random random(Mix(seed, Tag("outfit")));
  Outfit outfit;
  const double tan = random.Uniform(0, 1);
  outfit.colors[kSkin] = Color(225 - 130 * tan, 180 - 120 * tan, 155 - 115 * tan);
  const double hair = random.Uniform(25, 110);
  outfit.colors[kHair] = Color(hair, hair * 0.75, hair * 0.55);
  outfit.colors[kShirt] = Cloth(random, wall);
  outfit.colors[kStripe] = Cloth(random, wall);
  outfit.colors[kTrousers] = Cloth(random, wall);
  const double shoes = random.Uniform(30, 120);
  outfit.colors[kShoes] = Color(shoes, shoes * 0.95, shoes * 0.9);
  outfit.striped = random.Uniform(0, 1) < 0.3;
  outfit.sleeve_end = random.Uniform(0, 1) < 0.5 ? random.Uniform(0.45, 0.8) : 1.93;
  outfit.trouser_end = random.Uniform(0, 1) < 0.2 ? random.Uniform(0.6, 0.9) : 1.97;
  outfit.trouser_slack_mm = random.Uniform(3, 14);
  outfit.colors[kHat] = Cloth(random, wall);
  outfit.colors[kLoad] = Cloth(random, wall);
  return outfit;
}

}  // namespace mocap::simulation
