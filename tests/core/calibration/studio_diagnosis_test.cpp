#include "core/calibration/studio_diagnosis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <span>

#include "core/calibration/diagnosis_text.h"
#include "tests/support/walking_moments.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using testing::ExchangePictures;
using ::testing::HasSubstr;
using testing::WalkingMoments;

const std::vector<CameraCalibration>& Cameras() { return testing::WalkCameras(); }

StudioDiagnosis DiagnosisOf(const std::vector<SeenMoment>& moments) {
  return Diagnose(Cameras(), moments);
}

std::string TextOf(const std::vector<SeenMoment>& moments) {
  const auto finding = FindingOf(DiagnosisOf(moments), Cameras());
  return finding ? finding->text : "none";
}

/// Changes the pose by which one camera sees the walk.
template <typename Change>
std::vector<SeenMoment> WithPose(std::size_t camera, Change change) {
  std::vector<SeenMoment> moments = WalkingMoments();
  for (SeenMoment& moment : moments) change(moment[camera]->X_CW);
  return moments;
}

/// The calibration in another frame or unit.
template <typename Change>
std::vector<SeenMoment> WithPoses(Change change) {
  std::vector<SeenMoment> moments = WalkingMoments();
  for (SeenMoment& moment : moments)
    for (auto& shape : moment) change(shape->X_CW);
  return moments;
}

TEST(StudioDiagnosis, FindsNothingWrongWithARightCalibration) {
  const StudioDiagnosis diagnosis = DiagnosisOf(WalkingMoments());
  EXPECT_EQ(diagnosis.fault, StudioFault::kNone);
  for (const PairAgreement& pair : diagnosis.pairs) EXPECT_GT(pair.views.overlap, 0.95);
  EXPECT_NEAR(diagnosis.person.lowest_mm, 0, 50);
  EXPECT_NEAR(diagnosis.person.highest_mm, testing::kWalkerStature_mm, 80);
}

TEST(StudioDiagnosis, NamesAnyTwoCamerasThatAreExchanged) {
  for (std::size_t a = 0; a < Cameras().size(); ++a) {
    for (std::size_t b = a + 1; b < Cameras().size(); ++b) {
      std::vector<SeenMoment> moments = WalkingMoments();
      ExchangePictures(a, b, moments);
      const StudioDiagnosis diagnosis = DiagnosisOf(moments);
      EXPECT_EQ(diagnosis.fault, StudioFault::kExchanged) << a << ' ' << b;
      EXPECT_THAT(diagnosis.cameras, ElementsAre(a, b));
    }
  }
}

TEST(StudioDiagnosis, NamesTheCameraThatWasTurned) {
  const Matrix3 turn = ExpRotation(5 * std::numbers::pi / 180 * Vector3(0.5, -1, 0.2).normalized());
  for (std::size_t camera = 0; camera < Cameras().size(); ++camera) {
    const StudioDiagnosis diagnosis = DiagnosisOf(WithPose(camera, [&](RigidTransform& X_CW) {
      X_CW = {turn * X_CW.R, turn * X_CW.p};
    }));
    EXPECT_EQ(diagnosis.fault, StudioFault::kSomeDisagree);
    EXPECT_THAT(diagnosis.cameras, ElementsAre(camera));
  }
}

TEST(StudioDiagnosis, NamesTheCameraWhosePictureIsUpsideDownOrMirrored) {
  for (const bool is_upside_down : {true, false}) {
    std::vector<SeenMoment> moments = WalkingMoments();
    for (SeenMoment& moment : moments) {
      for (Vector2& corner : moment[2]->rim_px) {
        corner.x() = Cameras()[2].width_px - 1 - corner.x();
        if (is_upside_down) corner.y() = Cameras()[2].height_px - 1 - corner.y();
      }
    }
    const StudioDiagnosis diagnosis = DiagnosisOf(moments);
    EXPECT_EQ(diagnosis.fault, is_upside_down ? StudioFault::kUpsideDown : StudioFault::kMirrored);
    EXPECT_THAT(diagnosis.cameras, ElementsAre(2));
  }
}

TEST(StudioDiagnosis, GuessesNoExchangeWhereNoneHelps) {
  std::vector<SeenMoment> moments = WalkingMoments();
  ExchangePictures(0, 1, moments);
  ExchangePictures(2, 4, moments);
  const StudioFault fault = DiagnosisOf(moments).fault;
  EXPECT_TRUE(fault == StudioFault::kSomeDisagree || fault == StudioFault::kNoneAgree);
}

TEST(StudioDiagnosis, NamesTheUnitOfTheCalibration) {
  const std::pair<double, const char*> units[] = {
      {1000, "metres"}, {304.8, "feet"}, {25.4, "inches"}, {10, "centimetres"}};
  for (const auto& [mm, name] : units) {
    const std::vector<SeenMoment> moments =
        WithPoses([mm = mm](RigidTransform& X_CW) { X_CW.p /= mm; });
    EXPECT_EQ(DiagnosisOf(moments).unit_mm, mm);
    EXPECT_THAT(TextOf(moments), AllOf(HasSubstr(name), HasSubstr("expected millimetres")));
  }
}

TEST(StudioDiagnosis, TellsAFloorThatIsUpsideDownOrElsewhere) {
  const RigidTransform over{ExpRotation({std::numbers::pi, 0, 0}), Vector3::Zero()};
  EXPECT_THAT(TextOf(WithPoses([&](RigidTransform& X_CW) { X_CW = X_CW * over; })),
              HasSubstr("z points down"));
  const RigidTransform raised{Matrix3::Identity(), {0, 0, -400}};
  const std::vector<SeenMoment> moments =
      WithPoses([&](RigidTransform& X_CW) { X_CW = X_CW * raised; });
  EXPECT_NEAR(DiagnosisOf(moments).person.lowest_mm, 400, 50);
  EXPECT_THAT(TextOf(moments), HasSubstr("not on the floor"));
}

TEST(StudioDiagnosis, AFloorThatIsTooHighIsDoubtedAsMuchAsOneThatIsTooLow) {
  const auto severity_at = [](double z_mm) {
    const RigidTransform moved{Matrix3::Identity(), {0, 0, -z_mm}};
    const auto finding = FindingOf(
        DiagnosisOf(WithPoses([&](RigidTransform& X_CW) { X_CW = X_CW * moved; })), Cameras());
    return finding ? finding->severity : Severity::kNote;
  };
  for (const int side : {-1, 1}) {
    EXPECT_EQ(severity_at(side * 50), Severity::kNote) << side;
    EXPECT_EQ(severity_at(side * 150), Severity::kWarning) << side;
    EXPECT_EQ(severity_at(side * 200), Severity::kWarning) << side;
    EXPECT_EQ(severity_at(side * 400), Severity::kWrong) << side;
  }
}

TEST(StudioDiagnosis, CamerasThatSeeFewerOfSeveralPeopleAreNotBlamed) {
  // Somebody else stands where only the first three cameras see him.
  std::vector<SeenMoment> moments = WalkingMoments();
  for (SeenMoment& moment : moments) {
    for (std::size_t c = 0; c < 3; ++c) {
      const RigidTransform& X_CW = moment[c]->X_CW;
      for (const double z_mm : {0.0, 1900.0}) {
        const Vector3 p_C = X_CW * Vector3(700, 700, z_mm);
        moment[c]->rim_px.push_back(
            *PixelFromNormalized(Cameras()[c].lens, p_C.head<2>() / p_C.z()));
      }
    }
  }
  EXPECT_EQ(TextOf(moments), "none");
}

TEST(StudioDiagnosis, OfTwoCamerasNoneIsBlamed) {
  std::vector<SeenMoment> moments = WalkingMoments();
  for (SeenMoment& moment : moments) {
    moment.resize(2);
    for (Vector2& corner : moment[0]->rim_px) corner.y() = 239 - corner.y();
  }
  const StudioDiagnosis diagnosis = Diagnose(std::span(Cameras()).first(2), moments);
  EXPECT_EQ(diagnosis.fault, StudioFault::kNoneAgree);
}

TEST(StudioDiagnosis, SpecksHaveNoStature) {
  std::vector<SeenMoment> moments = WalkingMoments();
  for (std::size_t m = 3; m < moments.size(); ++m) {
    for (auto& shape : moments[m]) {
      const Vector2 corner = shape->rim_px.front();
      shape->rim_px = {corner, corner + Vector2(0, 5), corner + Vector2(5, 0)};
      shape->height_share = 0.02;
    }
  }
  EXPECT_EQ(DiagnosisOf(moments).fault, StudioFault::kNone);
  EXPECT_EQ(DiagnosisOf(moments).person.moments, 3);
}

TEST(StudioDiagnosis, ATurningHeadDoesNotMakeFurnitureWalk) {
  std::vector<SeenMoment> still(5, WalkingMoments()[0]);
  for (std::size_t m = 0; m < still.size(); ++m) {
    const Matrix3 turn = ExpRotation({0, 0.03 * static_cast<double>(m), 0});
    for (std::size_t c = 0; c < Cameras().size(); ++c) {
      SeenShape& shape = *still[m][c];
      const Matrix3 before = shape.X_CW.R;
      shape.X_CW = {turn * shape.X_CW.R, turn * shape.X_CW.p};
      for (Vector2& corner : shape.rim_px) {
        const Vector3 ray_C = shape.X_CW.R * before.transpose() *
                              NormalizedFromPixel(Cameras()[c].lens, corner)->homogeneous();
        corner = *PixelFromNormalized(Cameras()[c].lens, ray_C.head<2>() / ray_C.z());
      }
    }
  }
  EXPECT_FALSE(Moves(Cameras(), still));
}

TEST(StudioDiagnosis, SaysNothingOfTooFewMomentsOrOneCamera) {
  std::vector<SeenMoment> moments = WalkingMoments();
  ExchangePictures(1, 4, moments);
  moments.resize(2);
  EXPECT_EQ(TextOf(moments), "none");
  std::vector<SeenMoment> alone = WalkingMoments();
  for (SeenMoment& moment : alone)
    for (std::size_t c = 1; c < moment.size(); ++c) moment[c].reset();
  EXPECT_EQ(TextOf(alone), "none");
  EXPECT_EQ(TextOf({}), "none");
}

TEST(StudioDiagnosis, TellsPeopleFromSmallThingsAndFromThingsAtRest) {
  std::vector<SeenMoment> moments = WalkingMoments();
  EXPECT_TRUE(ShowsPerson(moments[0]));
  EXPECT_TRUE(Moves(Cameras(), moments));
  EXPECT_FALSE(Moves(Cameras(), std::vector<SeenMoment>(5, moments[0])));
  for (std::size_t c = 0; c < 3; ++c) moments[0][c]->height_share = 0.05;
  EXPECT_FALSE(ShowsPerson(moments[0])) << "half of the cameras are not most";
}

}  // namespace
}  // namespace mocap
