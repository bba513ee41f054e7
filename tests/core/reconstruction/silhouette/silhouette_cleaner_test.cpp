#include "core/reconstruction/silhouette/silhouette_cleaner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>
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

void FillHoles(int smallest, Silhouette& s) {
  SilhouetteCleaner().Clean(smallest, Silhouette(s.width(), s.height()), 0, s);
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
  FillHoles(4, s);
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
  FillHoles(2, s);
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
  SilhouetteCleaner().Clean(2, doubtful, 0, s);
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
  FillHoles(91, s);
  EXPECT_FALSE(s.Test(100, 4));
  FillHoles(92, s);
  EXPECT_TRUE(s.Test(50, 4) && s.Test(64, 4) && s.Test(127, 4) && s.Test(140, 4));
  SilhouetteCleaner().DropBlobs(180 * 7 + 1, s);
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
  SilhouetteCleaner().KeepPerson(0, 5, 1000, s);
  EXPECT_EQ(*s.BoundingBox(), (PixelBox{50, 30, 69, 69}));
}

TEST(SilhouetteCleaner, AHandCutOffStaysWithThePerson) {
  const PixelBox hand{76, 30, 79, 33};
  Silhouette s = PersonAnd(hand);
  SilhouetteCleaner().KeepPerson(0, 5, 1000, s);
  EXPECT_EQ(s.words(), PersonAnd(hand).words());
  SilhouetteCleaner().KeepPerson(0, 17, 1000, s);
  EXPECT_EQ(*s.BoundingBox(), (PixelBox{50, 30, 69, 69}));
}

TEST(SilhouetteCleaner, NoHalfOfAPersonIsTakenForAThing) {
  const PixelBox other{150, 20, 169, 49};
  Silhouette s = PersonAnd(other);
  SilhouetteCleaner().KeepPerson(0, 5, 1000, s);
  EXPECT_EQ(s.words(), PersonAnd(other).words());
}

TEST(SilhouetteCleaner, WhatIsLargeEnoughMayBeSomebody) {
  const PixelBox other{150, 20, 160, 39};
  Silhouette s = PersonAnd(other);
  SilhouetteCleaner().KeepPerson(0, 5, 11 * 20, s);
  EXPECT_EQ(s.words(), PersonAnd(other).words());
}

TEST(SilhouetteCleaner, NobodyIsNobody) {
  Silhouette s(100, 50);
  SilhouetteCleaner().KeepPerson(0, 5, 1000, s);
  EXPECT_FALSE(s.BoundingBox().has_value());
}

// The plain definition: holes first, and then blobs, each flooded from pixel to pixel.
class PlainCleaner {
 public:
  explicit PlainCleaner(const Silhouette& s) : rows_(ToRows(s)) {}

  void FillHoles(int smallest, const Silhouette& doubtful) {
    for (const Patch& hole : PatchesOf('.')) {
      const auto is_doubtful = [&](const Pixel& p) { return doubtful.Test(p.x, p.y); };
      const auto count = std::ranges::count_if(hole, is_doubtful);
      const bool is_small = std::ssize(hole) < smallest;
      if (!ReachesTheEdge(hole) && (is_small || 3 * count > 2 * std::ssize(hole))) Paint(hole, '#');
    }
  }

  void DropBlobs(int smallest) {
    for (const Patch& blob : PatchesOf('#'))
      if (std::ssize(blob) < smallest) Paint(blob, '.');
  }

  void DropThings(int largest_thing) {
    const std::vector<Patch> blobs = PatchesOf('#');
    if (blobs.empty()) return;
    const Patch& person = *std::ranges::max_element(blobs, {}, std::ssize<Patch>);
    const PixelBox a = BoxOf(person);
    const int reach = std::max(a.right - a.left + 1, a.bottom - a.top + 1);
    for (const Patch& blob : blobs) {
      const PixelBox b = BoxOf(blob);
      const int gap =
          std::max({a.left - b.right, b.left - a.right, a.top - b.bottom, b.top - a.bottom});
      const auto area = std::ssize(blob);
      if (area < largest_thing && 2 * area <= std::ssize(person) && 2 * gap > reach)
        Paint(blob, '.');
    }
  }

  const std::vector<std::string>& rows() const { return rows_; }

 private:
  struct Pixel {
    int x, y;
  };
  using Patch = std::vector<Pixel>;

  int width() const { return static_cast<int>(rows_[0].size()); }
  int height() const { return static_cast<int>(rows_.size()); }

  // In the order of their first pixels.
  std::vector<Patch> PatchesOf(char kind) const {
    std::vector<std::string> left = rows_;
    std::vector<Patch> patches;
    for (int y = 0; y < height(); ++y)
      for (int x = 0; x < width(); ++x)
        if (left[y][x] == kind) patches.push_back(Flood({x, y}, kind, left));
    return patches;
  }

  Patch Flood(Pixel from, char kind, std::vector<std::string>& left) const {
    Patch patch{from};
    left[from.y][from.x] = 'x';
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const Pixel p = patch[i];
      for (int v = std::max(p.y - 1, 0); v <= std::min(p.y + 1, height() - 1); ++v) {
        for (int u = std::max(p.x - 1, 0); u <= std::min(p.x + 1, width() - 1); ++u) {
          const bool is_over_corner = u != p.x && v != p.y;
          if (left[v][u] != kind || (is_over_corner && kind == '.')) continue;
          left[v][u] = 'x';
          patch.push_back({u, v});
        }
      }
    }
    return patch;
  }

  static PixelBox BoxOf(const Patch& patch) {
    PixelBox box{patch[0].x, patch[0].y, patch[0].x, patch[0].y};
    for (const auto& [x, y] : patch)
      box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x),
             std::max(box.bottom, y)};
    return box;
  }

  bool ReachesTheEdge(const Patch& patch) const {
    const PixelBox box = BoxOf(patch);
    return box.left == 0 || box.top == 0 || box.right == width() - 1 || box.bottom == height() - 1;
  }

  void Paint(const Patch& patch, char kind) {
    for (const auto& [x, y] : patch) rows_[y][x] = kind;
  }

  std::vector<std::string> rows_;
};

// Rectangles that turn over what they cover make blobs in holes in blobs, and noise more of them.
Silhouette RandomPicture(int width, int height, int rectangles, int noise_percent,
                         std::mt19937& random) {
  const auto below = [&](int limit) {
    return static_cast<int>(random() % static_cast<unsigned>(limit));
  };
  std::vector<std::string> rows(height, std::string(width, '.'));
  const auto turn_over = [&](int x, int y) { rows[y][x] = rows[y][x] == '#' ? '.' : '#'; };
  for (int i = 0; i < rectangles; ++i) {
    const int left = below(width), top = below(height);
    const int right = left + below(width - left), bottom = top + below(height - top);
    for (int y = top; y <= bottom; ++y)
      for (int x = left; x <= right; ++x) turn_over(x, y);
  }
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (below(100) < noise_percent) turn_over(x, y);
  return FromRows(rows);
}

TEST(SilhouetteCleaner, DoesWhatThePlainDefinitionSays) {
  std::mt19937 random(9);
  SilhouetteCleaner cleaner;
  for (const int width : {1, 40, 64, 67, 128, 150}) {
    for (const int rectangles : {0, 1, 8, 30}) {
      for (const int noise_percent : {0, 1, 10, 30, 50, 70}) {
        const int height = 1 + static_cast<int>(random() % 50);
        const auto picture = [&] {
          return RandomPicture(width, height, rectangles, noise_percent, random);
        };
        const Silhouette before = picture(), doubtful = picture();
        SCOPED_TRACE(std::to_string(width) + " " + std::to_string(rectangles) + " " +
                     std::to_string(noise_percent));
        for (const int smallest : {0, 3, 20}) {
          PlainCleaner cleaned(before), person(before), dropped(before);
          Silhouette s = before;
          cleaned.FillHoles(smallest, doubtful);
          cleaned.DropBlobs(2 * smallest);
          cleaner.Clean(smallest, doubtful, 2 * smallest, s);
          EXPECT_EQ(ToRows(s), cleaned.rows());
          s = before;
          person.FillHoles(smallest, Silhouette(width, height));
          person.DropBlobs(5);
          person.DropThings(50);
          cleaner.KeepPerson(smallest, 5, 50, s);
          EXPECT_EQ(ToRows(s), person.rows());
          s = before;
          dropped.DropBlobs(smallest);
          cleaner.DropBlobs(smallest, s);
          EXPECT_EQ(ToRows(s), dropped.rows());
        }
      }
    }
  }
}

}  // namespace
}  // namespace mocap
