#include "daemon/pipeline/node_path.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/errors.h"
#include "tests/daemon/fake_studio.h"

namespace mocap {
namespace {

using testing::FakeStudio;
using testing::kFakePeriodNs;
using testing::SteadyFrames;

class Times : public SilhouetteSink {
 public:
  explicit Times(std::size_t cameras) : of(cameras) {}
  void OnSilhouette(int camera, const SegmentedFrame& frame) override {
    of[static_cast<std::size_t>(camera)].push_back(frame.capture_ns);
    has_outlines |= !frame.outline.empty();
  }

  std::vector<std::vector<std::int64_t>> of;
  bool has_outlines = false;
};

TEST(NodePath, HandsOnEverySilhouetteOfEachCameraInOrder) {
  Times sink(2);
  NodePath path(FakeStudio({SteadyFrames(30), SteadyFrames(12)}), {.overflow = Overflow::kWait},
                sink);
  path.Start();
  path.Join();
  EXPECT_TRUE(path.finished());
  ASSERT_EQ(sink.of[0].size(), 30u);
  ASSERT_EQ(sink.of[1].size(), 12u);
  for (int n = 0; n < 30; ++n) EXPECT_EQ(sink.of[0][n], n * kFakePeriodNs);
  EXPECT_FALSE(sink.has_outlines) << "the studio traces them";
  const PipelineStatus status = path.Status();
  EXPECT_FALSE(status.tracks);
  EXPECT_EQ(status.sets_tracked, 42);
  EXPECT_EQ(status.cameras[1].frames, 12);
  EXPECT_EQ(status.cameras[1].state, CameraState::kEnded);
}

TEST(NodePath, ACameraThatDoesNotStartEndsIt) {
  Times sink(2);
  NodePath path(FakeStudio({SteadyFrames(5), nullptr}), {}, sink);
  path.Start();
  EXPECT_THROW(path.Join(), SetupError);
}

TEST(NodePath, EndsWhenItIsAskedTo) {
  Times sink(1);
  const auto forever = [](int call) {
    return testing::FakeGrab{GrabStatus::kFrame, call * kFakePeriodNs};
  };
  NodePath path(FakeStudio({forever}), {}, sink);
  path.Start();
  path.RequestStop();
  path.Join();
  EXPECT_TRUE(path.finished());
}

}  // namespace
}  // namespace mocap
