#include "core/objective/contact_term.h"

#include <gtest/gtest.h>

#include <utility>

#include "tests/support/fitted_body.h"
#include "tests/support/slopes.h"

namespace mocap {
namespace {

class ContactTermTest : public FittedBody {
 protected:
  ContactTermTest() { evidence_ = studio_.Show(body_, truth_); }

  static PosedBody Posed(const BodyModel& body, const PoseState& pose) {
    PosedBody posed;
    posed.Set(body, pose);
    return posed;
  }
  /// Compares the linearised term with its cost.
  void ExpectLinearised(int voxels, int rays, double share) {
    ExpectLinearised(pose_, voxels, rays, share);
  }
  void ExpectLinearised(const PoseState& pose, int voxels, int rays, double share) {
    ContactTerm term;
    term.SetEvidence(evidence_, voxels, rays, 0);
    const PoseStep gradient = GradientOf(
        body_, pose, [&](const PosedBody& posed, auto& sums) { term.Linearize(posed, {}, sums); });
    const PoseStep slope = SlopeOf(
        [&](const PoseState& at) {
          const ContactNats nats = term.At(Posed(body_, at), {});
          return nats.rays + nats.surface;
        },
        pose);
    ExpectOpposite(gradient, slope, share);
  }
  /// Drops rays that run along the part that explains them.
  void DropRaysAlongParts(const PoseState& pose) {
    ContactTerm term;
    term.SetEvidence(evidence_, 0, 1 << 20, 0);
    const PosedBody posed = Posed(body_, pose);
    std::vector<BoundingEdge> across;
    std::size_t i = 0;
    term.ForEach(posed, [&](const ContactTerm::Residual& residual, const Contact& contact) {
      const BoundingEdge& edge = evidence_.edges[i++];
      if (residual.capsule < 0) return;
      const PosedCapsule& part = posed.capsules()[residual.capsule];
      const Vector3 ray_W = (contact.to_W - contact.from_W).normalized();
      if (std::abs(ray_W.dot((part.b_W - part.a_W).normalized())) < 0.5) across.push_back(edge);
    });
    evidence_.edges = across;
  }

  const PoseState truth_ = Standing({.arm_l = kArmOut, .leg_r = kStep});
  const PoseState pose_ = Off(truth_, 0.5);
};

TEST_F(ContactTermTest, OfTheSurfaceDescendsWhatItCosts) { ExpectLinearised(250, 0, 1e-4); }

// Of 15 poses between 0.3 and 0.65 of the way off, eight agree to 1e-3, and the others to 0.015,
// with or without the rays at feet: the pose at 0.5 agrees to 0.002.
TEST_F(ContactTermTest, OfRaysAcrossPartsDescendsWhatItCosts) {
  for (const auto& [way, share] :
       {std::pair{0.45, 1e-3}, std::pair{0.5, 3e-3}, std::pair{0.6, 1e-3}, std::pair{0.65, 1e-3}}) {
    const PoseState pose = Off(truth_, way);
    evidence_ = studio_.Show(body_, truth_);
    DropRaysAlongParts(pose);
    ASSERT_GT(evidence_.edges.size(), 200u);
    ExpectLinearised(pose, 0, 600, share);
  }
}

// Where a ray runs along a part that tapers, its nearest place is found approximately.
TEST_F(ContactTermTest, OfAllRaysNearlyDescendsWhatItCosts) { ExpectLinearised(0, 600, 0.03); }

TEST_F(ContactTermTest, WeighsAsManyRaysAndVoxelsAsAreIndependent) {
  const auto at = [&](int voxels, int rays) {
    ContactTerm term;
    term.SetEvidence(evidence_, voxels, rays, 0);
    return term.At(Posed(body_, pose_), {});
  };
  const ContactNats few = at(125, 300), many = at(250, 600);
  EXPECT_LT(many.rays, 1.6 * few.rays) << "twice the rays are not twice the evidence";
  EXPECT_GT(many.rays, few.rays);
  EXPECT_NEAR(many.misfit, few.misfit, 0.15 * many.misfit) << "a mean";
}

TEST_F(ContactTermTest, TakesOnlyWhatTheRestDoesNotExplain) {
  ContactTerm whole, open;
  whole.SetEvidence(evidence_, 250, 600, 0);
  CapsuleSet arm = 0;
  for (int i = 0; i < std::ssize(body_.shape()); ++i)
    if (body_.shape()[i].part == BodyPart::kLowerArmL) arm |= CapsuleSet{1} << i;
  open.TakeOpen(whole, Posed(body_, truth_), arm, 0, {});
  EXPECT_LT(open.contacts().size(), whole.contacts().size() / 2);
  EXPECT_GT(open.contacts().size(), 10u);
  const double there = open.At(Posed(body_, truth_), {}).rays;
  const double elsewhere = open.At(Posed(body_, Standing({.leg_r = kStep})), {}).rays;
  EXPECT_LT(there + 10, elsewhere);
}

}  // namespace
}  // namespace mocap
