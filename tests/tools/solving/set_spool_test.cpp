#include "tools/solving/set_spool.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

RecordedSet SetAt(int i) {
  RecordedSet set;
  set.frame = i;
  set.capture_ns = 1'000'000'000LL * i;
  set.person_box_W = {Vector3(-i, 0, 0), Vector3(100, 200, 300)};
  set.grid.Reset({-3, i, 0}, {70, 2 + i, 3}, 25);
  set.grid.Set(65, 1, 2);
  set.grid.Set(i, 0, 0);
  set.doubtful = {{1, 2, 0}, {i, 0, 1}};
  set.outlines.resize(3);
  for (int ray = 0; ray < i; ++ray)
    set.outlines[1].push_back({Vector3(1.5, -2000.25, 3), Vector3(1, 2, 3).normalized(),
                               Vector3(3, 0, -1).normalized(), static_cast<SpreadRank>(ray),
                               0.001 * i});
  return set;
}

void ExpectEqual(const RecordedSet& a, const RecordedSet& b) {
  EXPECT_EQ(a.frame, b.frame);
  EXPECT_EQ(a.capture_ns, b.capture_ns);
  EXPECT_EQ(a.person_box_W.min(), b.person_box_W.min());
  EXPECT_EQ(a.person_box_W.max(), b.person_box_W.max());
  EXPECT_EQ(a.grid.first_voxel(), b.grid.first_voxel());
  EXPECT_EQ(a.grid.words(), b.grid.words());
  EXPECT_EQ(a.doubtful, b.doubtful);
  ASSERT_EQ(a.outlines.size(), b.outlines.size());
  for (std::size_t i = 0; i < a.outlines.size(); ++i) {
    ASSERT_EQ(a.outlines[i].size(), b.outlines[i].size());
    for (std::size_t k = 0; k < a.outlines[i].size(); ++k) {
      const GrazingRay &ray = a.outlines[i][k], &other = b.outlines[i][k];
      EXPECT_EQ(ray.eye_W, other.eye_W);
      EXPECT_LT((ray.direction_W - other.direction_W).norm(), 1e-6);
      EXPECT_LT((ray.outward_W - other.outward_W).norm(), 1e-6);
      EXPECT_EQ(ray.rank, other.rank);
      EXPECT_EQ(ray.after_s, other.after_s);
    }
  }
}

TEST(SetSpool, GivesSetsBackInAnyOrder) {
  const testing::TemporaryFolder folder;
  SetSpoolWriter writer(folder.path() / "sets");
  for (int i = 0; i < 5; ++i) writer.Add(SetAt(i));
  const SpoolIndex index = writer.Finish();
  SetSpoolReader reader(folder.path() / "sets", index);
  ASSERT_EQ(reader.count(), 5);
  RecordedSet set;
  for (const int i : {4, 0, 3, 3, 1, 2}) {
    reader.Read(i, set);
    ExpectEqual(set, SetAt(i));
    EXPECT_EQ(reader.capture_ns(i), set.capture_ns);
  }
}

TEST(SetSpool, SaysThatAFileWasCutOff) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "sets";
  SetSpoolWriter writer(file);
  for (int i = 0; i < 3; ++i) writer.Add(SetAt(i));
  const SpoolIndex index = writer.Finish();
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 9);
  SetSpoolReader reader(file, index);
  RecordedSet set;
  reader.Read(1, set);
  EXPECT_THROW(reader.Read(2, set), std::runtime_error);
}

}  // namespace
}  // namespace mocap
