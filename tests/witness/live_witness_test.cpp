#include "tools/witness/live_witness.h"

#include <gtest/gtest.h>

#include <limits>
#include <mocap/keypoints_t.hpp>
#include <mocap/person_details_t.hpp>
#include <vector>

#include "drivers/pixels/jpeg_encoder.h"
#include "tests/support/temporary_folder.h"
#include "tests/witness/onnx_bytes.h"

namespace mocap {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// A witness with a network that finds red pixels, and whoever is on its address.
class LiveWitnessTest : public ::testing::Test {
 protected:
  LiveWitnessTest() {
    lcm_.subscribe("MOCAP_KEYPOINTS", &LiveWitnessTest::OnKeypoints, this);
    lcm_.subscribe("MOCAP_LOOK_REQUEST", &LiveWitnessTest::OnRequest, this);
  }

  static PoseNetwork RedNetwork() {
    const testing::TemporaryFolder folder;
    const std::filesystem::path model = folder.path() / "tiny.onnx";
    testing::WriteText(model, testing::ColorMapNetwork());
    testing::WriteText(DescriptionBeside(model), testing::kColorMapDescription);
    return PoseNetwork(model);
  }
  /// A picture of 32 x 32 with a red pixel at (20, 12), cut out at (100, 50) and reduced by 2.
  static look_t LookAt(int person, std::int64_t capture_ns) {
    Image<Bgr> picture(32, 32, {40, 40, 40});
    picture(20, 12) = {0, 0, 255};
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(picture.pixels().data());
    look_t look{};
    look.capture_ns = capture_ns;
    look.camera = "cam2";
    look.person = person;
    look.left_px = 100;
    look.top_px = 50;
    look.side_px = 64;
    look.reduction = 2;
    look.up[1] = -1;
    look.width_px = 32;
    look.encoding = look_t::BGR;
    look.picture.assign(bytes, bytes + 3 * 32 * 32);
    look.num_bytes = static_cast<std::int32_t>(look.picture.size());
    return look;
  }
  void Hand(const look_t& look) { lcm_.publish("MOCAP_LOOK", &look); }
  void HandDoubt(double probability) {
    person_details_t details{};
    details.person = 3;
    details.probability = probability;
    lcm_.publish("MOCAP_DETAILS", &details);
  }
  /// Handles what came, lets the witness work, and handles what it sent.
  void WorkAt(LiveWitness& witness, double s) {
    HandleAll();
    witness.Work(1'000 * kSecond_ns + static_cast<std::int64_t>(s * 1e9));
    HandleAll();
  }
  void HandleAll() {
    while (lcm_.handleTimeout(0) > 0) continue;
  }
  void OnKeypoints(const lcm::ReceiveBuffer*, const std::string&, const keypoints_t* keypoints) {
    sent_.push_back(*keypoints);
  }
  void OnRequest(const lcm::ReceiveBuffer*, const std::string&, const look_request_t* request) {
    requests_.push_back(*request);
  }

  lcm::LCM lcm_{"memq://"};
  PoseNetwork network_ = RedNetwork();
  std::vector<keypoints_t> sent_;
  std::vector<look_request_t> requests_;
};

TEST_F(LiveWitnessTest, AsksForPicturesUntilItEnds) {
  LiveWitness witness(lcm_, {.url = "memq://", .rate_hz = 3}, network_);
  WorkAt(witness, 0);
  WorkAt(witness, 0.5);
  ASSERT_EQ(requests_.size(), 1u);
  EXPECT_EQ(requests_[0].asker, "mocap witness");
  EXPECT_EQ(requests_[0].rate_hz, 3);
  EXPECT_EQ(requests_[0].person, 0);
  EXPECT_EQ(requests_[0].side_px, 64);
  for (int s = 1; s < 5; ++s) WorkAt(witness, s);
  EXPECT_EQ(requests_.size(), 5u);
  EXPECT_GT(requests_[0].hold_s, 1);
  witness.End();
  HandleAll();
  EXPECT_EQ(requests_.back().rate_hz, 0);
}

TEST_F(LiveWitnessTest, SendsPointsInPixelsOfTheCamera) {
  LiveWitness witness(lcm_, {.url = "memq://"}, network_);
  WorkAt(witness, 0);
  Hand(LookAt(3, 77 * kSecond_ns));
  WorkAt(witness, 0.1);
  ASSERT_EQ(sent_.size(), 1u);
  EXPECT_EQ(sent_[0].version, keypoints_t::VERSION);
  EXPECT_EQ(sent_[0].sender, "mocap witness");
  EXPECT_EQ(sent_[0].camera, "cam2");
  EXPECT_EQ(sent_[0].capture_ns, 77 * kSecond_ns);
  EXPECT_EQ(sent_[0].person, 3);
  ASSERT_GE(sent_[0].points.size(), 1u);
  EXPECT_EQ(sent_[0].points[0].name, "nose");
  EXPECT_NEAR(sent_[0].points[0].x_px, 100 + 2 * 20.5 - 0.5, 1.5);
  EXPECT_NEAR(sent_[0].points[0].y_px, 50 + 2 * 12.5 - 0.5, 1.5);
}

TEST_F(LiveWitnessTest, ReadsJpegToo) {
  LiveWitness witness(lcm_, {.url = "memq://"}, network_);
  WorkAt(witness, 0);
  Image<Bgr> picture(32, 32, {40, 40, 40});
  for (int y = 8; y < 16; ++y)
    for (int x = 16; x < 24; ++x) picture(x, y) = {0, 0, 255};
  look_t look = LookAt(3, kSecond_ns);
  look.encoding = look_t::JPEG;
  JpegEncoder().Encode(picture.view(), 90, look.picture);
  look.num_bytes = static_cast<std::int32_t>(look.picture.size());
  Hand(look);
  WorkAt(witness, 0.1);
  ASSERT_EQ(sent_.size(), 1u);
  EXPECT_NEAR(sent_[0].points[0].x_px, 139.5, 10);
  EXPECT_NEAR(sent_[0].points[0].y_px, 73.5, 10);
}

TEST_F(LiveWitnessTest, LooksAtTheNewestPictureOfEachPersonOnce) {
  LiveWitness witness(lcm_, {.url = "memq://"}, network_);
  WorkAt(witness, 0);
  for (const int person : {3, 4}) Hand(LookAt(person, kSecond_ns));
  for (const int person : {3, 4}) Hand(LookAt(person, 2 * kSecond_ns));
  for (const double s : {0.1, 0.2, 0.3}) WorkAt(witness, s);
  ASSERT_EQ(sent_.size(), 2u);
  for (const keypoints_t& keypoints : sent_) EXPECT_EQ(keypoints.capture_ns, 2 * kSecond_ns);
  EXPECT_NE(sent_[0].person, sent_[1].person);
  EXPECT_EQ(witness.people(), 2u);
}

TEST_F(LiveWitnessTest, WhatIsLateIsNotLookedAtAndWhoIsGoneIsForgotten) {
  LiveWitness witness(lcm_, {.url = "memq://"}, network_);
  WorkAt(witness, 0);
  Hand(LookAt(3, kSecond_ns));
  WorkAt(witness, 1);
  EXPECT_TRUE(sent_.empty());
  EXPECT_EQ(witness.people(), 1u);
  WorkAt(witness, 4);
  EXPECT_EQ(witness.people(), 0u);
}

TEST_F(LiveWitnessTest, LooksTwiceAsOftenWhileSomebodyIsInDoubt) {
  LiveWitness witness(lcm_, {.url = "memq://", .rate_hz = 3}, network_);
  HandDoubt(0.99);
  HandDoubt(std::numeric_limits<double>::quiet_NaN());
  WorkAt(witness, 0);
  EXPECT_EQ(requests_.back().rate_hz, 3);
  HandDoubt(0.5);
  WorkAt(witness, 1);
  EXPECT_EQ(requests_.back().rate_hz, 6);
  WorkAt(witness, 2);
  EXPECT_EQ(requests_.back().rate_hz, 3);
}

TEST_F(LiveWitnessTest, WhatIsNoPictureIsCounted) {
  LiveWitness witness(lcm_, {.url = "memq://"}, network_);
  WorkAt(witness, 0);
  look_t look = LookAt(3, kSecond_ns);
  look.width_px = 40;  // More than its bytes.
  Hand(look);
  WorkAt(witness, 0.1);
  look = LookAt(3, kSecond_ns);
  look.up[0] = std::numeric_limits<double>::quiet_NaN();
  Hand(look);
  WorkAt(witness, 0.2);
  look = LookAt(3, kSecond_ns);
  look.encoding = look_t::JPEG;
  Hand(look);
  WorkAt(witness, 0.3);
  EXPECT_EQ(witness.count().damaged, 3);
  EXPECT_EQ(witness.count().looks, 0);
  EXPECT_TRUE(sent_.empty());
}

TEST_F(LiveWitnessTest, KnowsWhenMocapdWasHeardLast) {
  LiveWitness witness(lcm_, {.url = "memq://"}, network_);
  WorkAt(witness, 0);
  WorkAt(witness, 5);
  EXPECT_EQ(witness.heard_ns(), 1'000 * kSecond_ns);
  lcm_.publish("MOCAP_STATUS", "", 0);
  WorkAt(witness, 6);
  EXPECT_EQ(witness.heard_ns(), 1'006 * kSecond_ns);
}

TEST(WitnessPace, KeepsWithinItsShare) {
  constexpr std::int64_t kLook_ns = 50'000'000;
  WitnessPace pace(3, 0.2);
  EXPECT_EQ(pace.Rate(1, false), 3);
  EXPECT_EQ(pace.Rate(1, true), 6);
  pace.Note(kSecond_ns, kLook_ns);
  EXPECT_EQ(pace.next_ns(), kSecond_ns + 5 * kLook_ns);
  EXPECT_EQ(pace.Rate(1, false), 3);
  EXPECT_DOUBLE_EQ(pace.Rate(1, true), 3.6);
  EXPECT_DOUBLE_EQ(pace.Rate(2, false), 1.8);
}

}  // namespace
}  // namespace mocap
