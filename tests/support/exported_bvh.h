// What BVH files of results must have, for tests of both skeletons.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <span>
#include <sstream>
#include <string>

#include "core/body/body_model.h"
#include "tests/support/bvh_reader.h"
#include "tools/interchange/bvh_writer.h"
#include "tools/results/result.h"

namespace mocap::testing {

inline ReadBvh WrittenBvh(const Result& result, const Skeleton& skeleton = MocapdSkeleton()) {
  const ExportSubject subject{"", result};
  std::ostringstream text;
  WriteBvh({std::span(&subject, 1), result.poses, "walk.bvh", false, &skeleton}, text);
  return ParseBvh(text.str());
}

/// As BVH has it: y up; world x is z, and world y, the left of who faces x, is x.
inline Eigen::Vector3d Cm(const Vector3& p_W) {
  return Eigen::Vector3d(p_W.y(), p_W.z(), p_W.x()) / 10;
}

/// What a joint or end is at.
inline const std::map<std::string, Point>& BvhPoints() {
  static const std::map<std::string, Point> points = {{"Spine", Point::kTorso},
                                                      {"Neck", Point::kNeck},
                                                      {"Head", Point::kHead},
                                                      {"LeftArm", Point::kShoulderL},
                                                      {"RightArm", Point::kShoulderR},
                                                      {"LeftForeArm", Point::kElbowL},
                                                      {"RightForeArm", Point::kElbowR},
                                                      {"LeftHand_end", Point::kFingertipsL},
                                                      {"RightHand_end", Point::kFingertipsR},
                                                      {"LeftUpLeg", Point::kHipL},
                                                      {"RightUpLeg", Point::kHipR},
                                                      {"LeftLeg", Point::kKneeL},
                                                      {"RightLeg", Point::kKneeR}};
  return points;
}

/// Those at points that not every result has.
inline const std::map<std::string, Point>& FurtherBvhPoints() {
  static const std::map<std::string, Point> points = {
      {"LeftShoulder", Point::kClavicleL}, {"RightShoulder", Point::kClavicleR},
      {"LeftHand", Point::kWristL},        {"RightHand", Point::kWristR},
      {"LeftFoot", Point::kAnkleL},        {"RightFoot", Point::kAnkleR},
      {"LeftToe", Point::kBallL},          {"RightToe", Point::kBallR},
      {"LeftToe_end", Point::kToeL},       {"RightToe_end", Point::kToeR}};
  return points;
}

inline void ExpectPlaces(const std::map<std::string, Eigen::Vector3d>& places, const PoseRow& row) {
  for (const auto& [name, point] : BvhPoints()) {
    ASSERT_TRUE(places.contains(name)) << name;
    const Eigen::Vector3d cm = Cm(row.points_W.col(static_cast<int>(point)));
    EXPECT_LT((places.at(name) - cm).norm(), 0.01)
        << name << " is at " << places.at(name).transpose() << " cm, wanted " << cm.transpose();
  }
}

/// Hands and feet, by the segments of a body: also of one that does not turn them.
inline void ExpectHandsAndFeet(const std::map<std::string, Eigen::Vector3d>& places,
                               const BodyModel& body, const PoseState& pose) {
  const Posture posture = body.PostureAt(pose);
  for (const auto& [name, point] : FurtherBvhPoints()) {
    ASSERT_TRUE(places.contains(name)) << name;
    const int carrier = body.CarrierOf(point);
    const Vector3 p_W = (carrier < 0 ? posture.X_WT : posture.X_W[carrier]) *
                        body.reference_points_T().col(static_cast<int>(point));
    EXPECT_LT((places.at(name) - Cm(p_W)).norm(), 0.01) << name;
  }
}

}  // namespace mocap::testing
