#include "core/hypotheses/size_refiner.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/kernels/equations.h"

namespace mocap {
namespace {

struct RefinedSize {
  SizeMember size;
  double std_share;  // Standard deviation among people of a stature and build; 0: of a drape.
};

// Lengths differ among people of a stature by about three percent, and widths by more (ANSUR,
// Gordon et al. 1989). Clothes and hair add to that. The hips stay unchanged: they lie so deep in
// flesh that contours do not show them. The sizes of a drape come last: they are left out for a
// person without one.
constexpr std::array<RefinedSize, 19> kRefined = {{{&BodySizes::torso, 0.03},
                                                   {&BodySizes::torso_width, 0.12},
                                                   {&BodySizes::torso_depth, 0.15},
                                                   {&BodySizes::head, 0.1},
                                                   {&BodySizes::head_width, 0.15},
                                                   {&BodySizes::neck, 0.03},
                                                   {&BodySizes::upper_arm, 0.035},
                                                   {&BodySizes::lower_arm, 0.035},
                                                   {&BodySizes::thigh, 0.035},
                                                   {&BodySizes::calf, 0.035},
                                                   {&BodySizes::upper_arm_width, 0.2},
                                                   {&BodySizes::lower_arm_width, 0.2},
                                                   {&BodySizes::thigh_width, 0.2},
                                                   {&BodySizes::calf_width, 0.2},
                                                   {&BodySizes::shoulder_width, 0.08},
                                                   {&BodySizes::drape_hip, 0},
                                                   {&BodySizes::drape_knee, 0},
                                                   {&BodySizes::drape_calf, 0},
                                                   {&BodySizes::drape_ankle, 0}}};
// Standard deviations.
struct Uncertainty {
  double drape_mm = 50;
  double stature_share = 0.04;          // Of the body that was found.
  double pose_mm = 40, pose_rad = 0.2;  // Of the pose that it was found in.
};
constexpr Uncertainty kStd{};

constexpr int kMostSizes = static_cast<int>(kRefined.size());
constexpr int kMostUnknowns = kMaxDof + kMostSizes;
using Information =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostUnknowns, kMostUnknowns>;
using InformationVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostUnknowns, 1>;

std::span<const RefinedSize> RefinedOf(const BodySizes& start) {
  const std::size_t drape = start.IsDraped() ? 0 : kDrapeSizes.size();
  return std::span(kRefined).first(kRefined.size() - drape);
}

std::vector<SizeMember> MembersOf(std::span<const RefinedSize> refined) {
  std::vector<SizeMember> members;
  for (const RefinedSize& size : refined) members.push_back(size.size);
  return members;
}

// Returns the prior's information: the inverse of its covariance.
Information PriorOf(const BodySizes& start) {
  const int count = static_cast<int>(RefinedOf(start).size());
  const double stature_mm = start.Stature();
  const BodySizes usual = AverageSizes(stature_mm), taller = AverageSizes(stature_mm + 1);
  Information covariance = Information::Zero(count, count);
  const auto is_stout = [](int i) {
    return std::ranges::find(kStoutWidths, kRefined[i].size) != kStoutWidths.end();
  };
  const auto by_stature_mm = [&](int i) {
    const SizeMember size = kRefined[i].size;
    return kStd.stature_share * stature_mm * (taller.*size - usual.*size);
  };
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      const double both = i == j ? 1 : is_stout(i) && is_stout(j) ? kWidthCorrelation : 0;
      covariance(i, j) = both * kRefined[i].std_share * start.*kRefined[i].size *
                             kRefined[j].std_share * start.*kRefined[j].size +
                         by_stature_mm(i) * by_stature_mm(j);
    }
    if (kRefined[i].std_share == 0) covariance(i, i) = kStd.drape_mm * kStd.drape_mm;
  }
  return covariance.llt().solve(Information::Identity(count, count));
}

}  // namespace

SizeRefiner::SizeRefiner(const BodyModel& body)
    : start_(body.sizes()),
      count_(static_cast<int>(RefinedOf(start_).size())),
      by_size_(body, MembersOf(RefinedOf(start_))),
      prior_(PriorOf(start_)),
      information_(Eigen::MatrixXd::Zero(count_, count_)),
      vector_(Eigen::VectorXd::Zero(count_)) {}

void SizeRefiner::Add(const BodyModel& body, Objective& objective, const PoseState& pose,
                      double worth) {
  by_size_.Update(body, pose);
  const int pose_dof = body.dof();
  const int n = pose_dof + count_;
  Information H = Information::Zero(n, n);
  InformationVector g = InformationVector::Zero(n);
  InformationVector row(n);
  for (const SurfaceResidual& residual : objective.ResidualsAt(body, pose)) {
    if (residual.kind == ResidualKind::kSurface) continue;
    row.head(pose_dof) = residual.J_outside_by_step;
    for (int i = 0; i < count_; ++i)
      row[pose_dof + i] =
          by_size_.OutwardBySize(residual.capsule, residual.share, residual.normal_W, i);
    // A residual depends on one chain of joints and on few sizes: most of its row is zero.
    kernels::AddSquareBelow(row.data(), n, worth / residual.variance, H.data());
    g += row * (worth * residual.outside_mm / residual.variance);
  }
  H = Information(H.selfadjointView<Eigen::Lower>());
  for (int i = 0; i < pose_dof; ++i) {
    const double std = i < 3 ? kStd.pose_mm : kStd.pose_rad;
    H(i, i) += 1 / (std * std);
  }
  const Eigen::LLT<Information> pose_part(H.topLeftCorner(pose_dof, pose_dof));
  const Information by_pose = pose_part.solve(H.topRightCorner(pose_dof, count_));
  const Information information =
      H.bottomRightCorner(count_, count_) - H.bottomLeftCorner(count_, pose_dof) * by_pose;
  InformationVector away(count_);
  for (int i = 0; i < count_; ++i) {
    away[i] = body.sizes().*kRefined[i].size - start_.*kRefined[i].size;
  }
  information_ += information;
  vector_ += g.tail(count_) - by_pose.transpose() * g.head(pose_dof) + information * away;
  ++frames_;
}

BodySizes SizeRefiner::Sizes() const {
  const Information information = information_ + prior_;
  const InformationVector away = information.llt().solve(vector_);
  BodySizes sizes = start_;
  for (int i = 0; i < count_; ++i) sizes.*kRefined[i].size += away[i];
  for (const SizeMember drape : kDrapeSizes) sizes.*drape = std::max(0.0, sizes.*drape);
  sizes.hip_width = AverageSizes(sizes.Stature()).hip_width;
  return sizes;
}

}  // namespace mocap
