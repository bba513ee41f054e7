#include "core/reconstruction/carving/carver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <set>
#include <tuple>

#include "core/reconstruction/carving/volume_of_interest.h"
#include "core/reconstruction/silhouette/bit_filters.h"
#include "tests/core/reconstruction/synthetic_studio.h"

namespace mocap {
namespace {

using Voxels = std::set<std::tuple<int, int, int>>;

// Counted from the world's origin.
Voxels VoxelsOf(const VoxelGrid& grid) {
  Voxels voxels;
  for (int k = 0; k < grid.size().z(); ++k)
    for (int j = 0; j < grid.size().y(); ++j)
      for (int i = 0; i < grid.size().x(); ++i)
        if (grid.Test(i, j, k))
          voxels.emplace(grid.first_voxel().x() + i, grid.first_voxel().y() + j,
                         grid.first_voxel().z() + k);
  return voxels;
}

// What the header says, word by word; `views` are those with something in their silhouettes.
bool AgreesPlainly(const std::vector<CarvingView>& views, std::size_t all, const Vector3& p_W) {
  std::size_t persons = 0, unknown = 0, outweighing = 0;
  for (const CarvingView& view : views) {
    const Vector3 p_C = view.X_CW * p_W;
    if (p_C.z() <= 0) continue;
    const SensorPlaneTable::Pixel pixel = view.table->Lookup(p_C.x() / p_C.z(), p_C.y() / p_C.z());
    if (pixel.x < 0) continue;
    if (view.silhouette->Test(pixel.x, pixel.y))
      ++persons;
    else if (view.unknown->Test(pixel.x, pixel.y))
      ++unknown;
    else
      outweighing += static_cast<std::size_t>(view.outweighed_by);
  }
  const std::size_t seeing = persons + unknown;
  return seeing >= 2 && 2 * seeing >= all && persons >= unknown + outweighing;
}

Voxels CarvePlainly(std::span<const CarvingView> views, double voxel_mm) {
  Voxels voxels;
  const std::optional<Eigen::AlignedBox3d> volume = VolumeOfInterest().Find(views);
  if (!volume) return voxels;
  std::vector<CarvingView> seeing;
  for (const CarvingView& view : views)
    if (view.silhouette->BoundingBox()) seeing.push_back(view);
  const Eigen::Vector3i first = (volume->min() / voxel_mm).array().floor().cast<int>();
  const Eigen::Vector3i end = (volume->max() / voxel_mm).array().ceil().cast<int>();
  for (int k = first.z(); k < end.z(); ++k) {
    for (int j = first.y(); j < end.y(); ++j) {
      for (int i = first.x(); i < end.x(); ++i) {
        int agreeing = 0;
        for (const double z : {0.25, 0.75})
          for (const double y : {0.25, 0.75})
            for (const double x : {0.25, 0.75})
              agreeing +=
                  AgreesPlainly(seeing, views.size(), Vector3(i + x, j + y, k + z) * voxel_mm);
        if (agreeing > 4) voxels.emplace(i, j, k);
      }
    }
  }
  return voxels;
}

Voxels Carve(std::span<const CarvingView> views, double voxel_mm, bool several_people = false) {
  VoxelGrid grid;
  Carver({.voxel_mm = voxel_mm, .several_people = several_people}).Carve(views, grid);
  return VoxelsOf(grid);
}

// Makes random pixels unknown.
void DoubtPixels(int count, std::mt19937& random, SyntheticStudio& studio, std::size_t camera) {
  Silhouette& person = studio.silhouettes[camera];
  for (int i = 0; i < count; ++i) {
    const auto x = static_cast<int>(random() % static_cast<unsigned>(person.width()));
    const auto y = static_cast<int>(random() % static_cast<unsigned>(person.height()));
    person.row(y)[x >> 6] &= ~(std::uint64_t{1} << (x & 63));
    studio.unknown[camera].Set(x, y);
  }
}

Vector3 CenterOf(const std::tuple<int, int, int>& voxel, double voxel_mm) {
  const auto [i, j, k] = voxel;
  return Vector3(i + 0.5, j + 0.5, k + 0.5) * voxel_mm;
}

TEST(Carver, CarvesASphereWhereItIs) {
  SyntheticStudio studio;
  const Vector3 middle_W(310, -220, 1010);
  const double radius_mm = 200;
  studio.Show({{middle_W, middle_W, radius_mm}});
  const Voxels voxels = Carve(studio.Views(), 25);
  Vector3 sum = Vector3::Zero();
  for (const auto& voxel : voxels) {
    const Vector3 center = CenterOf(voxel, 25);
    sum += center;
    // Six cones meet in a body that sticks out of the sphere, but not by far.
    EXPECT_LT((center - middle_W).norm(), 1.4 * radius_mm);
  }
  EXPECT_LT((sum / static_cast<double>(voxels.size()) - middle_W).norm(), 15);
  // Nothing of the sphere is missing but what half a pixel of 13 mm takes.
  const int reach = static_cast<int>(radius_mm / 25) + 1;
  for (int k = -reach; k <= reach; ++k)
    for (int j = -reach; j <= reach; ++j)
      for (int i = -reach; i <= reach; ++i) {
        const auto voxel = std::make_tuple(12 + i, -9 + j, 40 + k);
        if ((CenterOf(voxel, 25) - middle_W).norm() < radius_mm - 25) {
          EXPECT_TRUE(voxels.count(voxel)) << i << " " << j << " " << k;
        }
      }
}

TEST(Carver, GivesTheSameAsThePlainDefinitionAtAnyVoxelSize) {
  SyntheticStudio studio;
  studio.Show(StandingPerson(420, -310));
  for (const double voxel_mm : {100.0, 50.0, 33.3, 25.0, 17.0}) {
    SCOPED_TRACE(voxel_mm);
    const Voxels plain = CarvePlainly(studio.Views(), voxel_mm);
    EXPECT_GT(plain.size(), 20u);
    EXPECT_TRUE(Carve(studio.Views(), voxel_mm) == plain);
  }
}

TEST(Carver, GivesTheSameAsThePlainDefinitionWithNoisySilhouettes) {
  SyntheticStudio studio;
  studio.Show(StandingPerson(-200, 150));
  std::mt19937 random(3);
  for (std::size_t c = 0; c < studio.cameras.size(); ++c) {
    for (int i = 0; i < 300; ++i)
      studio.silhouettes[c].Set(static_cast<int>(random() % 320), static_cast<int>(random() % 240));
    DoubtPixels(20000, random, studio, c);
  }
  EXPECT_TRUE(Carve(studio.Views(), 50) == CarvePlainly(studio.Views(), 50));
}

TEST(Carver, GivesTheSameAsThePlainDefinitionWithUpTo64Cameras) {
  for (const int cameras : {33, 63, 64}) {
    SCOPED_TRACE(cameras);
    SyntheticStudio studio(cameras);
    studio.Show(
        {{{420, -310, 300}, {420, -310, 1500}, 180}, {{420, -310, 1400}, {900, -310, 1500}, 60}});
    std::mt19937 random(3);
    for (std::size_t c = 0; c < studio.cameras.size(); ++c) DoubtPixels(20000, random, studio, c);
    const Voxels all = Carve(studio.Views(), 50);
    EXPECT_GT(all.size(), 200u);
    EXPECT_TRUE(all == CarvePlainly(studio.Views(), 50));
    // The last camera counts as well: what it does not see of the top is gone.
    Silhouette& last = studio.silhouettes.back();
    const int top = last.BoundingBox()->top;
    for (int y = top; y < top + 20; ++y) {
      std::fill_n(last.row(y), last.words_per_row(), 0);
      std::fill_n(studio.unknown.back().row(y), last.words_per_row(), 0);
    }
    const Voxels fewer = Carve(studio.Views(), 50);
    EXPECT_LT(fewer.size(), all.size());
    EXPECT_TRUE(fewer == CarvePlainly(studio.Views(), 50));
  }
}

TEST(Carver, GivesTheSameAsThePlainDefinitionWhereThePersonLeavesPictures) {
  SyntheticStudio studio;
  studio.cameras[1].X_CW = LookAt({100, -2900, 2000}, {1500, 0, 1500});
  studio.cameras[4].X_CW = LookAt({-150, 700, 1600}, {0, 0, 1300});
  studio.Show(StandingPerson(0, 0));
  const Voxels plain = CarvePlainly(studio.Views(), 40);
  EXPECT_GT(plain.size(), 500u);
  EXPECT_TRUE(Carve(studio.Views(), 40) == plain);
}

TEST(Carver, GivesTheSameAsThePlainDefinitionWithFourCamerasAndWithOneCloseBy) {
  SyntheticStudio studio;
  studio.cameras[1].X_CW = LookAt({-250, -500, 1900}, {0, 0, 800});
  studio.Show(StandingPerson(0, 0));
  std::vector<CarvingView> views = studio.Views();
  const Voxels six = CarvePlainly(views, 40);
  EXPECT_GT(six.size(), 500u);
  EXPECT_TRUE(Carve(views, 40) == six);
  views.resize(4);
  const Voxels four = CarvePlainly(views, 40);
  EXPECT_GT(four.size(), 500u);
  EXPECT_TRUE(Carve(views, 40) == four);
}

TEST(Carver, AFootOutsideOnePictureDoesNotVanish) {
  SyntheticStudio studio;
  // Sees the person down to the knees.
  studio.cameras[1].X_CW = LookAt({100, -2900, 2000}, {0, 0, 2100});
  studio.Show(StandingPerson(0, 0));
  ASSERT_EQ(studio.silhouettes[1].BoundingBox()->bottom, 239);
  const Voxels voxels = Carve(studio.Views(), 25);
  int at_foot = 0;
  for (const auto& voxel : voxels)
    at_foot += (CenterOf(voxel, 25) - Vector3(110, 30, 70)).norm() < 65;
  // Of a ball of 65 mm radius, 73 voxels.
  EXPECT_GT(at_foot, 55);
}

TEST(Carver, WhereSeveralMayBeNothingOfThePersonIsOtherwise) {
  SyntheticStudio studio;
  studio.Show(StandingPerson(420, -310));
  const Voxels one = Carve(studio.Views(), 40), any = Carve(studio.Views(), 40, true);
  EXPECT_GT(one.size(), 500u);
  EXPECT_TRUE(std::ranges::includes(any, one));
}

TEST(Carver, SomebodyBesideAPictureIsCarvedWhileItShowsSomebodyElse) {
  SyntheticStudio studio;
  studio.cameras[1].X_CW = LookAt({-1200, -2900, 2000}, {-1500, 0, 900});
  std::vector<DrawnCapsule> both = StandingPerson(-1500, 0);
  studio.Show(both);
  const PixelBox shown = studio.silhouettes[1].BoundingBox().value();
  for (const DrawnCapsule& part : StandingPerson(1700, 300)) both.push_back(part);
  studio.Show(both);
  ASSERT_EQ(studio.silhouettes[1].BoundingBox()->right, shown.right);
  ASSERT_LT(shown.right, 319);
  const auto beside = [&](bool several_people) {
    const Voxels voxels = Carve(studio.Views(), 50, several_people);
    return std::ranges::count_if(voxels,
                                 [](const auto& voxel) { return CenterOf(voxel, 50).x() > 1000; });
  };
  EXPECT_GT(beside(true), 200);
  EXPECT_EQ(beside(false), 0);
}

TEST(Carver, WhatOnlyOneCameraSeesIsNotMadeUp) {
  SyntheticStudio studio;
  // All but the first look away from the person, at one another.
  studio.Show(StandingPerson(0, 0));
  std::vector<CarvingView> views = studio.Views();
  for (std::size_t c = 1; c < views.size(); ++c)
    views[c].X_CW =
        LookAt(studio.cameras[c].X_CW.Inverse().p, 3 * studio.cameras[c].X_CW.Inverse().p);
  EXPECT_TRUE(Carve(views, 50).empty());
}

TEST(Carver, ACameraThatSeesNothingCarvesNothing) {
  SyntheticStudio studio;
  studio.Show(StandingPerson(0, 0));
  const Voxels all = Carve(studio.Views(), 50);
  studio.silhouettes[2].Reset(320, 240);
  const Voxels five = Carve(studio.Views(), 50);
  EXPECT_TRUE(std::includes(five.begin(), five.end(), all.begin(), all.end()));
  EXPECT_LT(five.size(), 2 * all.size());
}

// A camera knows nothing of the person but the head.
void DoubtBody(std::size_t camera, SyntheticStudio& studio) {
  Silhouette& person = studio.silhouettes[camera];
  studio.unknown[camera] = person;
  const PixelBox box = person.BoundingBox().value();
  const int neck = box.top + (box.bottom - box.top) / 8;
  for (int y = neck; y < person.height(); ++y)
    std::fill_n(person.row(y), person.words_per_row(), 0);
  Subtract(person, studio.unknown[camera]);
}

TEST(Carver, UnknownPixelsDenyNobodyThatAsManyCamerasShow) {
  SyntheticStudio studio(8);
  studio.Show(StandingPerson(0, 0));
  const Voxels all = Carve(studio.Views(), 50);
  for (std::size_t doubting = 0; doubting < 8; ++doubting) {
    SCOPED_TRACE(doubting);
    const Voxels voxels = Carve(studio.Views(), 50);
    if (doubting <= 4)
      EXPECT_TRUE(std::ranges::includes(voxels, all));
    else
      EXPECT_LT(voxels.size(), all.size() / 4);
    DoubtBody(doubting, studio);
  }
}

TEST(Carver, WhatOnlyUnknownPixelsKeepOutIsDoubtful) {
  SyntheticStudio studio(8);
  studio.Show(StandingPerson(0, 0));
  const Voxels all = Carve(studio.Views(), 50);
  for (std::size_t camera = 0; camera < 5; ++camera) DoubtBody(camera, studio);
  VoxelGrid grid;
  std::vector<Eigen::Vector3i> doubtful;
  Carver({.voxel_mm = 50}).Carve(studio.Views(), grid, &doubtful);
  Voxels possible = VoxelsOf(grid);
  const std::size_t sure = possible.size();
  for (const Eigen::Vector3i& cell : doubtful) {
    const Eigen::Vector3i at = grid.first_voxel() + cell;
    possible.emplace(at.x(), at.y(), at.z());
  }
  EXPECT_EQ(possible.size(), sure + doubtful.size());
  EXPECT_TRUE(std::ranges::includes(possible, all));
  // What one camera calls empty is not even doubtful.
  studio.unknown[0].Reset(320, 240);
  Carver({.voxel_mm = 50}).Carve(studio.Views(), grid, &doubtful);
  EXPECT_LT(doubtful.size(), 0.1 * static_cast<double>(all.size()));
}

TEST(Carver, GivesTheSameAsThePlainDefinitionWhereCamerasAreOutweighed) {
  SyntheticStudio studio(16);
  studio.Show(StandingPerson(-200, 150));
  std::mt19937 random(3);
  for (std::size_t c = 0; c < 16; ++c) DoubtPixels(20000, random, studio, c);
  for (const std::size_t c : {2u, 3u, 9u}) EraseLegs(studio.silhouettes[c]);
  std::vector<CarvingView> views = studio.Views();
  const std::size_t cut = Carve(views, 40).size();
  for (const int outweighed_by : {3, 4, 7, 13, 14}) {
    SCOPED_TRACE(outweighed_by);
    for (CarvingView& view : views) view.outweighed_by = outweighed_by;
    views[3].outweighed_by = 3;
    const Voxels voxels = Carve(views, 40);
    EXPECT_TRUE(voxels == CarvePlainly(views, 40));
    EXPECT_GE(voxels.size(), cut);
  }
}

TEST(Carver, WhatOneCameraMissesStaysIfEnoughOthersShowIt) {
  SyntheticStudio studio(8);
  studio.Show(StandingPerson(0, 0));
  const Voxels all = Carve(studio.Views(), 50);
  EraseLegs(studio.silhouettes[2]);
  std::vector<CarvingView> views = studio.Views();
  views[2].outweighed_by = 7;
  EXPECT_TRUE(std::ranges::includes(Carve(views, 50), all));
  views[2].outweighed_by = 8;
  EXPECT_LT(Carve(views, 50).size(), 0.8 * static_cast<double>(all.size()));
}

TEST(Carver, UnknownPixelsCarveHardSilhouettes) {
  SyntheticStudio studio(8);
  studio.Show(StandingPerson(0, 0));
  DoubtBody(0, studio);
  VoxelGrid grid;
  Carver({.voxel_mm = 50, .hard_silhouettes = true}).Carve(studio.Views(), grid);
  studio.unknown[0].Reset(320, 240);
  EXPECT_TRUE(VoxelsOf(grid) == Carve(studio.Views(), 50));
}

TEST(Carver, AnEmptyRoomGivesNoVoxels) {
  SyntheticStudio studio;
  studio.Show({});
  EXPECT_TRUE(Carve(studio.Views(), 25).empty());
  EXPECT_TRUE(Carve({}, 25).empty());
  // Half of the cameras must see something: two of six blobs may meet by chance.
  studio.Show(StandingPerson(0, 0));
  for (const int c : {0, 1, 3, 5}) studio.silhouettes[c].Reset(320, 240);
  EXPECT_TRUE(Carve(studio.Views(), 25).empty());
}

TEST(Carver, TheOrderOfTheCamerasDoesNotMatter) {
  SyntheticStudio studio;
  studio.Show(StandingPerson(100, 500));
  std::vector<CarvingView> views = studio.Views();
  const Voxels voxels = Carve(views, 25);
  std::reverse(views.begin(), views.end());
  EXPECT_TRUE(Carve(views, 25) == voxels);
}

TEST(Carver, AUsedCarverAndAUsedGridGiveTheSameAsNewOnes) {
  SyntheticStudio studio;
  Carver carver(CarvingOptions{25});
  VoxelGrid grid;
  studio.Show(StandingPerson(300, -400));
  carver.Carve(studio.Views(), grid);
  studio.Show(StandingPerson(-500, 200));
  carver.Carve(studio.Views(), grid);
  EXPECT_TRUE(VoxelsOf(grid) == Carve(studio.Views(), 25));
}

TEST(Carver, FollowsAPersonAnywhereInTheRoom) {
  SyntheticStudio studio;
  for (const Vector2& at : {Vector2(1300, 0), Vector2(-900, 1100), Vector2(0, -1200)}) {
    studio.Show(StandingPerson(at.x(), at.y()));
    Vector3 sum = Vector3::Zero();
    const Voxels voxels = Carve(studio.Views(), 50);
    ASSERT_GT(voxels.size(), 300u);
    for (const auto& voxel : voxels) sum += CenterOf(voxel, 50);
    const Vector3 middle = sum / static_cast<double>(voxels.size());
    EXPECT_LT((middle.head<2>() - at).norm(), 60);
  }
}

}  // namespace
}  // namespace mocap
