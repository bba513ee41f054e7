// Real cameras: clips of a ChArUco board, and a board on the floor of a studio.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "config/load_config.h"
#include "drivers/take/calibration_file.h"
#include "tests/support/temporary_folder.h"
#include "tools/calibration/extrinsics.h"
#include "tools/calibration/footage.h"
#include "tools/calibration/lens_fit.h"
#include "tools/calibration/still_board.h"
#include "tools/camera_health.h"
#include "tools/report/report.h"
#include "tools/take_samples.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

const fs::path kShared = MOCAP_SHARED_DIR;
const fs::path kCharuco = kShared / "data/charuco/charuco_calibration/calibration/extrinsic";
const fs::path kBoardFolder = kShared / "data/board";
const fs::path kSeated = kShared / "takes/real_seated";

/// The camera centres [mm] that some moments' views give.
std::vector<Vector3> CentersFrom(BoardDetections detections,
                                 const std::vector<CameraCalibration>& lenses,
                                 const std::function<bool(int moment)>& is_used) {
  std::erase_if(detections.detections, [&](const BoardDetection& s) { return !is_used(s.moment); });
  const StudioFit fit = FitExtrinsics(detections, lenses, {.refine_lenses = false});
  std::vector<Vector3> centers;
  for (const CameraCalibration& camera : fit.bundle.cameras)
    centers.push_back(camera.X_CW.Inverse().p);
  return centers;
}

TEST(RealStudioTest, PosesFourCamerasFromClipsOfACharucoBoard) {
  if (!fs::exists(kCharuco)) GTEST_SKIP() << "no clips in " << kCharuco;
  const BoardDetections detections = CollectDetections(
      OpenFootage(kCharuco), ParseBoard("charuco:4x5:54:DICT_4X4_1000:inverted"), {});
  std::vector<CameraCalibration> lenses;
  for (int c = 0; c < 4; ++c) {
    const LensFit fit = FitLens(detections, c, {});
    EXPECT_LE(fit.rms_px, 0.30) << detections.cameras[c].name;
    lenses.push_back({detections.cameras[c].name, 1280, 720, fit.lens, {}, {}});
  }
  const StudioFit fit = FitExtrinsics(detections, lenses, {});
  EXPECT_LE(fit.rms_px, 0.45);
  // Two halves of the frames, eight of one after eight of the other: cameras run up to a frame
  // apart. The lenses are those of all frames.
  const auto half = [&](int which) {
    return CentersFrom(detections, fit.bundle.cameras,
                       [which](int moment) { return moment / 8 % 2 == which; });
  };
  const std::vector<Vector3> one = half(0), other = half(1);
  for (int c = 0; c < 4; ++c) EXPECT_LT((one[c] - other[c]).norm(), 10) << lenses[c].name;
}

void ExpectAllPosedTheSameWay(const StudioFit& fit) {
  const std::vector<CameraCalibration> known = LoadCalibration(kSeated / "calibration.toml");
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_LE(fit.cameras[c].rms_px, 0.7) << fit.cameras[c].name;
    EXPECT_GT(fit.bundle.cameras[c].X_CW.Inverse().p.z(), 1000);
  }
  // The board looks the same turned: distances between cameras tell whether all took it one way.
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const auto apart_mm = [&](const std::vector<CameraCalibration>& cameras) {
        return (cameras[a].X_CW.Inverse().p - cameras[b].X_CW.Inverse().p).norm();
      };
      EXPECT_NEAR(apart_mm(fit.bundle.cameras) / apart_mm(known), 1, 0.02) << a << " " << b;
    }
  }
}

TEST(RealStudioTest, PosesAllCamerasFromOneBoardOnTheFloorAndCarvesAPersonAsWellAsTheTakes) {
  if (!fs::exists(kBoardFolder) || !fs::exists(kSeated))
    GTEST_SKIP() << "not both of " << kBoardFolder << " and " << kSeated;
  DetectionOptions options;
  options.still = true;
  const BoardDetections still =
      CollectDetections(OpenFootage(kBoardFolder), ParseBoard("chess:8x6:115"), options);
  const StudioFit fit = FitToStillBoard(still, LoadCalibration(kSeated / "calibration.toml"),
                                        still.still_pictures, 0);
  ExpectAllPosedTheSameWay(fit);
  const testing::TemporaryFolder folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(kSeated)) {
    if (entry.path().filename() != "calibration.toml")
      fs::create_symlink(entry.path(), folder.path() / entry.path().filename());
  }
  WriteCalibration(folder.path() / "calibration.toml", fit.bundle.cameras);
  const auto overlap = [](const fs::path& take) {
    const std::vector<CameraOverlap> cameras =
        MeasureOverlaps(SampleTake(take, ChooseHealthMoments(take, 0, 5, 4), 25));
    return std::accumulate(cameras.begin(), cameras.end(), 0.0,
                           [](double sum, const CameraOverlap& c) { return sum + c.mean(); }) /
           static_cast<double>(cameras.size());
  };
  const double theirs = overlap(kSeated), ours = overlap(folder.path());
  RecordProperty("theirs", std::to_string(theirs));
  RecordProperty("ours", std::to_string(ours));
  EXPECT_GE(ours, theirs - 0.005);
}

}  // namespace
}  // namespace mocap
