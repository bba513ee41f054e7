#include "tools/calibration/bundle.h"

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "tools/calibration/lens_parameters.h"

namespace mocap {
namespace {

constexpr double kUnseen_px = 1000;

using Pose = std::array<double, 6>;  ///< Rotation vector [rad] and translation [mm].

Pose PoseFrom(const RigidTransform& X) {
  const Vector3 w = LogRotation(X.R);
  return {w.x(), w.y(), w.z(), X.p.x(), X.p.y(), X.p.z()};
}

RigidTransform TransformFrom(const double* pose) {
  return {ExpRotation({pose[0], pose[1], pose[2]}), {pose[3], pose[4], pose[5]}};
}

// One view of the board; parameter blocks: lens, camera, board, lateness.
class ViewCost : public ceres::CostFunction {
 public:
  ViewCost(const Lens& lens, const Board& board, const BoardDetection& detection)
      : lens_(lens), detection_(detection), pixels_(detection.corners.pixels) {
    for (const int id : detection.corners.ids) points_B_.push_back(board.Corner(id));
    set_num_residuals(2 * static_cast<int>(pixels_.size()));
    *mutable_parameter_block_sizes() = {static_cast<int>(LensParameters(lens).size()), 6, 6, 1};
  }

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const Lens lens = WithParameters(lens_, blocks[0]);
    const RigidTransform X_CW = TransformFrom(blocks[1]), X_WB = TransformFrom(blocks[2]);
    const RigidTransform X_CB = X_CW * X_WB;
    Moves moves[2];
    if (jacobians != nullptr) {
      Differentiate(
          blocks[1], [&](const RigidTransform& X) { return X * X_WB; }, moves[0]);
      Differentiate(
          blocks[2], [&](const RigidTransform& X) { return X_CW * X; }, moves[1]);
      for (int b = 0; b < 4; ++b) {
        if (jacobians[b] != nullptr)
          std::fill_n(jacobians[b], num_residuals() * parameter_block_sizes()[b], 0.0);
      }
    }
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      const Vector3 p_C = X_CB * points_B_[i];
      const auto pixel = Project(lens, p_C);
      Eigen::Map<Vector2>(residuals + 2 * i) =
          pixel ? Vector2(*pixel - pixels_[i] + detection_.MovedSince(i, *blocks[3]))
                : Vector2::Constant(kUnseen_px).eval();
      if (jacobians == nullptr || !pixel) continue;
      if (jacobians[3] != nullptr && !detection_.motions.empty()) {
        const CornerMotion& m = detection_.motions[i];
        Eigen::Map<Vector2>(jacobians[3] + 2 * i) =
            m.velocity - m.acceleration * (detection_.late_s + *blocks[3]);
      }
      if (jacobians[0] != nullptr) LensColumns(blocks[0], p_C, i, jacobians[0]);
      for (int b = 0; b < 2; ++b) {
        if (jacobians[b + 1] != nullptr) PoseColumns(lens, p_C, moves[b], i, jacobians[b + 1]);
      }
    }
    return true;
  }

 private:
  /// Derivatives of X_CB by each parameter of a pose.
  struct Moves {
    Matrix3 dR[6];
    Vector3 dp[6];
  };

  static std::optional<Vector2> Project(const Lens& lens, const Vector3& p_C) {
    if (p_C.z() <= 1) return std::nullopt;
    return PixelFromNormalized(lens, p_C.head<2>() / p_C.z());
  }

  template <typename MakeTransform>
  static void Differentiate(const double* pose, const MakeTransform& make, Moves& moves) {
    for (int k = 0; k < 6; ++k) {
      const double h = k < 3 ? 1e-6 : 1e-3;
      Pose above, below;
      std::copy_n(pose, 6, above.begin());
      below = above;
      above[k] += h;
      below[k] -= h;
      const RigidTransform high = make(TransformFrom(above.data()));
      const RigidTransform low = make(TransformFrom(below.data()));
      moves.dR[k] = (high.R - low.R) / (2 * h);
      moves.dp[k] = (high.p - low.p) / (2 * h);
    }
  }

  void LensColumns(const double* parameters, const Vector3& p_C, std::size_t i,
                   double* jacobian) const {
    const int n = parameter_block_sizes()[0];
    std::vector<double> changed(parameters, parameters + n);
    for (int k = 0; k < n; ++k) {
      const double h = 1e-6 * std::max(1e-2, std::abs(parameters[k]));
      changed[k] = parameters[k] + h;
      const auto above = Project(WithParameters(lens_, changed.data()), p_C);
      changed[k] = parameters[k] - h;
      const auto below = Project(WithParameters(lens_, changed.data()), p_C);
      changed[k] = parameters[k];
      if (!above || !below) continue;
      const Vector2 slope = (*above - *below) / (2 * h);
      jacobian[2 * i * n + k] = slope.x();
      jacobian[(2 * i + 1) * n + k] = slope.y();
    }
  }

  void PoseColumns(const Lens& lens, const Vector3& p_C, const Moves& moves, std::size_t i,
                   double* jacobian) const {
    const double h = 1e-5 * p_C.z();
    Eigen::Matrix<double, 2, 3> J_pixel_by_p;
    for (int axis = 0; axis < 3; ++axis) {
      const auto above = Project(lens, p_C + h * Vector3::Unit(axis));
      const auto below = Project(lens, p_C - h * Vector3::Unit(axis));
      if (!above || !below) return;
      J_pixel_by_p.col(axis) = (*above - *below) / (2 * h);
    }
    for (int k = 0; k < 6; ++k) {
      const Vector2 slope = J_pixel_by_p * (moves.dR[k] * points_B_[i] + moves.dp[k]);
      jacobian[2 * i * 6 + k] = slope.x();
      jacobian[(2 * i + 1) * 6 + k] = slope.y();
    }
  }

  Lens lens_;
  BoardDetection detection_;
  std::vector<Vector3> points_B_;
  std::vector<Vector2> pixels_;
};

// Keeps parameters that views do not constrain at typical values: axes near the picture's middle,
// square pixels, little decentring. A few hundred corners outweigh it.
class LensPrior : public ceres::CostFunction {
 public:
  LensPrior(const CameraCalibration& camera) : lens_(camera.lens) {
    const auto n = static_cast<int>(LensParameters(lens_).size());
    middle_ = Vector2(camera.width_px - 1, camera.height_px - 1) / 2;
    sigma_center_px_ = kCenterSigma * camera.width_px;
    set_num_residuals(2 + n);
    *mutable_parameter_block_sizes() = {n};
  }

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const int n = parameter_block_sizes()[0];
    Eigen::Map<Eigen::VectorXd> r(residuals, num_residuals());
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(num_residuals(), n);
    r.setZero();
    const bool tsai = std::holds_alternative<TsaiLens>(lens_);
    const Eigen::Map<const Eigen::VectorXd> p(blocks[0], n);
    for (int axis = 0; axis < 2; ++axis) {
      r[axis] = (p[2 + axis] - middle_[axis]) / sigma_center_px_;
      J(axis, 2 + axis) = 1 / sigma_center_px_;
    }
    if (!tsai) {
      r[2] = (p[0] - p[1]) / (kAspectSigma * p[1]);
      J(2, 0) = 1 / (kAspectSigma * p[1]);
      J(2, 1) = -p[0] / (kAspectSigma * p[1] * p[1]);
      for (int k = 4; k < n; ++k) {
        const bool decentring = n == 9 && (k == 6 || k == 7);
        const double sigma = decentring ? kDecentringSigma : kRadialSigma;
        r[k - 1] = p[k] / sigma;
        J(k - 1, k) = 1 / sigma;
      }
    }
    r *= kNoise_px;
    if (jacobians != nullptr && jacobians[0] != nullptr)
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          jacobians[0], J.rows(), n) = kNoise_px * J;
    return true;
  }

 private:
  static constexpr double kCenterSigma = 0.05, kAspectSigma = 0.01;
  static constexpr double kDecentringSigma = 0.005, kRadialSigma = 0.5;
  static constexpr double kNoise_px = 0.3;

  Lens lens_;
  Vector2 middle_;
  double sigma_center_px_ = 0;
};

struct Blocks {
  std::vector<std::vector<double>> lenses;
  std::vector<Pose> cameras;
  std::vector<Pose> boards;
  std::vector<double> lateness_s;
};

void AddViews(const BoardDetections& detections, const BundleOptions& options, const Bundle& bundle,
              Blocks& blocks, ceres::Problem& problem) {
  for (const BoardDetection& detection : detections.detections) {
    if (!bundle.X_WB[detection.moment]) continue;
    const auto corners = static_cast<double>(detection.corners.ids.size());
    // The problem owns the loss; a whole view is in or out.
    ceres::LossFunction* loss = options.robust_px > 0
                                    ? new ceres::CauchyLoss(options.robust_px * std::sqrt(corners))
                                    : nullptr;
    problem.AddResidualBlock(
        new ViewCost(bundle.cameras[detection.camera].lens, detections.board, detection), loss,
        blocks.lenses[detection.camera].data(), blocks.cameras[detection.camera].data(),
        blocks.boards[detection.moment].data(), &blocks.lateness_s[detection.camera]);
  }
}

// A wand's roll is not observable; a weak prior keeps the equations regular.
void HoldRolls(Blocks& blocks, ceres::Problem& problem) {
  constexpr double kWeight = 0.01;
  for (Pose& wand : blocks.boards) {
    if (!problem.HasParameterBlock(wand.data())) continue;
    ceres::Matrix weights = ceres::Matrix::Zero(3, 6);
    weights.leftCols<3>() = kWeight * Matrix3::Identity();
    const Eigen::Map<const Eigen::Matrix<double, 6, 1>> now(wand.data());
    problem.AddResidualBlock(new ceres::NormalPrior(weights, now), nullptr, wand.data());
  }
}

void HoldConstant(const BundleOptions& options, Blocks& blocks, ceres::Problem& problem) {
  const auto hold = [&problem](double* block) {
    if (problem.HasParameterBlock(block)) problem.SetParameterBlockConstant(block);
  };
  for (std::vector<double>& lens : blocks.lenses) {
    if (!options.refine_lenses) hold(lens.data());
  }
  for (std::size_t c = 0; c < blocks.cameras.size(); ++c) {
    if (!options.refine_poses || c == 0) hold(blocks.cameras[c].data());
  }
  for (std::size_t c = 0; c < blocks.lateness_s.size(); ++c) {
    if (!options.refine_lateness || c == 0) hold(&blocks.lateness_s[c]);
  }
  for (Pose& board : blocks.boards) {
    if (!options.refine_boards) hold(board.data());
  }
}

}  // namespace

bool RefineBundle(const BoardDetections& detections, const BundleOptions& options, Bundle& bundle) {
  Blocks blocks;
  for (const CameraCalibration& camera : bundle.cameras) {
    blocks.lenses.push_back(LensParameters(camera.lens));
    blocks.cameras.push_back(PoseFrom(camera.X_CW));
  }
  for (const auto& X_WB : bundle.X_WB)
    blocks.boards.push_back(PoseFrom(X_WB.value_or(RigidTransform{})));
  blocks.lateness_s = bundle.lateness_s;
  blocks.lateness_s.resize(bundle.cameras.size(), 0);
  ceres::Problem problem;
  AddViews(detections, options, bundle, blocks, problem);
  if (problem.NumResidualBlocks() == 0) return false;
  if (detections.board.kind == BoardKind::kWand) HoldRolls(blocks, problem);
  for (std::size_t c = 0; options.refine_lenses && c < bundle.cameras.size(); ++c) {
    if (problem.HasParameterBlock(blocks.lenses[c].data()))
      problem.AddResidualBlock(new LensPrior(bundle.cameras[c]), nullptr, blocks.lenses[c].data());
  }
  HoldConstant(options, blocks, problem);
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_SCHUR;
  solver.max_num_iterations = options.most_steps;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  solver.function_tolerance = 1e-9;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  for (std::size_t c = 0; c < bundle.cameras.size(); ++c) {
    bundle.cameras[c].lens = WithParameters(bundle.cameras[c].lens, blocks.lenses[c].data());
    bundle.cameras[c].X_CW = TransformFrom(blocks.cameras[c].data());
  }
  for (std::size_t m = 0; m < bundle.X_WB.size(); ++m) {
    if (bundle.X_WB[m]) bundle.X_WB[m] = TransformFrom(blocks.boards[m].data());
  }
  bundle.lateness_s = blocks.lateness_s;
  return summary.IsSolutionUsable();
}

}  // namespace mocap
