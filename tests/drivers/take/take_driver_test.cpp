#include "drivers/take/take_driver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

#include "drivers/take/take_layout.h"
#include "tests/drivers/driver_suite.h"
#include "tests/support/damage_video.h"
#include "tests/support/images.h"
#include "tests/support/small_take.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using std::chrono::milliseconds;
using testing::SamePixels;
using testing::SmallPicture;
using testing::SmallTake;
using testing::TemporaryFolder;

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kStart_ns = 1'700'000'000'000'000'000;

/// Time that passes only while somebody sleeps.
class FakeClock : public ReplayClock {
 public:
  explicit FakeClock(std::int64_t& now_ns) : now_ns_(now_ns) {}
  std::int64_t NowNs() override { return now_ns_; }
  void SleepUntil(std::int64_t time_ns) override { now_ns_ = std::max(now_ns_, time_ns); }

 private:
  std::int64_t& now_ns_;
};

enum class Pace { kFast, kRealtime };

/// A small take on disk, and the replay of its cameras.
class Recording {
 public:
  Recording(Pace pace, bool loop, const SmallTake& take = {},
            std::function<std::int64_t()> begin_ns = nullptr)
      : take_(take) {
    WriteSmallTake(layout_.folder, take_);
    const ReplaySpan span{take_.first_ns, take_.frames * take_.interval_ns};
    std::unique_ptr<ReplayClock> clock;
    if (pace == Pace::kRealtime) clock = std::make_unique<FakeClock>(now_ns);
    replay_ = std::make_shared<Replay>(span, loop, std::move(clock), begin_ns);
  }

  /// @param lead  pictures before the first that counts.
  std::unique_ptr<TakeDriver> Make(int camera, int lead = 0) const {
    const std::string name = "cam" + std::to_string(camera + 1);
    TakeTable table = ReadTakeTable(layout_.Table(name));
    table.rows.erase(table.rows.begin(), table.rows.begin() + lead);
    return std::make_unique<TakeDriver>(VideoReader(layout_.Video(name)), std::move(table), replay_,
                                        static_cast<std::size_t>(lead));
  }

  const SmallTake& take() const { return take_; }
  std::filesystem::path video(int camera) const {
    return layout_.Video("cam" + std::to_string(camera + 1));
  }

  std::int64_t now_ns = kStart_ns;

 private:
  TemporaryFolder folder_;
  SmallTake take_;
  TakeLayout layout_{folder_.path() / "take"};
  std::shared_ptr<Replay> replay_;
};

TEST(TakeDriver, FastGivesEveryFrameWithTheTimesOfTheRecording) {
  Recording recording(Pace::kFast, false, {.heads = true});
  const auto driver = recording.Make(1);
  driver->Start();
  Frame frame;
  for (int i = 0; i < recording.take().frames; ++i) {
    ASSERT_EQ(driver->Grab(frame, milliseconds(0)), GrabStatus::kFrame);
    EXPECT_EQ(frame.capture_ns, recording.take().TimeNs(1, i));
    EXPECT_EQ(frame.sequence, static_cast<std::uint64_t>(i));
    EXPECT_EQ(frame.angles, recording.take().Angles(1, i));
    EXPECT_TRUE(SamePixels<Bgr>(frame.image, SmallPicture(recording.take(), 1, i).view())) << i;
  }
  EXPECT_EQ(driver->Grab(frame, milliseconds(0)), GrabStatus::kEnd);
}

TEST(TakeDriver, PassesPicturesBeforeTheFirstRowEachTime) {
  constexpr int kLead = 3;
  Recording recording(Pace::kFast, false);
  const auto driver = recording.Make(1, kLead);
  Frame frame;
  for (int run = 0; run < 2; ++run) {
    driver->Start();
    for (int i = kLead; i < recording.take().frames; ++i) {
      ASSERT_EQ(driver->Grab(frame, milliseconds(0)), GrabStatus::kFrame);
      EXPECT_EQ(frame.capture_ns, recording.take().TimeNs(1, i));
      EXPECT_TRUE(SamePixels<Bgr>(frame.image, SmallPicture(recording.take(), 1, i).view())) << i;
    }
    EXPECT_EQ(driver->Grab(frame, milliseconds(0)), GrabStatus::kEnd);
    driver->Stop();
  }
}

TEST(TakeDriver, RealtimeMovesTheTakeToThePresentAndKeepsItsIntervals) {
  Recording recording(Pace::kRealtime, false);
  const auto driver = recording.Make(2);
  driver->Start();
  Frame frame;
  for (int i = 0; i < recording.take().frames; ++i) {
    ASSERT_EQ(driver->Grab(frame, milliseconds(1000)), GrabStatus::kFrame);
    const std::int64_t due_ns =
        kStart_ns + recording.take().TimeNs(2, i) - recording.take().first_ns;
    EXPECT_EQ(frame.capture_ns, due_ns);
    EXPECT_EQ(recording.now_ns, due_ns);
  }
}

TEST(TakeDriver, RealtimeGivesUpAfterTheTimeout) {
  Recording recording(Pace::kRealtime, false);
  const auto driver = recording.Make(0);
  driver->Start();
  Frame frame;
  ASSERT_EQ(driver->Grab(frame, milliseconds(0)), GrabStatus::kFrame);
  EXPECT_EQ(driver->Grab(frame, milliseconds(15)), GrabStatus::kTimeout);
  EXPECT_EQ(recording.now_ns, kStart_ns + 15 * kMillisecond_ns);
  EXPECT_EQ(driver->Grab(frame, milliseconds(15)), GrabStatus::kTimeout);
  EXPECT_EQ(driver->Grab(frame, milliseconds(15)), GrabStatus::kFrame);
  EXPECT_EQ(recording.now_ns, kStart_ns + recording.take().interval_ns);
  EXPECT_EQ(frame.sequence, 1u);
}

TEST(TakeDriver, SlowCallerLosesTheOldestFramesAndSeesTheGap) {
  Recording recording(Pace::kRealtime, false);
  const auto driver = recording.Make(0);
  driver->Start();
  Frame frame;
  ASSERT_EQ(driver->Grab(frame, milliseconds(0)), GrabStatus::kFrame);
  recording.now_ns = kStart_ns + 9 * recording.take().interval_ns;
  ASSERT_EQ(driver->Grab(frame, milliseconds(0)), GrabStatus::kFrame);
  const int oldest = 9 - static_cast<int>(TakeDriver::kBufferedFrames) + 1;
  EXPECT_EQ(frame.sequence, static_cast<std::uint64_t>(oldest));
  EXPECT_EQ(frame.capture_ns, kStart_ns + oldest * recording.take().interval_ns);
  EXPECT_TRUE(SamePixels<Bgr>(frame.image, SmallPicture(recording.take(), 0, oldest).view()));
}

TEST(TakeDriver, CamerasOfATakeShareOneTimeLine) {
  Recording recording(Pace::kRealtime, false);
  const auto first = recording.Make(0), second = recording.Make(1);
  first->Start();
  recording.now_ns += 3 * kMillisecond_ns;
  second->Start();
  Frame a, b;
  ASSERT_EQ(first->Grab(a, milliseconds(0)), GrabStatus::kFrame);
  ASSERT_EQ(second->Grab(b, milliseconds(0)), GrabStatus::kFrame);
  EXPECT_EQ(b.capture_ns - a.capture_ns,
            recording.take().TimeNs(1, 0) - recording.take().TimeNs(0, 0));
}

TEST(TakeDriver, TimeLineBeginsAnewOnceAllCamerasHaveStopped) {
  Recording recording(Pace::kRealtime, false);
  const auto first = recording.Make(0), second = recording.Make(1);
  first->Start();
  second->Start();
  first->Stop();
  second->Stop();
  recording.now_ns += 3600 * 1000 * kMillisecond_ns;
  const std::int64_t again_ns = recording.now_ns;
  first->Start();
  Frame frame;
  ASSERT_EQ(first->Grab(frame, milliseconds(0)), GrabStatus::kFrame);
  EXPECT_EQ(frame.capture_ns, again_ns);
  EXPECT_EQ(frame.sequence, 0u);
}

TEST(TakeDriver, LoopsGoOnIncreasingInStep) {
  for (const Pace pace : {Pace::kFast, Pace::kRealtime}) {
    Recording recording(pace, true);
    const SmallTake& take = recording.take();
    const auto driver = recording.Make(1);
    driver->Start();
    const std::int64_t shift_ns = pace == Pace::kFast ? 0 : kStart_ns - take.first_ns;
    Frame frame;
    for (int i = 0; i < 3 * take.frames + 2; ++i) {
      ASSERT_EQ(driver->Grab(frame, milliseconds(1000)), GrabStatus::kFrame);
      // The period of a loop is a whole number of intervals, so times go on as within the take.
      EXPECT_EQ(frame.capture_ns, take.TimeNs(1, i) + shift_ns);
      EXPECT_EQ(frame.sequence, static_cast<std::uint64_t>(i));
      EXPECT_TRUE(SamePixels<Bgr>(frame.image, SmallPicture(take, 1, i % take.frames).view()));
    }
  }
}

TEST(TakeDriver, BeginsWhenItIsTold) {
  const std::int64_t begin_ns = kStart_ns + 20 * kMillisecond_ns;
  Recording recording(Pace::kRealtime, true, {}, [begin_ns] { return begin_ns; });
  const auto driver = recording.Make(0);
  driver->Start();
  Frame frame;
  EXPECT_EQ(driver->Grab(frame, milliseconds(10)), GrabStatus::kTimeout);
  ASSERT_EQ(driver->Grab(frame, milliseconds(1000)), GrabStatus::kFrame);
  EXPECT_EQ(frame.capture_ns, begin_ns + recording.take().TimeNs(0, 0) - recording.take().first_ns);
}

TEST(TakeDriver, JoinsTheLoopThatIsUnderWay) {
  const SmallTake take;
  const std::int64_t loop_ns = take.frames * take.interval_ns;
  Recording recording(Pace::kRealtime, true, take,
                      [&] { return kStart_ns - 5 * loop_ns - take.interval_ns; });
  const auto driver = recording.Make(0);
  driver->Start();
  Frame frame;
  ASSERT_EQ(driver->Grab(frame, milliseconds(1000)), GrabStatus::kFrame);
  EXPECT_EQ(frame.sequence, 0u);
  EXPECT_EQ(frame.capture_ns, kStart_ns - take.interval_ns + take.TimeNs(0, 0) - take.first_ns);
}

TEST(TakeDriver, JoinsLateAsIfItHadRunAllTheTime) {
  constexpr std::int64_t kLoops = 100'000'000;  // Each of them would take a millisecond to pass.
  Recording recording(Pace::kRealtime, true);
  const SmallTake& take = recording.take();
  const auto punctual = recording.Make(0), late = recording.Make(1);
  punctual->Start();
  for (const int behind : {1, 5, 7}) {
    late->Start();
    recording.now_ns = kStart_ns + (kLoops * take.frames + behind) * take.interval_ns;
    Frame frame;
    // The newest one is not due yet.
    std::int64_t row =
        kLoops * take.frames + behind - static_cast<int>(TakeDriver::kBufferedFrames);
    for (int i = 0; i < 2 * take.frames; ++i, ++row) {
      ASSERT_EQ(late->Grab(frame, milliseconds(1000)), GrabStatus::kFrame);
      EXPECT_EQ(frame.sequence, static_cast<std::uint64_t>(row));
      EXPECT_EQ(frame.capture_ns - kStart_ns, kMillisecond_ns + row * take.interval_ns);
      const int shown = static_cast<int>(row % take.frames);
      EXPECT_TRUE(SamePixels<Bgr>(frame.image, SmallPicture(take, 1, shown).view())) << row;
    }
    late->Stop();
  }
}

TEST(TakeDriver, ReadsAFrameBeforeItIsDue) {
  Recording recording(Pace::kRealtime, false);
  const auto driver = recording.Make(0);
  driver->Start();
  Frame frame;
  ASSERT_EQ(driver->Grab(frame, milliseconds(0)), GrabStatus::kFrame);
  ASSERT_EQ(driver->Grab(frame, milliseconds(15)), GrabStatus::kTimeout);
  testing::CutFile(recording.video(0), 0);
  ASSERT_EQ(driver->Grab(frame, milliseconds(100)), GrabStatus::kFrame);
  EXPECT_TRUE(SamePixels<Bgr>(frame.image, SmallPicture(recording.take(), 0, 1).view()));
}

TEST(TakeDriver, CutOffVideoStaysInStepWhenItLoops) {
  Recording recording(Pace::kFast, true);
  testing::CutFile(recording.video(0), 0.5);
  const auto driver = recording.Make(0);
  driver->Start();
  Frame before, frame;
  ASSERT_EQ(driver->Grab(before, milliseconds(0)), GrabStatus::kFrame);
  while (driver->Grab(frame, milliseconds(0)) == GrabStatus::kFrame &&
         frame.sequence == before.sequence + 1) {
    before = frame;
  }
  EXPECT_LT(before.sequence, 8u);
  EXPECT_EQ(frame.sequence, static_cast<std::uint64_t>(recording.take().frames));
  EXPECT_EQ(frame.capture_ns, recording.take().TimeNs(0, recording.take().frames));
}

TEST(TakeDriver, TornFrameIsReportedAndTheOthersKeepTheirTimes) {
  Recording recording(Pace::kFast, false);
  testing::WriteVideoWithSpoiledFrame(recording.video(0), recording.take(), 5);
  const auto driver = recording.Make(0);
  driver->Start();
  Frame frame;
  for (int i = 0; i < recording.take().frames; ++i) {
    ASSERT_EQ(driver->Grab(frame, milliseconds(0)),
              i == 5 ? GrabStatus::kTorn : GrabStatus::kFrame);
    EXPECT_EQ(frame.capture_ns, recording.take().TimeNs(0, i));
  }
  EXPECT_EQ(driver->Grab(frame, milliseconds(0)), GrabStatus::kEnd);
}

TEST(TakeDriver, RecordingThatVanishesWhileLoopingIsLostUntilItIsBack) {
  Recording recording(Pace::kRealtime, true);
  const auto driver = recording.Make(0);
  driver->Start();
  Frame frame;
  for (int i = 0; i < recording.take().frames; ++i) {
    ASSERT_EQ(driver->Grab(frame, milliseconds(1000)), GrabStatus::kFrame);
  }
  const std::filesystem::path away = recording.video(0).string() + ".away";
  std::filesystem::rename(recording.video(0), away);
  const std::int64_t before_ns = recording.now_ns;
  EXPECT_EQ(driver->Grab(frame, milliseconds(100)), GrabStatus::kLost);
  EXPECT_EQ(recording.now_ns, before_ns + 100 * kMillisecond_ns);
  std::filesystem::rename(away, recording.video(0));
  EXPECT_EQ(driver->Grab(frame, milliseconds(100)), GrabStatus::kFrame);
}

TEST(SystemClock, WakesNoEarlierThanAsked) {
  TimelineClock clock;
  const std::int64_t wanted_ns = clock.NowNs() + kMillisecond_ns;
  clock.SleepUntil(wanted_ns);
  EXPECT_GE(clock.NowNs(), wanted_ns);
}

template <Pace pace, bool loop>
struct TakeFactory {
  static constexpr bool kEnds = !loop;
  std::string WhySkip() { return ""; }
  std::unique_ptr<CameraDriver> Make() { return recording.Make(0); }
  Recording recording{pace, loop};
};

using TakeFactories =
    ::testing::Types<TakeFactory<Pace::kFast, false>, TakeFactory<Pace::kFast, true>,
                     TakeFactory<Pace::kRealtime, false>, TakeFactory<Pace::kRealtime, true>>;

}  // namespace

namespace testing {
INSTANTIATE_TYPED_TEST_SUITE_P(Take, CameraDriverSuite, TakeFactories);
}  // namespace testing
}  // namespace mocap
