// A room of people made of the model's own flesh, and the capture that follows them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "core/people/people_capture.h"
#include "core/surface_capture.h"
#include "daemon/pipeline/capture_beside.h"
#include "tests/support/seen_body.h"
#include "tests/support/standing_height.h"

namespace mocap {

/// A body in a pose.
struct Someone {
  BodyModel body;
  PoseState pose;
};

/// Sees people at 30 Hz with six cameras, and follows up to four.
class Room : public ::testing::Test {
 protected:
  explicit Room(int most = 4, SideSearches* side = nullptr, double radius_mm = 3200)
      : studio_(radius_mm), people_([this] { return Make(); }, {.most = most, .side = side}) {}

  std::unique_ptr<MotionCapture> Make() const { return MakeSurfaceCapture(table_); }

  Someone At(double x_mm, double y_mm, double stature_mm, int frame = 0) const {
    const BodyModel body(table_, AverageSizes(stature_mm));
    const double swing = std::sin(0.2 * frame);
    PoseState pose;
    pose.X_WT.p = Vector3(x_mm, y_mm, 0);
    const ArmStance arm_l{.raise = -70, .forward = 20 * swing, .elbow = 25};
    const ArmStance arm_r{.raise = -70, .forward = -20 * swing, .elbow = 25};
    const LegStance leg_l{.hip = -20 * swing, .knee = 15};
    const LegStance leg_r{.hip = 20 * swing, .knee = 15};
    pose.theta = AnglesOf({arm_l, arm_r, leg_l, leg_r}, table_);
    PutOnFloor(body, pose);
    return {body, pose};
  }

  RoundStudio::CarvedBody Carve(const std::vector<Someone>& everybody) const {
    std::vector<PosedCapsule> flesh, one;
    for (const Someone& person : everybody) {
      person.body.PoseShape(person.body.PostureAt(person.pose), one);
      flesh.insert(flesh.end(), one.begin(), one.end());
    }
    return studio_.Carve(flesh, kRays);
  }

  void See(const RoundStudio::CarvedBody& seen) {
    people_.Update({seen.hull, seen.outlines}, eyes_, now_ns_ += kFrameNs);
  }
  void See(const std::vector<Someone>& everybody) { See(Carve(everybody)); }

  // Mean distance of whoever is tracked nearest.
  double ErrorOf(const Someone& person) const {
    const BodyPoints truth = person.body.PointsAt(person.body.PostureAt(person.pose));
    double least_mm = 1e9;
    for (const PersonView& view : people_.people()) {
      const CaptureResult& result = view.capture->result();
      if (result.state != CaptureState::kTracking) continue;
      least_mm = std::min(least_mm, (result.points_W - truth).colwise().norm().mean());
    }
    return least_mm;
  }

  std::vector<int> Ids() const {
    std::vector<int> ids;
    for (const PersonView& view : people_.people()) ids.push_back(view.id);
    return ids;
  }

  static constexpr std::int64_t kFrameNs = 33'333'333;
  static constexpr int kRays = 200;

  BodyTable table_ = LoadBodyTable("full");
  RoundStudio studio_;
  const std::vector<CameraEye> eyes_ = studio_.Eyes();
  PeopleCapture people_;
  std::int64_t now_ns_ = 1'000'000'000'000;
};

/// Searches that go on when a test says so.
class Desk : public SideSearches {
 public:
  std::unique_ptr<SideSearch> Begin(std::shared_ptr<MotionCapture> capture) override {
    return std::make_unique<CaptureBeside>(std::move(capture), [this](std::function<void()> work) {
      waiting_.push_back(std::move(work));
      return true;
    });
  }
  void DoAll() {
    for (const auto& work : std::exchange(waiting_, {})) work();
  }
  bool empty() const { return waiting_.empty(); }

 private:
  std::vector<std::function<void()>> waiting_;
};

/// Lives longer than the room.
struct DeskFirst {
  Desk desk_;
};

/// Newcomers are searched for at the desk.
class RoomWithSide : public DeskFirst, public Room {
 protected:
  RoomWithSide() : Room(4, &desk_) {}

  const Someone stays_ = At(-600, 0, 1750);
  const Someone comes_ = At(700, 200, 1700);
};

}  // namespace mocap
