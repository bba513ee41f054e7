#include "tools/view/take_pictures.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "config/camera_files.h"
#include "config/open_studio.h"
#include "core/errors.h"
#include "core/reconstruction/carving/miss_rates.h"
#include "core/reconstruction/carving/unknown_share.h"
#include "daemon/pipeline/pipeline.h"
#include "drivers/take/take_layout.h"

namespace mocap {
namespace {

constexpr double kVoxel_mm = 25;

/// The row nearest to a time.
std::size_t NearestRow(const TakeTable& table, std::int64_t time_ns) {
  const auto after = std::ranges::lower_bound(table.rows, time_ns, {}, &TakeRow::timestamp_ns);
  if (after == table.rows.begin()) return 0;
  const auto row = static_cast<std::size_t>(after - table.rows.begin());
  if (after == table.rows.end()) return row - 1;
  return after->timestamp_ns - time_ns < time_ns - (after - 1)->timestamp_ns ? row : row - 1;
}

}  // namespace

TakePictures::TakePictures(const std::filesystem::path& take)
    : carver_(CarvingOptions{.voxel_mm = kVoxel_mm}) {
  const Studio studio = OpenTake(take, {});
  RequireCameraCount(studio);
  const TakeLayout layout{take};
  remarks_ = studio.remarks;
  name_ = studio.name;
  fps_nominal_ = studio.fps_nominal;
  calibrations_ = CalibrationsOf(studio);
  for (std::size_t i = 0; i < calibrations_.size(); ++i) {
    const CameraCalibration& calibration = calibrations_[i];
    Camera camera{.video = OpenCameraVideo(layout.Video(calibration.name), calibration),
                  .table = ReadCameraTable(layout.Table(calibration.name), calibration),
                  .learning = std::async(std::launch::async,
                                         [calibration, source = studio.cameras[i].background] {
                                           return Segmenter(calibration, source(), {});
                                         }),
                  .segmenter = {},
                  .image = {}};
    cameras_.push_back(std::move(camera));
    tables_.emplace_back(calibration);
  }
  shadows_.emplace(calibrations_);
}

std::vector<RigidTransform> TakePictures::FirstPoses() const {
  std::vector<RigidTransform> poses;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    poses.push_back(calibrations_[i].PoseAt(cameras_[i].table.rows.front().angles));
  }
  return poses;
}

std::vector<std::int64_t> TakePictures::Times() const {
  const auto longest = std::ranges::max_element(
      cameras_, {}, [](const Camera& camera) { return camera.table.rows.size(); });
  std::vector<std::int64_t> times;
  for (const TakeRow& row : longest->table.rows) times.push_back(row.timestamp_ns);
  return times;
}

std::vector<TakePicture> TakePictures::At(std::int64_t time_ns) {
  const std::int64_t tolerance_ns = std::llround(0.5e9 / fps_nominal_);
  std::vector<TakePicture> pictures;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    Camera& camera = cameras_[i];
    const std::size_t at = NearestRow(camera.table, time_ns);
    const TakeRow& row = camera.table.rows[at];
    if (std::abs(row.timestamp_ns - time_ns) > tolerance_ns || !Seek(camera, at)) continue;
    pictures.push_back({.camera = static_cast<int>(i),
                        .capture_ns = row.timestamp_ns,
                        .X_CW = calibrations_[i].PoseAt(row.angles),
                        .image = camera.image,
                        .trimap = Segment(camera, row.angles)});
  }
  DecideFloor(pictures);
  return pictures;
}

void TakePictures::DecideFloor(std::vector<TakePicture>& pictures) {
  std::vector<ShadedView> views;
  for (TakePicture& picture : pictures) {
    if (!picture.trimap) continue;
    const auto camera = static_cast<std::size_t>(picture.camera);
    views.push_back({picture.camera, &tables_[camera], picture.X_CW,
                     &cameras_[camera].segmenter->shading(), &*picture.trimap});
  }
  shadows_->Complete(views);
}

bool TakePictures::Seek(Camera& camera, std::size_t row) const {
  if (row + 1 == camera.next) return camera.is_whole;
  if (row < camera.next) {
    const bool is_back = camera.video.ReturnTo(row);
    if (!is_back) camera.video.Rewind();
    camera.next = is_back ? row : 0;
  }
  for (; camera.next < row; ++camera.next) {
    if (camera.video.Skip() == VideoStatus::kEnd) break;
  }
  camera.is_whole = camera.next == row && camera.video.Read(camera.image) == VideoStatus::kFrame;
  camera.next = row + 1;
  return camera.is_whole;
}

std::optional<Trimap> TakePictures::Segment(Camera& camera, const PanTiltAngles& angles) const {
  const bool is_learned =
      camera.learning.valid() &&
      camera.learning.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  if (is_learned) {
    try {
      camera.segmenter = camera.learning.get();
    } catch (const SetupError&) {
      // The background is unusable: the take is shown without silhouettes.
    }
  }
  if (!camera.segmenter) return {};
  std::optional<Trimap> trimap(std::in_place);
  camera.segmenter->Segment(camera.image, angles, *trimap);
  return trimap;
}

std::optional<double> TakePictures::UnknownShareOf(const TakePicture& picture,
                                                   const VoxelGrid& hull) const {
  if (!picture.trimap) return {};
  const Trimap& trimap = *picture.trimap;
  const auto camera = static_cast<std::size_t>(picture.camera);
  return UnknownShare(hull, {&tables_[camera], &trimap.person, picture.X_CW, &trimap.unknown});
}

VoxelGrid TakePictures::Carve(const std::vector<TakePicture>& pictures) {
  std::vector<CarvingView> views;
  VoxelGrid grid;
  for (const TakePicture& picture : pictures) {
    if (!picture.trimap) return grid;
    views.push_back({&tables_[static_cast<std::size_t>(picture.camera)], &picture.trimap->person,
                     picture.X_CW, &picture.trimap->unknown});
  }
  if (views.empty()) return grid;
  WeighOnce(views, false);
  carver_.Carve(views, grid);
  return grid;
}

}  // namespace mocap
