#include "daemon/messages/client_listener.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drivers/clock.h"

namespace mocap {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::int64_t kSetMoment = 100'000'000'000;

/// A daemon that listens, and what clients send to it.
class ClientListenerTest : public ::testing::Test {
 protected:
  ClientListenerTest() {
    // Recorded pictures are as old as the last set.
    inbox_.TakeFor(kSetMoment, views_);
  }

  static std::vector<CameraCalibration> Cameras() {
    CameraCalibration camera;
    camera.name = "cam1";
    camera.width_px = 640;
    camera.height_px = 480;
    return {camera};
  }
  static keypoints_t SomeMessage() {
    keypoints_t message{};
    message.version = keypoints_t::VERSION;
    message.sender = "witness";
    message.camera = "cam1";
    message.capture_ns = kSetMoment - 200'000'000;
    message.num_points = 2;
    message.points = {{"nose", 320, 100, 0.9}, {"tail", 1, 1, 1}};
    return message;
  }
  static Bytes BytesOf(const keypoints_t& message) {
    Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    return bytes;
  }
  void Hear(const keypoints_t& message) { listener_.OnKeypoints(BytesOf(message)); }
  KeypointSender Sender() {
    const KeypointsReport report = inbox_.Report(SteadyNs());
    EXPECT_EQ(report.senders.size(), 1u);
    return report.senders.empty() ? KeypointSender() : report.senders.front();
  }

  KeypointInbox inbox_;
  MessageTap tap_;
  KeypointTap keypoints_;
  ClientListener listener_{{},
                           Cameras(),
                           CaptureTimes::kRecorded,
                           inbox_,
                           tap_,
                           keypoints_,
                           [this](const look_request_t& request) { requests_.push_back(request); }};
  std::vector<look_request_t> requests_;
  std::vector<KeypointView> views_;
};

TEST_F(ClientListenerTest, KeypointsReachTheTracker) {
  Hear(SomeMessage());
  inbox_.TakeFor(kSetMoment, views_);
  ASSERT_EQ(views_.size(), 1u);
  EXPECT_EQ(views_[0].camera, "cam1");
  EXPECT_EQ(views_[0].capture_ns, kSetMoment - 200'000'000);
  ASSERT_EQ(views_[0].points.size(), 1u);
  EXPECT_EQ(views_[0].points[0].landmark, Landmark::kNose);
  EXPECT_EQ(Sender().name, "witness");
  EXPECT_EQ(Sender().dropped_points, 1);
  EXPECT_NEAR(Sender().lag_ms, 200, 1e-6);
}

TEST_F(ClientListenerTest, PresentTimesAreTheHostsTimeOfDay) {
  ClientListener live({}, Cameras(), CaptureTimes::kPresent, inbox_, tap_, keypoints_, {});
  keypoints_t message = SomeMessage();
  const std::int64_t capture_ns = TimelineNs() - 50'000'000;
  message.capture_ns = TheHostClock().ToTimeOfDay(capture_ns);
  live.OnKeypoints(BytesOf(message));
  inbox_.TakeFor(TimelineNs(), views_);
  ASSERT_EQ(views_.size(), 1u);
  EXPECT_NEAR(static_cast<double>(views_[0].capture_ns - capture_ns), 0, 1e6);
}

TEST_F(ClientListenerTest, OtherStudiosCamerasAreCounted) {
  keypoints_t message = SomeMessage();
  message.camera = "cam7";
  Hear(message);
  EXPECT_EQ(Sender().refused[static_cast<std::size_t>(KeypointRefusal::kCamera)], 1);
  inbox_.TakeFor(kSetMoment, views_);
  EXPECT_TRUE(views_.empty());
}

TEST_F(ClientListenerTest, AnotherVersionIsCounted) {
  keypoints_t message = SomeMessage();
  message.version = 2;
  Hear(message);
  EXPECT_EQ(Sender().refused[static_cast<std::size_t>(KeypointRefusal::kInvalid)], 1);
}

TEST_F(ClientListenerTest, GarbageIsCounted) {
  const Bytes bytes = BytesOf(SomeMessage());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    listener_.OnKeypoints(std::span(bytes).first(size));
  const KeypointsReport report = inbox_.Report(SteadyNs());
  EXPECT_TRUE(report.senders.empty());
  EXPECT_EQ(report.strangers, static_cast<std::int64_t>(bytes.size()));
}

TEST_F(ClientListenerTest, RequestsForPicturesArePassedOn) {
  look_request_t request{};
  request.asker = "witness";
  request.rate_hz = 3;
  Bytes bytes(static_cast<std::size_t>(request.getEncodedSize()));
  request.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  listener_.OnLookRequest(std::span(bytes).first(bytes.size() - 1));
  EXPECT_TRUE(requests_.empty());
  listener_.OnLookRequest(bytes);
  ASSERT_EQ(requests_.size(), 1u);
  EXPECT_EQ(requests_[0].rate_hz, 3);
}

TEST_F(ClientListenerTest, ASendersNameIsPrintableAndShort) {
  keypoints_t message = SomeMessage();
  message.sender = "\x1b[31m" + std::string(1000, 'x');
  Hear(message);
  EXPECT_EQ(Sender().name.find('\x1b'), std::string::npos);
  EXPECT_LT(Sender().name.size(), 60u);
}

TEST_F(ClientListenerTest, ARecordingGetsWhatIsTaken) {
  Doorbell bell;
  tap_.Open(4, {}, bell);
  keypoints_.Open(4, {}, bell);
  keypoints_t message = SomeMessage();
  message.camera = "cam7";
  Hear(message);
  Hear(SomeMessage());
  ASSERT_TRUE(tap_.queue().TryPop());
  EXPECT_EQ(tap_.queue().front().channel, "MOCAP_KEYPOINTS");
  EXPECT_EQ(tap_.queue().front().bytes, BytesOf(SomeMessage()));
  EXPECT_FALSE(tap_.queue().TryPop());
  ASSERT_TRUE(keypoints_.queue().TryPop());
  EXPECT_EQ(keypoints_.queue().front().capture_ns, SomeMessage().capture_ns);
  EXPECT_EQ(keypoints_.queue().front().points.size(), 1u);
  EXPECT_FALSE(keypoints_.queue().TryPop());
}

}  // namespace
}  // namespace mocap
