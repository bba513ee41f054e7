#include "core/tracking/limb_search.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/tracking/flesh_rules.h"

namespace mocap {
namespace {

constexpr double kSearchedMm = 150;
// A contact this close to another part is no evidence for the limb.
constexpr double kTakenMm = 20;
constexpr double kNoiseMm = 40;
constexpr double kOutlierMm = 45;
constexpr double kStanceSpreadRad = 0.5;

// More axes than any limb has.
constexpr int kMostRows = 12;
using LimbVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostRows, 1>;
using LimbMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostRows, kMostRows>;

}  // namespace

void LimbSearch::ListRows(Segment limb_end, std::vector<int>& rows) const {
  const BodyTable& table = body_->table();
  const int trunk = table.carrier[static_cast<int>(Segment::kPelvis)];
  rows.clear();
  for (int i = table.carrier[static_cast<int>(limb_end)]; i >= 0 && i != trunk;
       i = table.joints[i].parent) {
    rows.push_back(i);
  }
  std::ranges::reverse(rows);
}

void LimbSearch::Begin(const BodyModel& body, const Evidence& evidence, ContactMatcher& contacts,
                       Segment limb_end, Segment absent, const PoseState& pose, Things things) {
  body_ = &body;
  cloud_ = &evidence.cloud;
  hollow_weight_ = HollowWeight(evidence.MissingShare());
  surface_W_ = &contacts.surface_W();
  ListRows(limb_end, rows_);
  ListRows(absent, absent_rows_);
  TakeBodyApart(pose);
  OpenContacts(contacts, things);
}

void LimbSearch::TakeBodyApart(const PoseState& pose) {
  const auto holds = [](const std::vector<int>& rows, int row) {
    return std::ranges::find(rows, row) != rows.end();
  };
  posture_ = body_->PostureAt(pose);
  body_->PoseShape(posture_, all_);
  const std::vector<Capsule>& shape = body_->shape();
  capsules_.clear();
  other_capsules_.clear();
  others_.clear();
  for (int i = 0; i < std::ssize(all_); ++i) {
    if (holds(rows_, shape[i].carrier)) {
      capsules_.push_back(i);
    } else if (!holds(absent_rows_, shape[i].carrier)) {
      other_capsules_.push_back(i);
      others_.push_back(all_[i]);
    }
  }
  overlapping_.clear();
  for (int i = 0; i < std::ssize(capsules_); ++i) {
    for (int j = 0; j < std::ssize(others_); ++j) {
      if (MayOverlap(shape[capsules_[i]].part, shape[other_capsules_[j]].part))
        overlapping_.push_back({i, j});
    }
  }
}

void LimbSearch::OpenContacts(ContactMatcher& contacts, Things things) {
  const auto edges = std::ranges::count_if(contacts.contacts(), &Contact::is_edge);
  const double edge_weight = 1.0 / static_cast<double>(std::max<std::ptrdiff_t>(1, edges));
  const double voxel_weight = kSurfaceWeight / std::max(1, surface_W_->size());
  const std::vector<float>& others_mm = contacts.Distances(others_, kSearchedMm);
  std::optional<ThingPlaces> places;
  if (things.any()) places.emplace(*body_, posture_, things);
  contacts_.clear();
  terms_.clear();
  for (std::size_t i = 0; i < others_mm.size(); ++i) {
    if (others_mm[i] < kTakenMm) continue;
    const Contact& contact = contacts.contacts()[i];
    double other_mm = others_mm[i];
    if (places && other_mm > kOfThingMm && places->At(contact)) other_mm = kOfThingMm;
    contacts_.push_back(contact);
    terms_.push_back({other_mm, contact.is_edge ? edge_weight : voxel_weight});
  }
  open_.SetContacts(contacts_);
}

void LimbSearch::PoseLimb(const PoseState& pose) {
  body_->MoveAxes(pose, rows_, posture_);
  posed_.clear();
  for (const int i : capsules_) {
    const Capsule& capsule = body_->shape()[i];
    posed_.emplace_back(capsule, posture_.X_W[capsule.carrier]);
  }
}

double LimbSearch::OverlapCost() const {
  double depth_mm = 0;
  for (const Pair& pair : overlapping_) {
    const PosedCapsule& limb = posed_[pair.capsule];
    const PosedCapsule& other = others_[pair.other];
    for (const double share : kCoreShares) {
      const Vector3 p_W = CorePlace(limb, share);
      if (CanStickIn(limb, p_W, other))
        depth_mm += std::max(0.0, OverlapDepth(limb, other, other.DistanceTo(p_W)));
    }
  }
  return depth_mm;
}

const LimbClaim& LimbSearch::ClaimAt(const PoseState& pose) {
  PoseLimb(pose);
  const std::vector<float>& distances_mm = open_.Distances(posed_, kSearchedMm);
  claim_.distances_mm.clear();
  for (std::size_t i = 0; i < distances_mm.size(); ++i) {
    claim_.distances_mm.push_back(std::min<double>(terms_[i].other_mm, distances_mm[i]));
  }
  double hollow_mm = 0;
  const std::uint32_t carved_away = open_.CarvedAway();
  for (std::size_t i = 0; i < posed_.size(); ++i) {
    if (carved_away >> i & 1) continue;
    for (const double share : kCoreShares) {
      const auto way_W = WayToFlesh(*cloud_, *surface_W_, CorePlace(posed_[i], share));
      if (way_W) hollow_mm += std::min(kMostHollowMm, way_W->norm());
    }
  }
  const double places = static_cast<double>(body_->shape().size() * kCoreShares.size());
  claim_.own_cost_mm = (hollow_weight_ * hollow_mm + OverlapCost()) / places;
  return claim_;
}

double LimbSearch::CostAt(const PoseState& pose) {
  const LimbClaim& claim = ClaimAt(pose);
  double cost_mm = claim.own_cost_mm;
  for (std::size_t i = 0; i < terms_.size(); ++i)
    cost_mm += terms_[i].weight * claim.distances_mm[i];
  return cost_mm;
}

double LimbSearch::JointCost(const LimbClaim& limb, const LimbClaim& other) const {
  double cost_mm = limb.own_cost_mm + other.own_cost_mm;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    cost_mm += terms_[i].weight * std::min(limb.distances_mm[i], other.distances_mm[i]);
  }
  return cost_mm;
}

Vector3 LimbSearch::TipAt(const PoseState& pose) {
  PoseLimb(pose);
  return posed_.back().b_W;
}

void LimbSearch::Refine(PoseState& pose, int iterations) {
  const int n = static_cast<int>(rows_.size());
  LimbVector start(n);
  for (int i = 0; i < n; ++i) start[i] = pose.theta[rows_[i]];
  LimbVector J(n);
  for (int iteration = 0; iteration < iterations; ++iteration) {
    PoseLimb(pose);
    LimbMatrix information = LimbMatrix::Zero(n, n);
    LimbVector gradient = LimbVector::Zero(n);
    const std::vector<ContactMatch>& matches = open_.Match(posed_, kSearchedMm);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const ContactMatch& match = matches[i];
      if (match.capsule < 0 || std::abs(match.distance.outside_mm) > terms_[i].other_mm) continue;
      const Vector3 offset = match.distance.segment_W - match.distance.core_W;
      if (offset.norm() < 1) continue;
      const Vector3 normal_W = offset.normalized();
      const int carrier = body_->shape()[capsules_[match.capsule]].carrier;
      J.setZero();
      for (int row = 0; row < n; ++row) {
        if (rows_[row] > carrier) continue;
        const Vector3 arm_W = match.distance.core_W - posture_.point_W[rows_[row]];
        J[row] = posture_.axis_W[rows_[row]].dot(arm_W.cross(normal_W));
      }
      const double scaled = match.distance.outside_mm / kOutlierMm;
      const double weight =
          1 / (kNoiseMm * kNoiseMm * (1 + scaled * scaled) * (1 + scaled * scaled));
      for (int row = 0; row < n; ++row) {
        const double weighted = weight * J[row];
        for (int column = 0; column <= row; ++column)
          information(row, column) += weighted * J[column];
      }
      gradient += weight * match.distance.outside_mm * J;
    }
    for (int i = 0; i < n; ++i) {
      const double inverse_variance = 1 / (kStanceSpreadRad * kStanceSpreadRad);
      information(i, i) += inverse_variance;
      gradient[i] -= inverse_variance * (pose.theta[rows_[i]] - start[i]);
    }
    const LimbVector step = information.llt().solve(gradient);
    for (int i = 0; i < n; ++i) {
      const JointAxis& joint = body_->table().joints[rows_[i]];
      double& angle = pose.theta[rows_[i]];
      angle = std::clamp(angle + std::clamp(step[i], -0.6, 0.6), joint.min_rad, joint.max_rad);
    }
  }
}

}  // namespace mocap
