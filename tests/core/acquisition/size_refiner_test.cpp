#include "core/acquisition/size_refiner.h"

#include <gtest/gtest.h>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "core/tracking/tracker.h"
#include "tests/support/seen_body.h"

namespace mocap {
namespace {

BodySizes SizesOf(double stature_mm, double build) {
  BodySizes sizes = AverageSizes(stature_mm);
  for (const SizeMember width : kStoutWidths) sizes.*width *= build;
  return sizes;
}

// Whose stature was taken for 50 mm less, by a body of the right build.
double StatureMeasured(double stature_mm, double build) {
  const BodyTable table = LoadBodyTable("full");
  const BodyModel person(table, SizesOf(stature_mm, build));
  const BodyModel found(table, SizesOf(stature_mm - 50, build));
  PoseState pose;
  pose.theta = AnglesOf({}, table);
  pose.X_WT.R.setIdentity();
  pose.X_WT.p =
      Vector3(0, 0, person.sizes().torso / 2 + person.sizes().thigh + person.sizes().calf);
  const RoundStudio studio;
  const Evidence evidence = studio.Show(person, pose);
  Tracker tracker(found, pose);
  tracker.Update(evidence, 0);
  for (int i = 0; i < 3; ++i) {
    SizeRefiner refiner(found);
    refiner.Add(tracker.body(), tracker.surface_fit(), tracker.filter().pose());
    tracker.Resize(refiner.Sizes());
    tracker.Draw();
  }
  return tracker.body().sizes().Stature();
}

TEST(SizeRefiner, WithoutFramesKeepsTheBodyThatWasFound) {
  const BodyModel body(LoadBodyTable("full"), SizesOf(1700, 1.3));
  EXPECT_NEAR(SizeRefiner(body).Sizes().Stature(), 1700, 1e-6);
  EXPECT_NEAR(SizeRefiner(body).Sizes().thigh_width, body.sizes().thigh_width, 1e-6);
}

TEST(SizeRefiner, MeasuresTheStatureOfWhoIsLeanAndOfWhoIsStout) {
  EXPECT_NEAR(StatureMeasured(1750, 1), 1750, 25);
  EXPECT_NEAR(StatureMeasured(1750, 1.4), 1750, 25);
}

}  // namespace
}  // namespace mocap
