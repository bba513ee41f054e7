#include "tools/gige/studio_source.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/pattern_camera.h"

namespace mocap {
namespace {

using std::chrono::milliseconds;

constexpr int kSide_px = 8;
constexpr double kFps = 200;

/// A source for one of two cameras; the recording is a pattern, the empty studio black.
struct Shown {
  StudioSource Make(int camera) {
    return StudioSource(stage, camera, 2, kFps, Image<Bgr>(kSide_px, kSide_px),
                        std::make_unique<testing::PatternCamera>(kSide_px, kSide_px, kFps),
                        [this] { return streams; });
  }
  StudioStage stage;
  bool streams = false;
};

bool IsRecording(const Frame& frame) { return testing::PatternCamera::IsPattern(frame.image); }

TEST(StudioSource, ShowsTheEmptyStudioUntilAllCamerasStream) {
  Shown shown;
  StudioSource source = shown.Make(0);
  Frame before, frame;
  ASSERT_EQ(source.Grab(before, milliseconds(100)), GrabStatus::kFrame);
  shown.streams = true;
  ASSERT_EQ(source.Grab(frame, milliseconds(100)), GrabStatus::kFrame);
  EXPECT_FALSE(IsRecording(frame));
  EXPECT_GT(frame.capture_ns, before.capture_ns);
  EXPECT_EQ(shown.stage.begin_ns.load(), 0);
  shown.stage.streams[1] = true;
  for (int i = 0; i < 1000 && !IsRecording(frame); ++i) source.Grab(frame, milliseconds(100));
  EXPECT_TRUE(IsRecording(frame));
  EXPECT_GE(frame.capture_ns, shown.stage.begin_ns.load() - static_cast<std::int64_t>(2e9 / kFps));
}

TEST(StudioSource, CameraThatReturnsJoinsTheOthers) {
  Shown shown;
  shown.stage.begin_ns = 1;
  StudioSource source = shown.Make(1);
  Frame frame;
  ASSERT_EQ(source.Grab(frame, milliseconds(100)), GrabStatus::kFrame);
  EXPECT_TRUE(IsRecording(frame));
}

}  // namespace
}  // namespace mocap
