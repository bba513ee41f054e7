#include "drivers/virtual_studio/people/costume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "drivers/virtual_studio/curve.h"
#include "drivers/virtual_studio/people/body_profiles.h"
#include "drivers/virtual_studio/people/tube_builder.h"
#include "drivers/virtual_studio/people/wheelchair.h"
#include "drivers/virtual_studio/random.h"

namespace mocap::simulation {
namespace {

Section Oval(double front_mm, double back_mm, double half_width_mm, double cx_mm = 0) {
  return {.s = 0,
          .cx = cx_mm,
          .cy = 0,
          .front = front_mm,
          .back = back_mm,
          .outer = half_width_mm,
          .inner = half_width_mm};
}

// An ellipsoid that is fixed to a bone. Radii along the bone's axes.
void AddEllipsoid(Bone bone, const Vector3& middle_B, const Vector3& radii_mm, Material material,
                  TubeBuilder& builder) {
  builder.AddTube(1, -1, PlainStyle(material, 13, 16), [&](double s) {
    const double height = std::sin(s * std::numbers::pi / 2);
    const double width = std::max(std::cos(s * std::numbers::pi / 2), 0.03);
    Ring ring;
    ring.X_WRing =
        builder.rest()[bone] *
        RigidTransform{Matrix3::Identity(), middle_B + Vector3(0, 0, height * radii_mm.z())};
    ring.section = Oval(width * radii_mm.x(), width * radii_mm.x(), width * radii_mm.y());
    ring.weights[bone] = 1;
    return ring;
  });
}

// Hair that hangs from the head onto the back.
// @param top_H  its beginning, in the head's frame.
void AddHangingHair(const Vector3& top_H, double length_mm, double backward, const Section& section,
                    TubeBuilder& builder) {
  builder.AddTube(1, 0, PlainStyle(kHair, 14, 14), [&](double s) {
    const double down_mm = (1 - s) * length_mm;
    Ring ring;
    ring.X_WRing =
        builder.rest()[kHead] *
        RigidTransform{Matrix3::Identity(), top_H - Vector3(backward * down_mm, 0, down_mm)};
    ring.section = Thickened(section, s < 0.12 || s > 0.9 ? 0.6 : 1);
    const double thorax = 0.8 * Smoothstep(0.3, 0.9, 1 - s);
    ring.weights[kHead] = 1 - thorax;
    ring.weights[kThorax] = thorax;
    return ring;
  });
}

void AddHair(const Anthropometry& body, const Costume& costume, TubeBuilder& builder) {
  const double head = body.head_mm, hair = costume.hair_mm;
  const Vector3 middle = HeadCenterInHead(body);
  switch (costume.hair) {
    case Hair::kShort:
    case Hair::kNone:
      return;
    case Hair::kAfro:
      return AddEllipsoid(kHead, middle + Vector3(-0.08, 0, 0.14) * head,
                          Vector3(0.40, 0.40, 0.42) * head + Vector3::Constant(hair), kHair,
                          builder);
    case Hair::kLong:
      return AddHangingHair(middle + Vector3(-0.20, 0, 0.40) * head, hair, 0,
                            Oval(0.22 * head, 0.32 * head, 0.42 * head), builder);
    case Hair::kPonytail:
      return AddHangingHair(middle + Vector3(-0.42, 0, 0.25) * head, hair, 0.3,
                            Oval(0.14 * head, 0.14 * head, 0.14 * head), builder);
    case Hair::kBunches:
      for (const double side : {1.0, -1.0})
        AddEllipsoid(kHead, middle + Vector3(-0.1 * head, side * (0.30 * head + hair), 0.15 * head),
                     Vector3(1, 1, 1.4) * hair, kHair, builder);
      return;
  }
}

void AddHat(const Anthropometry& body, Hat hat, TubeBuilder& builder) {
  if (hat == Hat::kNone) return;
  const double head = body.head_mm;
  const Vector3 middle = HeadCenterInHead(body) + Vector3(0, 0, 0.18 * head);
  AddEllipsoid(kHead, middle, Vector3(0.58, 0.49, 0.45) * head, kHat, builder);
  if (hat == Hat::kBrim)
    AddEllipsoid(kHead, middle, Vector3(0.95, 0.90, 0.04) * head, kHat, builder);
}

BoneWeights DrapeWeights(int side, double hip_mm, const Anthropometry& body) {
  BoneWeights weights{};
  const double thigh = Smoothstep(0, 0.4 * body.thigh_mm, hip_mm);
  const double shank = 0.5 * Smoothstep(0.9 * body.thigh_mm, 1.3 * body.thigh_mm, hip_mm) * thigh;
  weights[kPelvis] = 1 - thigh;
  weights[kThighL + side] = thigh - shank;
  weights[kShankL + side] = shank;
  return weights;
}

// It follows both legs: each side the nearer one.
void AddDrape(const Anthropometry& body, const Costume& costume, TubeBuilder& builder) {
  if (costume.drape == Drape::kNone) return;
  const double waist_mm = 0.25 * body.torso_mm;
  const double hem_mm = std::min(costume.drape_end, 1.0) * body.thigh_mm +
                        std::max(costume.drape_end - 1, 0.0) * body.shank_mm;
  TubeStyle style = PlainStyle(costume.drape == Drape::kSkirt ? kTrousers : kShirt, 24, 22);
  style.fold = 0.03;
  builder.AddTube(0, 1, style, [&](double s) {
    const double below_hips_mm = s * (waist_mm + hem_mm) - waist_mm;
    Ring ring;
    ring.X_WRing = {Matrix3::Identity(), builder.rest()[kPelvis].p - Vector3(0, 0, below_hips_mm)};
    const double slack_mm =
        8 + costume.torso_slack_mm + costume.drape_flare_mm * Smoothstep(0, hem_mm, below_hips_mm);
    ring.section =
        Loosened(TorsoSection(body, std::max(-below_hips_mm / body.torso_mm, 0.0)), slack_mm);
    ring.weights = DrapeWeights(kLeft, below_hips_mm, body);
    ring.right_weights = DrapeWeights(kRight, below_hips_mm, body);
    return ring;
  });
}

void AddLoads(const Anthropometry& body, const Costume& costume, TubeBuilder& builder) {
  if (costume.backpack_mm > 0) {
    const double half_mm = costume.backpack_mm / 2;
    builder.AddTube(0.9, 0.2, PlainStyle(kLoad, 10, 16), [&](double s) {
      Ring ring;
      ring.X_WRing = {Matrix3::Identity(),
                      builder.rest()[kPelvis].p + Vector3(0, 0, s * body.torso_mm)};
      ring.section =
          Oval(half_mm, half_mm, 0.088 * body.stature_mm, -0.055 * body.stature_mm - half_mm);
      ring.roundness = 5;
      ring.weights[kThorax] = 1;
      return ring;
    });
  }
  if (costume.has_bag) {
    builder.AddTube(0, 1, PlainStyle(kLoad, 8, 16), [&](double s) {
      Ring ring;
      ring.X_WRing = builder.rest()[kHandR] *
                     RigidTransform{Matrix3::Identity(), {0, 0, -0.8 * body.hand_mm - 260 * s}};
      ring.section = Oval(140, 140, 50);
      ring.roundness = 5;
      ring.weights[kHandR] = 1;
      return ring;
    });
  }
}

// Forearm crutches: shafts that are held and reach the floor below hanging arms.
void AddCrutches(const Anthropometry& body, TubeBuilder& builder) {
  constexpr double kShaft_mm = 12, kCuff_mm = 45;
  const double grip_mm = 0.5 * body.hand_mm;
  const double wrist_mm =
      body.hip_height_mm() + body.shoulder_mm - body.upper_arm_mm - body.forearm_mm;
  for (const int side : {kLeft, kRight}) {
    const auto add = [&](double top_mm, double bottom_mm, double radius_mm) {
      builder.AddTube(top_mm, bottom_mm, PlainStyle(kLoad, 6, 8), [&](double z_mm) {
        Ring ring;
        ring.X_WRing =
            builder.rest()[kHandL + side] * RigidTransform{Matrix3::Identity(), {0, 0, z_mm}};
        ring.section = Oval(radius_mm, radius_mm, radius_mm);
        ring.weights[kHandL + side] = 1;
        return ring;
      });
    };
    add(-grip_mm, -wrist_mm, kShaft_mm);
    add(0.8 * body.forearm_mm, 0.65 * body.forearm_mm, kCuff_mm);
  }
}

// Crutches are fixed to the hands: where these are near the floor, they would be in it.
bool KeepsHandsUp(std::string_view motion) {
  return motion == "walk" || motion == "stand" || motion == "gesture" || motion == "visit";
}

}  // namespace

Costume PlainCostume(std::string_view motion) { return {.has_wheelchair = motion == "roll"}; }

Costume MakeCostume(std::uint64_t seed, std::string_view motion) {
  Random random(Mix(seed, Tag("costume")));
  const auto one_in = [&random](double count) { return random.Uniform(0, 1) * count < 1; };
  Costume costume;
  costume.hair = static_cast<Hair>(random.Bits() % 6);
  switch (costume.hair) {
    case Hair::kAfro:
      costume.hair_mm = random.Uniform(20, 90);
      break;
    case Hair::kBunches:
      costume.hair_mm = random.Uniform(40, 80);
      break;
    default:
      costume.hair_mm = random.Uniform(200, 520);
  }
  if (one_in(3)) costume.hat = one_in(2) ? Hat::kHelmet : Hat::kBrim;
  if (one_in(2.5)) {
    costume.drape = static_cast<Drape>(1 + random.Bits() % 3);
    costume.drape_end = random.Uniform(0.6, 1.85);
    costume.drape_flare_mm = random.Uniform(10, 120);
    if (costume.drape != Drape::kSkirt) {
      costume.torso_slack_mm = random.Uniform(5, 30);
      costume.sleeve_slack_mm = random.Uniform(5, 50);
    }
  } else if (one_in(3)) {
    costume.torso_slack_mm = random.Uniform(5, 25);
    costume.sleeve_slack_mm = random.Uniform(20, 60);
  }
  if (one_in(5)) costume.backpack_mm = random.Uniform(110, 240);
  costume.has_bag = one_in(7);
  costume.has_crutches = one_in(8) && KeepsHandsUp(motion);
  costume.has_wheelchair = PlainCostume(motion).has_wheelchair;
  return costume;
}

std::string Describe(const Costume& costume) {
  constexpr std::array kHairNames = {"", "bald", "afro", "long hair", "bunches", "ponytail"};
  constexpr std::array kHatNames = {"", "helmet", "hat"};
  constexpr std::array kDrapeNames = {"", "skirt", "coat", "gown"};
  const bool is_wide = costume.drape == Drape::kNone && costume.sleeve_slack_mm > 0;
  std::string text;
  for (const char* part :
       {kHairNames[static_cast<std::size_t>(costume.hair)],
        kHatNames[static_cast<std::size_t>(costume.hat)],
        kDrapeNames[static_cast<std::size_t>(costume.drape)], is_wide ? "wide sleeves" : "",
        costume.backpack_mm > 0 ? "backpack" : "", costume.has_bag ? "bag" : "",
        costume.has_crutches ? "crutches" : "", costume.has_wheelchair ? "wheelchair" : ""}) {
    if (*part == '\0') continue;
    if (!text.empty()) text += ", ";
    text += part;
  }
  return text.empty() ? "plain" : text;
}

void VaryBuild(std::uint64_t seed, Anthropometry& body) {
  Random random(Mix(seed, Tag("varied build")));
  body.shoulder_half_mm *= random.Uniform(0.9, 1.15);
  if (random.Uniform(0, 1) < 0.2) body.girth = random.Uniform(1.2, 2.2);
}

void AddCostume(const Anthropometry& body, const Costume& costume, TubeBuilder& builder) {
  AddHair(body, costume, builder);
  AddHat(body, costume.hat, builder);
  AddDrape(body, costume, builder);
  AddLoads(body, costume, builder);
  if (costume.has_crutches) AddCrutches(body, builder);
  if (costume.has_wheelchair) AddWheelchair(body, builder);
}

}  // namespace mocap::simulation
