#include "daemon/service/disk_watch.h"

#include <gtest/gtest.h>

#include <latch>
#include <thread>

#include "drivers/clock.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

constexpr std::int64_t kForever = 600'000'000'000;

TEST(DiskWatch, FindsRoomAndWritesFigures) {
  const testing::TemporaryFolder folder;
  DiskWatch watch;
  EXPECT_FALSE(watch.Findings());
  watch.Send({.takes = folder.path() / "takes",
              .background = folder.path(),
              .cut_off = {{folder.path() / "gone.partial", 1, 1}, {folder.path(), 1, 1}},
              .metrics = folder.path() / "m.prom",
              .metrics_text = "x 1\n"});
  watch.WaitForFindings(kForever);
  const DiskFindings found = watch.Findings().value();
  EXPECT_GT(found.bytes_free, 0);
  EXPECT_EQ(found.takes_problem, "");
  EXPECT_EQ(found.takes_place, folder.path()) << "the nearest folder that exists";
  EXPECT_GT(found.background_made_s, 0);
  ASSERT_EQ(found.cut_off.size(), 1u) << "what was taken away is forgotten";
  EXPECT_EQ(found.cut_off[0].folder, folder.path());
  EXPECT_TRUE(found.could_write_metrics);
  EXPECT_EQ(testing::ReadText(folder.path() / "m.prom"), "x 1\n");
}

TEST(DiskWatch, TheFolderThatCannotBeWrittenIsNamedUnlessItIsThatForTakes) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "file";  // Not even root may enter it.
  testing::WriteText(file, "");
  const auto problem_of = [](const std::filesystem::path& takes) {
    return RunErrand(
               {.takes = takes, .background = {}, .cut_off = {}, .metrics = {}, .metrics_text = {}})
        .takes_problem;
  };
  EXPECT_EQ(problem_of(file), "Permission denied");
  EXPECT_EQ(problem_of(file / "takes"), file.string() + ": Permission denied");
}

TEST(DiskWatch, FiguresThatCannotBeWrittenAreToldUntilTheyAre) {
  const testing::TemporaryFolder folder;
  std::latch first(1), second(1);
  int runs = 0;
  DiskWatch watch([&](const DiskErrand& errand) {
    DiskFindings found = RunErrand(errand);
    (++runs == 1 ? first : second).count_down();
    return found;
  });
  watch.Send({.takes = folder.path(),
              .background = {},
              .cut_off = {},
              .metrics = folder.path() / "nowhere" / "m.prom",
              .metrics_text = "x"});
  watch.WaitForFindings(kForever);
  first.wait();
  EXPECT_FALSE(watch.Findings()->could_write_metrics);
  watch.Send(
      {.takes = folder.path(), .background = {}, .cut_off = {}, .metrics = {}, .metrics_text = {}});
  second.wait();
  while (watch.UnderWayNs(SteadyNs()) != 0) std::this_thread::yield();
  EXPECT_FALSE(watch.Findings()->could_write_metrics) << "nothing new was tried";
}

TEST(DiskWatch, ADiskThatStallsHoldsUpNobody) {
  const auto begun = std::make_shared<std::latch>(1);
  const auto may_end = std::make_shared<std::latch>(1);
  {
    DiskWatch watch([begun, may_end](const DiskErrand&) {
      begun->count_down();
      may_end->wait();
      return DiskFindings{};
    });
    watch.Send({});
    begun->wait();
    watch.Send({});
    EXPECT_GE(watch.UnderWayNs(SteadyNs() + 7'000'000'000), 7'000'000'000);
    EXPECT_FALSE(watch.Findings());
  }
  may_end->count_down();
}

}  // namespace
}  // namespace mocap
