#include "tools/board_recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <barrier>
#include <stdexcept>
#include <utility>

#include "core/errors.h"
#include "drivers/virtual_studio/room/camera_rig.h"
#include "tests/support/temporary_folder.h"
#include "tests/tools/calibration/board_picture.h"
#include "tests/tools/calibration/simulated_board.h"
#include "tools/calibrate_live.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t kBegin_ns = 1'000'000'000'000, kInterval_ns = 33'333'333;

/// Shows one picture again and again, 30 times a second of its own time, for as long as it has.
/// Cameras with a barrier in common go frame by frame together.
class PictureCamera : public CameraDriver {
 public:
  PictureCamera(Image<Bgr> picture, int frames, std::barrier<>* together)
      : picture_(std::move(picture)), frames_(frames), together_(together) {}
  void Start() override {}
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds) override {
    if (together_) together_->arrive_and_wait();
    if (next_ == frames_) return GrabStatus::kEnd;
    frame.image = std::as_const(picture_).view();
    frame.capture_ns = kBegin_ns + next_++ * kInterval_ns;
    return GrabStatus::kFrame;
  }
  void Stop() override {}

 private:
  const Image<Bgr> picture_;
  const int frames_;
  std::barrier<>* const together_;
  int next_ = 0;
};

class BoardRecordingTest : public ::testing::Test {
 protected:
  BoardRecordingTest() {
    options_.board = testing::BoardWalk{}.board;
    options_.folder = folder_.path() / "carried";
    const Matrix3 R = ExpRotation({0.3, 0.2, 0.1});
    seen_ =
        testing::PaintBoard(simulation::HangCameras({})[0],
                            {R, Vector3(0, 0, 1900) - R * Vector3(350, 200, 0)}, options_.board);
  }

  void AddCamera(const std::string& name, const Image<Bgr>& picture, int frames,
                 std::barrier<>* together = nullptr) {
    LiveCamera& camera = cameras_.emplace_back();
    camera.name = name;
    camera.driver = std::make_unique<PictureCamera>(picture, frames, together);
  }

  testing::TemporaryFolder folder_;
  BoardRecordingOptions options_;
  std::vector<LiveCamera> cameras_;
  Image<Bgr> seen_;
};

TEST_F(BoardRecordingTest, LeavesFootageOfTheSameMomentsOfAllCameras) {
  std::barrier together(2);
  AddCamera("cam1", seen_, 30, &together);
  AddCamera("cam2", seen_, 30, &together);
  std::vector<CameraHint> last;
  RecordBoard(cameras_, options_, [&](const std::vector<CameraHint>& hints) {
    last = hints;
    return false;
  });
  ASSERT_EQ(last.size(), 2u);
  EXPECT_GE(last[1].views, 1);
  const Footage footage = OpenFootage(options_.folder);
  ASSERT_EQ(footage.cameras.size(), 2u);
  const std::vector<FootageMoment> moments = MatchMoments(footage);
  // 30 frames of 30 a second are 1 s, of which 5 are kept.
  EXPECT_EQ(moments.size(), 5u);
  for (const FootageMoment& moment : moments) EXPECT_EQ(moment.frames[0], moment.frames[1]);
  EXPECT_EQ(CollectDetections(footage, options_.board, {}).CountOf(1), 5);
}

TEST_F(BoardRecordingTest, NamesAnotherBoardThatIsShownInstead) {
  options_.board = ParseBoard("chess:9x6:100");
  AddCamera("cam1", seen_, 30);
  std::vector<CameraHint> last;
  RecordBoard(cameras_, options_, [&](const std::vector<CameraHint>& hints) {
    last = hints;
    return false;
  });
  ASSERT_EQ(last.size(), 1u);
  EXPECT_THAT(last[0].missing, HasSubstr("looks like chess:8x5:100, not chess:9x6:100"));
}

TEST_F(BoardRecordingTest, EndsWhenNothingIsMissing) {
  AddCamera("cam1", seen_, 1'000'000'000);
  RecordBoard(cameras_, options_, [](const std::vector<CameraHint>&) { return true; });
  EXPECT_GE(OpenFootage(options_.folder).cameras[0].frames.size(), 2u);
}

TEST_F(BoardRecordingTest, NamesTheCameraThatDeliversNothing) {
  AddCamera("cam1", seen_, 30);
  AddCamera("cam2", seen_, 0);
  cameras_[1].request.device = "/dev/video7";
  try {
    RecordBoard(cameras_, options_, [](const std::vector<CameraHint>&) { return false; });
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("cam2 (/dev/video7) has delivered no frame"));
  }
}

TEST_F(BoardRecordingTest, KeepsWhatWasRecordedWhenTheListenerFails) {
  AddCamera("cam1", seen_, 1'000'000'000);
  EXPECT_THROW(RecordBoard(cameras_, options_,
                           [](const std::vector<CameraHint>&) -> bool {
                             throw std::runtime_error("the terminal is gone");
                           }),
               std::runtime_error);
  EXPECT_GE(OpenFootage(options_.folder).cameras[0].frames.size(), 2u);
}

TEST_F(BoardRecordingTest, WithoutAPictureLeavesNoFolderInTheWayOfTheNextAttempt) {
  AddCamera("cam1", seen_, 0);
  EXPECT_THROW(
      RecordBoard(cameras_, options_, [](const std::vector<CameraHint>&) { return false; }),
      std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(options_.folder));
}

TEST_F(BoardRecordingTest, KeepsWhatWasRecordedBefore) {
  std::filesystem::create_directory(options_.folder);
  EXPECT_THROW(RecordBoard(cameras_, options_, {}), SetupError);
}

std::vector<CameraCalibration> Rig() { return simulation::HangCameras({}); }

TEST(BoardHintsTest, NothingIsMissingAfterALongWalk) {
  for (const CameraHint& hint : HintsFor(testing::WalkBoard(Rig(), {})))
    EXPECT_THAT(hint.missing, IsEmpty()) << hint.camera;
}

TEST(BoardHintsTest, NamesWhatEachCameraHasNotSeen) {
  BoardDetections detections = testing::WalkBoard(Rig(), {});
  std::erase_if(detections.detections, [](const BoardDetection& s) {
    return s.camera == 0 ||
           (s.camera == 3 && std::ranges::any_of(s.corners.pixels,
                                                 [](const Vector2& pixel) {
                                                   return pixel.x() < 214 && pixel.y() < 240;
                                                 })) ||
           (s.camera == 4 && s.moment > 20);
  });
  const std::vector<CameraHint> hints = HintsFor(detections);
  EXPECT_EQ(hints[0].missing, "has not seen the board");
  EXPECT_EQ(hints[3].missing, "nothing in the upper left");
  EXPECT_THAT(hints[4].missing, ::testing::AnyOf(HasSubstr("more views"), HasSubstr("nothing in")));
}

TEST(BoardHintsTest, NamesWithWhomACameraHasToShareViews) {
  BoardDetections detections = testing::WalkBoard(Rig(), {});
  // Camera 6 was shown the board alone.
  for (BoardDetection& s : detections.detections) {
    if (s.camera == 5) s.moment += detections.moments;
  }
  detections.moments *= 2;
  const std::vector<CameraHint> hints = HintsFor(detections);
  EXPECT_THAT(hints[5].missing, HasSubstr("at the same time (0 of 8 views)"));
  EXPECT_THAT(hints[0].missing, IsEmpty());
  EXPECT_THAT(HintText(hints), HasSubstr("cam6"));
}

}  // namespace
}  // namespace mocap
