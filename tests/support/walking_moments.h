// Somebody who walks about before six cameras, as diagnoses of a calibration see it.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "core/calibration/seen_shape.h"
#include "tests/support/seen_body.h"
#include "tests/support/standing_height.h"

namespace mocap::testing {

inline constexpr double kWalkerStature_mm = 1750;

/// Cameras cam1 to cam6 around the walk.
inline const std::vector<CameraCalibration>& WalkCameras() {
  static const std::vector<CameraCalibration> cameras = [] {
    std::vector<CameraCalibration> named = RoundStudio(4000).cameras();
    for (std::size_t c = 0; c < named.size(); ++c) named[c].name = "cam" + std::to_string(c + 1);
    return named;
  }();
  return cameras;
}

/// Ten moments on an arc beside the middle of the room, a second apart.
inline const std::vector<SeenMoment>& WalkingMoments() {
  static const std::vector<SeenMoment> walk = [] {
    const RoundStudio studio(4000);
    const BodyModel body(LoadBodyTable("full"), AverageSizes(kWalkerStature_mm));
    const auto& sizes = body.sizes();
    std::vector<SeenMoment> moments;
    for (int i = 0; i < 10; ++i) {
      const double along = 0.35 * i;
      Stance stance;
      stance.leg_l = {.hip = 20 * std::sin(2.0 * i), .knee = 10};
      stance.leg_r = {.hip = -20 * std::sin(2.0 * i), .knee = 10};
      PoseState pose;
      pose.X_WT.R = ExpRotation(Vector3(0, 0, along));
      pose.X_WT.p = {700 * std::cos(along), 700 * std::sin(along), StandingHeight(sizes)};
      pose.theta = AnglesOf(stance, body.table());
      std::vector<PosedCapsule> flesh;
      body.PoseShape(body.PostureAt(pose), flesh);
      SeenMoment& moment = moments.emplace_back();
      for (std::size_t c = 0; c < studio.cameras().size(); ++c)
        moment.push_back(ShapeOf(studio.See(c, flesh), studio.cameras()[c].X_CW));
    }
    return moments;
  }();
  return walk;
}

/// Exchanges what two cameras show, but not where they stand.
inline void ExchangePictures(std::size_t a, std::size_t b, std::vector<SeenMoment>& moments) {
  for (SeenMoment& moment : moments) {
    std::swap(moment[a], moment[b]);
    std::swap(moment[a]->X_CW, moment[b]->X_CW);
  }
}

}  // namespace mocap::testing
