#include "core/body/recognition.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace mocap {
namespace {

const KnownPerson kAnna{"anna", AverageSizes(1680)};
const KnownPerson kBertil{"bertil", AverageSizes(1830)};

TEST(WhoIs, FindsWhoHasTheSizes) {
  const std::array known = {kAnna, kBertil};
  for (const KnownPerson& person : known) {
    const Likeness likeness = WhoIs(AverageSizes(person.sizes.Stature() * 1.005), known);
    ASSERT_NE(likeness.person, nullptr);
    EXPECT_EQ(likeness.person->name, person.name);
    EXPECT_GE(likeness.certainty, kSureOfName);
  }
}

TEST(WhoIs, OthersWhoAreUnlikeTakeNothingAway) {
  std::vector<KnownPerson> known = {kAnna};
  const double alone = WhoIs(kAnna.sizes, known).certainty;
  for (const double stature_mm : {1380.0, 1480.0, 1580.0, 1780.0, 1880.0, 1980.0})
    known.push_back({"somebody", AverageSizes(stature_mm)});
  const Likeness likeness = WhoIs(kAnna.sizes, known);
  EXPECT_EQ(likeness.person, known.data());
  EXPECT_NEAR(likeness.certainty, alone, 0.01);
}

TEST(WhoIs, ClothesDoNotMatter) {
  KnownPerson in_a_coat = kAnna;
  for (const SizeMember width : kStoutWidths) in_a_coat.sizes.*width *= 1.4;
  const std::array known = {kAnna};
  EXPECT_EQ(WhoIs(in_a_coat.sizes, known).certainty, WhoIs(kAnna.sizes, known).certainty);
}

TEST(WhoIs, SomebodyElseIsNobodyWhoIsKnown) {
  const std::array known = {kAnna, kBertil};
  for (const double stature_mm : {1450.0, 1755.0, 1990.0})
    EXPECT_EQ(WhoIs(AverageSizes(stature_mm), known).person, nullptr) << stature_mm;
  EXPECT_GE(WhoIs(AverageSizes(1450), known).certainty, kSureOfName);
}

TEST(WhoIs, LongLegsTellFromALongTorso) {
  KnownPerson long_torso = kAnna;
  long_torso.sizes.torso *= 1.08;
  long_torso.sizes.thigh -= long_torso.sizes.Stature() - kAnna.sizes.Stature();
  ASSERT_NEAR(long_torso.sizes.Stature(), kAnna.sizes.Stature(), 1e-6);
  const std::array known = {long_torso, kAnna};
  const Likeness likeness = WhoIs(kAnna.sizes, known);
  ASSERT_NE(likeness.person, nullptr);
  EXPECT_EQ(likeness.person->name, "anna");
  EXPECT_GE(likeness.certainty, kSureOfName);
}

TEST(WhoIs, DoubtsBetweenPeopleWhoAreAlike) {
  const std::array known = {kAnna, KnownPerson{"agda", AverageSizes(1685)}};
  EXPECT_LT(WhoIs(kAnna.sizes, known).certainty, kSureOfName);
}

TEST(WhoIs, WithoutAnybodyKnownItIsNobody) {
  EXPECT_EQ(WhoIs(kAnna.sizes, {}).person, nullptr);
  EXPECT_EQ(WhoIs(kAnna.sizes, {}).certainty, 1);
}

}  // namespace
}  // namespace mocap
