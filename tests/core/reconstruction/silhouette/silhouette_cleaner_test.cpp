#include "core/reconstruction/silhouette/silhouette_cleaner.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace mocap {
namespace {

Silhouette FromRows(const std::vector<std::string>& rows) {
  Silhouette s(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()));
  for (int y = 0; y < s.height(); ++y)
    for (int x = 0; x < s.width(); ++x)
      if (rows[y][x] == '#') s.Set(x, y);
  return s;
}

std::vector<std::string> ToRows(const Silhouette& s) {
  std::vector<std::string> rows;
  for (int y = 0; y < s.height(); ++y) {
    rows.emplace_back();
    for (int x = 0; x < s.width(); ++x) rows.back() += s.Test(x, y) ? '#' : '.';
  }
  return rows;
}

TEST(SilhouetteCleaner, DropsBlobsBelowTheSizeAndKeepsThinArms) {
  Silhouette s = FromRows({"##.......",  //
                           "##....#..",  //
                           ".....#...",  //
                           "....#....",  //
                           "...#.....",  //
                           "..#......"});
  SilhouetteCleaner().DropBlobs(5, s);
  EXPECT_EQ(ToRows(s), (std::vector<std::string>{".........",  //
                                                 "......#..",  //
                                                 ".....#...",  //
                                                 "....#....",  //
                                                 "...#.....",  //
                                                 "..#......"}));
}

TEST(SilhouetteCleaner, JoinsBranchesThatMeetOnlyFurtherDown) {
  Silhouette s = FromRows({"#...#...#",  //
                           "#...#...#",  //
                           "#########"});
  const std::vector<std::string> before = ToRows(s);
  SilhouetteCleaner().DropBlobs(15, s);
  EXPECT_EQ(ToRows(s), before);
  SilhouetteCleaner().DropBlobs(16, s);
  EXPECT_FALSE(s.BoundingBox().has_value());
}

TEST(SilhouetteCleaner, FillsSmallHolesAndLeavesGapsThatLeadOut) {
  Silhouette s = FromRows({".########",  //
                           ".#.##...#",  //
                           ".####...#",  //
                           ".##.#####",  //
                           ".#..#.###"});
  SilhouetteCleaner().FillHoles(4, s);
  EXPECT_EQ(ToRows(s), (std::vector<std::string>{".########",  //
                                                 ".####...#",  //
                                                 ".####...#",  //
                                                 ".##.#####",  //
                                                 ".#..#.###"}));
}

TEST(SilhouetteCleaner, HolesDoNotLeakThroughDiagonalNeighbours) {
  Silhouette s = FromRows({"####",  //
                           "#.##",  //
                           "##.#",  //
                           "###."});
  SilhouetteCleaner().FillHoles(2, s);
  EXPECT_EQ(ToRows(s), (std::vector<std::string>{"####", "####", "####", "###."}));
}

TEST(SilhouetteCleaner, FillsLargeHolesOnlyWhereTheyAreDoubtful) {
  const std::vector<std::string> rows = {"#########",  //
                                         "#...#...#",  //
                                         "#...#...#",  //
                                         "#########"};
  const Silhouette doubtful = FromRows({".........",  //
                                        ".###.....",  //
                                        ".#.#.##..",  //
                                        "........."});
  Silhouette s = FromRows(rows);
  SilhouetteCleaner().FillHoles(2, doubtful, s);
  EXPECT_EQ(ToRows(s), (std::vector<std::string>{"#########",  //
                                                 "#####...#",  //
                                                 "#####...#",  //
                                                 "#########"}));
}

TEST(SilhouetteCleaner, WorksAcrossWords) {
  Silhouette s(200, 9);
  for (int y = 1; y < 8; ++y)
    for (int x = 10; x < 190; ++x)
      if (y != 4 || x < 50 || x > 140) s.Set(x, y);
  SilhouetteCleaner cleaner;
  cleaner.FillHoles(91, s);
  EXPECT_FALSE(s.Test(100, 4));
  cleaner.FillHoles(92, s);
  EXPECT_TRUE(s.Test(50, 4) && s.Test(64, 4) && s.Test(127, 4) && s.Test(140, 4));
  cleaner.DropBlobs(180 * 7 + 1, s);
  EXPECT_FALSE(s.BoundingBox().has_value());
}

// A person of 20 x 40 pixels, and something else.
Silhouette PersonAnd(const PixelBox& other) {
  Silhouette s(200, 100);
  for (int y = 30; y < 70; ++y)
    for (int x = 50; x < 70; ++x) s.Set(x, y);
  for (int y = other.top; y <= other.bottom; ++y)
    for (int x = other.left; x <= other.right; ++x) s.Set(x, y);
  return s;
}

TEST(SilhouetteCleaner, WhatLiesApartFromThePersonIsLeftOut) {
  Silhouette s = PersonAnd({150, 20, 160, 40});
  SilhouetteCleaner().KeepPerson(5, 1000, s);
  EXPECT_EQ(*s.BoundingBox(), (PixelBox{50, 30, 69, 69}));
}

TEST(SilhouetteCleaner, AHandCutOffStaysWithThePerson) {
  const PixelBox hand{76, 30, 79, 33};
  Silhouette s = PersonAnd(hand);
  SilhouetteCleaner().KeepPerson(5, 1000, s);
  EXPECT_EQ(s.words(), PersonAnd(hand).words());
  SilhouetteCleaner().KeepPerson(17, 1000, s);
  EXPECT_EQ(*s.BoundingBox(), (PixelBox{50, 30, 69, 69}));
}

TEST(SilhouetteCleaner, NoHalfOfAPersonIsTakenForAThing) {
  const PixelBox other{150, 20, 169, 49};
  Silhouette s = PersonAnd(other);
  SilhouetteCleaner().KeepPerson(5, 1000, s);
  EXPECT_EQ(s.words(), PersonAnd(other).words());
}

TEST(SilhouetteCleaner, WhatIsLargeEnoughMayBeSomebody) {
  const PixelBox other{150, 20, 160, 39};
  Silhouette s = PersonAnd(other);
  SilhouetteCleaner().KeepPerson(5, 11 * 20, s);
  EXPECT_EQ(s.words(), PersonAnd(other).words());
}

TEST(SilhouetteCleaner, NobodyIsNobody) {
  Silhouette s(100, 50);
  SilhouetteCleaner().KeepPerson(5, 1000, s);
  EXPECT_FALSE(s.BoundingBox().has_value());
}

}  // namespace
}  // namespace mocap
