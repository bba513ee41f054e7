#include "daemon/pipeline/carve_stage.h"

#include <algorithm>
#include <utility>

#include "core/errors.h"
#include "drivers/clock.h"

namespace mocap {

CarvedSet RoomySet(std::size_t cameras, double voxel_mm) {
  // Without some camera, outstretched arms have a hull longer than the person.
  constexpr double kLongest_mm = 3200;
  constexpr double kHandsUp_mm = 2400;
  // No memory is reserved for finer voxels: they are not for real time.
  constexpr double kFinest_mm = 20;
  constexpr std::size_t kUsuallyDoubtful = 4000;
  CarvedSet set;
  const Vector3 voxels =
      Vector3(kLongest_mm, kLongest_mm, kHandsUp_mm) / std::max(voxel_mm, kFinest_mm);
  set.grid.Reset(Eigen::Vector3i::Zero(), voxels.cast<int>(), voxel_mm);
  set.doubtful.reserve(kUsuallyDoubtful);
  set.outlines.assign(cameras, Outline(kMostRays));
  set.eyes.reserve(cameras);
  return set;
}

CarveStage::CarveStage(const std::vector<CameraCalibration>& cameras, Synchronizer synchronizer,
                       const CarvingOptions& options, int rays, StageRecorders& recorders)
    : synchronizer_(std::move(synchronizer)),
      shadows_(cameras),
      rays_(rays),
      carver_(options),
      is_hard_(options.hard_silhouettes),
      miss_rates_(cameras.size(), options.several_people),
      recorders_(recorders) {
  MOCAP_CHECK(cameras.size() <= kMaxCameras);
  for (const CameraCalibration& camera : cameras) cameras_.emplace_back(camera);
  views_.reserve(cameras.size());
}

void CarveStage::Offer(int camera, SegmentedFrame& frame) {
  Camera& offering = cameras_[camera];
  if (load_control_ && synchronizer_.StartsAnew(camera, frame.capture_ns)) {
    load_control_->StartAnew();
    PublishLoad();
  }
  if (frame.capture_ns < wanted_from_ns_.load(std::memory_order_relaxed)) {
    offering.left_out.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  if (synchronizer_.Offer(camera, frame.capture_ns, frame.sequence)) {
    std::swap(offering.front, frame);
  }
  offering.late.store(synchronizer_.late(camera), std::memory_order_relaxed);
}

Synchronizer::Decision CarveStage::Next(CarvedSet& set) {
  const Synchronizer::Decision decision = synchronizer_.Decide();
  if (decision == Synchronizer::Decision::kLetGo) {
    const int camera = synchronizer_.camera();
    cameras_[camera].late.store(synchronizer_.late(camera), std::memory_order_relaxed);
  }
  if (decision != Synchronizer::Decision::kSet) return decision;
  const std::int64_t begin_ns = SteadyNs();
  DecideFloor();
  Gather(set);
  if (load_control_) {
    load_control_->AddSet(set.capture_ns, set.complete_ns, TimelineNs(), synchronizer_.PeriodNs());
    PublishLoad();
  }
  if (!is_hard_) miss_rates_.Weigh(views_, set.cameras, set.capture_ns);
  carver_.Carve(views_, set.grid, &set.doubtful);
  set.person_box_W = carver_.person_box_W();
  const std::int64_t carve_ns = SteadyNs() - begin_ns;
  set.work_ns += carve_ns;
  recorders_[Stage::kCarve].Record(carve_ns);
  recorders_[Stage::kSpread].Record(synchronizer_.spread_ns());
  if (seen_ && seen_pacer_.IsDue(SteadyNs())) OfferToWatch(set.grid);
  if (history_ && history_->Wants(set.frame)) history_->Add(PresentMoment());
  const bool complete = views_.size() == cameras_.size();
  (complete ? complete_sets_ : partial_sets_).fetch_add(1, std::memory_order_relaxed);
  return decision;
}

void CarveStage::OfferToWatch(const VoxelGrid& hull) {
  seen_->Offer([this, &hull](SeenSet& copy) {
    copy.capture_ns = synchronizer_.set_ns();
    copy.cameras.clear();
    copy.X_CW.clear();
    copy.miss_rates.clear();
    copy.hull = hull;
    copy.trimaps.resize(views_.size());
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      if (!synchronizer_.members()[i] || cameras_[i].front.is_blind) continue;
      copy.trimaps[copy.cameras.size()] = cameras_[i].front.trimap;
      copy.X_CW.push_back(cameras_[i].front.X_CW);
      copy.miss_rates.push_back(miss_rates_.Of(static_cast<int>(i)));
      copy.cameras.push_back(static_cast<int>(i));
    }
    return true;
  });
}

SeenMoment CarveStage::PresentMoment() const {
  SeenMoment moment(cameras_.size());
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    const SegmentedFrame& front = cameras_[i].front;
    if (!synchronizer_.members()[i] || front.is_blind) continue;
    moment[i] = ShapeOf(front.trimap.person, front.X_CW);
  }
  return moment;
}

void CarveStage::SetTracked(std::int64_t sets) {
  if (!load_control_) return;
  under_way_ = next_frame_ - sets;
  load_control_->SetUnderWay(under_way_, TimelineNs());
  PublishLoad();
}

void CarveStage::PublishLoad() {
  const std::int64_t wanted_from_ns = load_control_->wanted_from_ns();
  wanted_from_ns_.store(wanted_from_ns, std::memory_order_relaxed);
  skipped_sets_.store(load_control_->skipped(), std::memory_order_relaxed);
  for (int i = 0; i < camera_count(); ++i) {
    if (!synchronizer_.LetGoBefore(i, wanted_from_ns)) continue;
    cameras_[i].left_out.fetch_add(1, std::memory_order_relaxed);
  }
}

// Uses what the cameras of a set see together.
void CarveStage::DecideFloor() {
  shaded_.clear();
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    SegmentedFrame& front = cameras_[i].front;
    if (!synchronizer_.members()[i] || front.is_blind) continue;
    shaded_.push_back(
        {static_cast<int>(i), &cameras_[i].table, front.X_CW, &front.shading, &front.trimap});
  }
  shadows_.Complete(shaded_);
  for (const ShadedView& view : shaded_) {
    if (!view.has_changed) continue;
    Camera& camera = cameras_[static_cast<std::size_t>(view.camera)];
    TraceOutline(camera.calibration, view.X_CW, camera.front.trimap, rays_, camera.front.outline);
  }
}

void CarveStage::Gather(CarvedSet& set) {
  set.frame = next_frame_++;
  set.capture_ns = synchronizer_.set_ns();
  set.complete_ns = set.work_ns = 0;
  set.cameras = 0;
  views_.clear();
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (!synchronizer_.members()[i]) continue;
    const Camera& camera = cameras_[i];
    set.complete_ns = std::max(set.complete_ns, camera.front.arrival_ns);
    set.work_ns = std::max(set.work_ns, camera.front.segment_ns);
    if (camera.front.is_blind) continue;
    const Trimap& trimap = camera.front.trimap;
    views_.push_back({&camera.table, &trimap.person, camera.front.X_CW, &trimap.unknown});
    set.cameras |= std::uint64_t{1} << i;
  }
  set.eyes.clear();
  for (const CarvingView& view : views_) set.eyes.push_back({view.table, view.X_CW});
  set.outlines.resize(cameras_.size());
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (set.cameras >> i & 1) {
      const SegmentedFrame& front = cameras_[i].front;
      const double after_s = static_cast<double>(front.capture_ns - set.capture_ns) * 1e-9;
      set.outlines[i] = front.outline;
      for (GrazingRay& ray : set.outlines[i]) ray.after_s = after_s;
    } else {
      set.outlines[i].clear();
    }
  }
}

}  // namespace mocap
