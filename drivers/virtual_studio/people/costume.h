// What people wear and use beyond shirt and trousers: hair, hats, loose clothes, loads and aids.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "drivers/virtual_studio/people/anthropometry.h"

namespace mocap::simulation {

class TubeBuilder;

enum class Hair { kShort, kNone, kAfro, kLong, kBunches, kPonytail };
enum class Hat { kNone, kHelmet, kBrim };
/// Cloth that hangs from the waist. A coat and a gown are also loose above it.
enum class Drape { kNone, kSkirt, kCoat, kGown };

/// By default plain: short hair, and nothing else.
struct Costume {
  Hair hair = Hair::kShort;
  double hair_mm = 0;  ///< How far it stands off, or its length.
  Hat hat = Hat::kNone;
  Drape drape = Drape::kNone;
  double drape_end = 1;  ///< Along the leg: 1 is the knee, 2 the ankle.
  double drape_flare_mm = 0;
  double torso_slack_mm = 0, sleeve_slack_mm = 0;
  double backpack_mm = 0;  ///< Depth; 0: none.
  bool has_bag = false;    ///< In the right hand.
  bool has_crutches = false;
  bool has_wheelchair = false;
};

/// Only what the motion needs: a wheelchair for rolling.
Costume PlainCostume(std::string_view motion);
/// Chooses a costume at random, with what the motion needs. Crutches only go with motions of people
/// who walk or stand.
Costume MakeCostume(std::uint64_t seed, std::string_view motion);
/// Lists what is not plain, such as "afro, gown, backpack"; "plain" if nothing.
std::string Describe(const Costume& costume);

/// Makes a build less average: narrow or wide shoulders, and sometimes a heavy belly.
void VaryBuild(std::uint64_t seed, Anthropometry& body);

/// Adds hair, hat, drape and loads to the surface of a person.
void AddCostume(const Anthropometry& body, const Costume& costume, TubeBuilder& builder);

}  // namespace mocap::simulation
