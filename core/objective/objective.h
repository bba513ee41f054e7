// What the tracker maximises: the probability of a body at a pose, given a frame's evidence.
#pragma once

#include <array>
#include <numeric>
#include <string_view>

#include "core/objective/border_term.h"
#include "core/objective/contact_term.h"
#include "core/objective/flesh_term.h"
#include "core/objective/floor_term.h"
#include "core/objective/keypoint_term.h"
#include "core/objective/overlap_term.h"
#include "core/objective/pose_priors.h"

namespace mocap {

/// The terms of the objective.
enum class Term {
  kRays,
  kSurface,
  kBorders,
  kFlesh,
  kOverlap,
  kFloor,
  kThings,
  kJoints,
  kHabits,
  kKeypoints
};
inline constexpr std::array<std::string_view, 10> kTermNames = {
    "rays",  "surface", "borders", "flesh",  "overlap",
    "floor", "things",  "joints",  "habits", "keypoints"};

/// -log p of a body at a pose.
struct Fitness {
  std::array<double, kTermNames.size()> nats{};
  Things things;                 ///< Those that the evidence shows.
  double unexplained_share = 0;  ///< Of the rays: no part is near.
  double surface_mm = 0;         ///< Mean distance of the voxels' surface.
  double misfit = 0;             ///< 0 to 1; see ContactNats.
  /// How far the trunk is turned against the feet: 0 to 1, the opposite way.
  double backwards = 0;

  /// Whether this may be a person who was just found; whether a tracked one is lost.
  bool IsCredible() const;
  bool IsLost() const;
  double& operator[](Term term) { return nats[static_cast<std::size_t>(term)]; }
  double operator[](Term term) const { return nats[static_cast<std::size_t>(term)]; }
  double Sum() const { return std::accumulate(nats.begin(), nats.end(), 0.0); }
};

/// What a residual comes from: a voxel of the surface, a ray that grazes the person, or flesh
/// beyond a silhouette's border.
enum class ResidualKind { kSurface, kRay, kBorder };

/// A residual of the surface, linearised.
struct SurfaceResidual {
  ResidualKind kind;
  int capsule;   ///< Index into the body's shape().
  double share;  ///< Position along its core.
  Vector3
      normal_W;  ///< Out of the surface; where the capsule tapers it leans and is longer than 1.
  double outside_mm;
  double variance;             ///< [mm²], larger for outliers.
  PoseStep J_outside_by_step;  ///< Derivative of the core's position along the normal.
};

/// How closely an objective looks.
struct ObjectiveOptions {
  int voxels = 250;        ///< Surface voxels, spread evenly.
  int rays = 600;          ///< Rays, likewise.
  double pose_std_mm = 0;  ///< How far the poses may be off that are compared.
};

/// What is compared with a frame: a body, or some of its capsules.
struct ComparedBody {
  PosedBody posed;
  ContactTerm contacts;                 ///< Those that are looked at.
  CapsuleSet moving = ~CapsuleSet{0};   ///< Capsules that are compared.
  CapsuleSet present = ~CapsuleSet{0};  ///< Those that they may run into.
};

/// -log p of bodies at poses. Filter, searches and comparisons all use it. Reuses its memory.
class Objective {
 public:
  explicit Objective(const ObjectiveOptions& options = {}) : options_(options) {}

  /// Sets a frame; `evidence` is borrowed until the next call.
  void SetEvidence(const Evidence& evidence);
  const Evidence& evidence() const { return *evidence_; }

  /// @param things  what the body may wear or carry.
  Fitness At(const BodyModel& body, const PoseState& pose, const Things& things);
  /// Adds the linearised terms at a pose; for PoseFilter::Update.
  void Linearize(const BodyModel& body, const PoseState& pose, const Things& things,
                 UpdateEquations& equations);

  /// The same for a part of a body.
  Fitness At(ComparedBody& part, const Things& things);
  void Linearize(ComparedBody& part, const Things& things, UpdateEquations& equations);

  /// Returns the residuals of contacts and borders at a pose, without those that no part is near;
  /// valid until the next call.
  const std::vector<SurfaceResidual>& ResidualsAt(const BodyModel& body, const PoseState& pose);

  ContactTerm& contacts() { return whole_.contacts; }
  const BorderTerm& borders() const { return borders_; }
  const FleshTerm& flesh() const { return flesh_; }
  /// Evaluations so far, as multiples of one with all contacts.
  double evaluations() const { return evaluations_; }
  /// Counts all evaluations of another objective.
  void CountAll(const Objective& other) { evaluations_ += other.evaluations_; }

 private:
  void Count(const ContactTerm& contacts);

  ObjectiveOptions options_;
  const Evidence* evidence_ = nullptr;
  BorderTerm borders_;
  FleshTerm flesh_;
  FloorTerm floor_{options_.pose_std_mm};
  KeypointTerm keypoints_;
  ComparedBody whole_;
  ChainEquations chain_;
  std::vector<SurfaceResidual> residuals_;
  double evaluations_ = 0;
};

}  // namespace mocap
