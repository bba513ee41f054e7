#include "tools/solving/filtered_motion.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace mocap {
namespace {

// A longer time between two poses than this many usual ones is a gap.
constexpr double kGap = 1.5;

double UsualTime_s(std::span<const SolvedPose> poses) {
  std::vector<std::int64_t> between_ns;
  for (std::size_t i = 1; i < poses.size(); ++i)
    between_ns.push_back(poses[i].capture_ns - poses[i - 1].capture_ns);
  const auto middle = between_ns.begin() + static_cast<std::ptrdiff_t>(between_ns.size() / 2);
  std::ranges::nth_element(between_ns, middle);
  return static_cast<double>(*middle) * 1e-9;
}

// Filters one number of all poses.
void FilterNumber(std::span<SolvedPose> poses, const NamedFilter& filter, double rate_hz,
                  auto number) {
  std::vector<double> values;
  for (SolvedPose& pose : poses) values.push_back(number(pose.result.pose));
  values = ZeroLagButterworth(values, filter, rate_hz);
  for (std::size_t i = 0; i < poses.size(); ++i) number(poses[i].result.pose) = values[i];
}

// A rotation is filtered as a quaternion that keeps its sign from pose to pose.
void FilterRotations(std::span<SolvedPose> poses, const NamedFilter& filter, double rate_hz) {
  std::array<std::vector<double>, 4> parts;
  Eigen::Vector4d before = Eigen::Quaterniond(poses.front().result.pose.X_WT.R).coeffs();
  for (const SolvedPose& pose : poses) {
    Eigen::Vector4d now = Eigen::Quaterniond(pose.result.pose.X_WT.R).coeffs();
    if (now.dot(before) < 0) now = -now;
    for (int i = 0; i < 4; ++i) parts[i].push_back(now[i]);
    before = now;
  }
  for (std::vector<double>& part : parts) part = ZeroLagButterworth(part, filter, rate_hz);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Quaterniond q(parts[3][i], parts[0][i], parts[1][i], parts[2][i]);
    poses[i].result.pose.X_WT.R = q.normalized().toRotationMatrix();
  }
}

void FilterStretch(const BodyModel& body, const NamedFilter& filter, double rate_hz,
                   std::span<SolvedPose> poses) {
  FilterRotations(poses, filter, rate_hz);
  for (int axis = 0; axis < 3; ++axis)
    FilterNumber(poses, filter, rate_hz,
                 [axis](PoseState& pose) -> double& { return pose.X_WT.p[axis]; });
  for (int joint = 0; joint < body.joint_count(); ++joint)
    FilterNumber(poses, filter, rate_hz,
                 [joint](PoseState& pose) -> double& { return pose.theta[joint]; });
  for (SolvedPose& pose : poses) {
    const Posture posture = body.PostureAt(pose.result.pose);
    pose.result.points_W = body.PointsAt(posture);
    pose.result.further_W = body.FurtherPointsAt(posture);
  }
}

}  // namespace

void FilterMotion(const BodyModel& body, const NamedFilter& filter, std::span<SolvedPose> poses) {
  if (filter.is_none() || poses.size() < 2) return;
  const double usual_s = UsualTime_s(poses);
  if (usual_s <= 0) return;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= poses.size(); ++i) {
    const bool ends =
        i == poses.size() ||
        static_cast<double>(poses[i].capture_ns - poses[i - 1].capture_ns) > kGap * usual_s * 1e9;
    if (!ends) continue;
    FilterStretch(body, filter, 1 / usual_s, poses.subspan(begin, i - begin));
    begin = i;
  }
}

}  // namespace mocap
