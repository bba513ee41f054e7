#include "core/objective/contact_matcher.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/random_capsules.h"

namespace mocap {
namespace {

constexpr double kReachMm = 150;

double MismatchOf(const Contact& contact, const PosedCapsule& capsule) {
  const PosedCapsule::SegmentDistance distance = capsule.DistanceTo(contact.from_W, contact.to_W);
  const Vector3 offset = distance.segment_W - distance.core_W;
  const double facing = contact.outward_W.dot(offset) / (offset.norm() + 1);
  return std::abs(distance.outside_mm) + 40 * (1 - facing);
}

TEST_F(RandomCapsules, GetTheContactsThatTheyMatchBest) {
  std::vector<PosedCapsule> capsules;
  for (int i = 0; i < 12; ++i) capsules.push_back(Capsule());
  std::vector<Contact> contacts;
  for (int i = 0; i < 203; ++i) {
    const Vector3 from = Place();
    const bool is_edge = i % 3 != 0;
    contacts.push_back({from, is_edge ? Place() : from, Place().normalized(), is_edge});
  }
  ContactMatcher matcher;
  matcher.SetContacts(contacts);
  const std::vector<ContactMatch>& matches = matcher.Match(capsules, kReachMm);
  ASSERT_EQ(matches.size(), contacts.size());
  int matched = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (const PosedCapsule& capsule : capsules) {
      least = std::min(least, MismatchOf(contacts[i], capsule));
    }
    // The search leaves out by how little a taper moves the nearest place.
    constexpr double kByTaperMm = 3;
    if (matches[i].capsule < 0) {
      EXPECT_GT(least, kReachMm - kByTaperMm);
      continue;
    }
    ++matched;
    EXPECT_LT(MismatchOf(contacts[i], capsules[matches[i].capsule]), least + kByTaperMm);
    EXPECT_NEAR(
        matches[i].distance.outside_mm,
        capsules[matches[i].capsule].DistanceTo(contacts[i].from_W, contacts[i].to_W).outside_mm,
        1e-6);
  }
  EXPECT_GT(matched, 100);
}

// Whoever was the best before is tried first; another body may have fewer parts.
TEST_F(RandomCapsules, MatchTheSameWhateverWasMatchedBefore) {
  std::vector<Contact> contacts;
  for (int i = 0; i < 203; ++i) contacts.push_back({Place(), Place(), Place().normalized(), true});
  ContactMatcher used;
  used.SetContacts(contacts);
  for (const int count : {12, 5, 1, ContactMatcher::kMostCapsules}) {
    std::vector<PosedCapsule> capsules;
    for (int i = 0; i < count; ++i) capsules.push_back(Capsule());
    ContactMatcher fresh;
    fresh.SetContacts(contacts);
    const std::vector<ContactMatch>& again = used.Match(capsules, kReachMm);
    const std::vector<ContactMatch>& first = fresh.Match(capsules, kReachMm);
    for (std::size_t i = 0; i < contacts.size(); ++i) EXPECT_EQ(again[i].capsule, first[i].capsule);
  }
}

TEST(ContactMatcher, ChoosesTheSideThatFacesTheContactsWay) {
  const std::vector<PosedCapsule> legs = {{{0, 80, 0}, {0, 80, 400}, 60, 60},
                                          {{0, -80, 0}, {0, -80, 400}, 60, 60}};
  // Between the legs, a little nearer to the right one, but on the left one's inside.
  const Vector3 place(0, -5, 200);
  const std::vector<Contact> contacts = {{place, place, -Vector3::UnitY(), false},
                                         {place, place, Vector3::UnitY(), false}};
  ContactMatcher matcher;
  matcher.SetContacts(contacts);
  EXPECT_EQ(matcher.Match(legs, kReachMm)[0].capsule, 0);
  EXPECT_EQ(matcher.Match(legs, kReachMm)[1].capsule, 1);
  EXPECT_EQ(matcher.Match(legs, 5)[1].capsule, -1);
}

}  // namespace
}  // namespace mocap
