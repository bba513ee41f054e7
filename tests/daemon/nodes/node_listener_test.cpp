#include "daemon/nodes/node_listener.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <lcm/lcm-cpp.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "config/open_studio.h"
#include "daemon/messages/decode_message.h"
#include "daemon/messages/lcm_sender.h"
#include "daemon/nodes/silhouette_sender.h"
#include "daemon/pipeline/camera_worker.h"
#include "drivers/simulation/simulated_studio.h"
#include "tests/support/heap_bytes.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Bytes = std::vector<std::uint8_t>;

SimulatedStudioOptions SmallStudio() {
  SimulatedStudioOptions options = RecordedSimulation();
  options.cameras = 2;
  options.width_px = 160;
  options.height_px = 120;
  options.seconds = 0.5;
  return options;
}

constexpr std::int64_t kMs = 1'000'000;
const std::atomic<std::int64_t> kAll{std::numeric_limits<std::int64_t>::min()};

/// A node whose messages a test can hold back, and the studio that they are for.
class NodeListenerTest : public ::testing::Test {
 protected:
  NodeListenerTest() {
    config_.role = Role::kNode;
    config_.node.name = "left";
    config_.nodes = {{"left", {"cam1", "cam2"}, {}}};
    lcm_.subscribeFunction("MOCAP_SILHOUETTE", &Keep<&NodeListenerTest::silhouettes_>, this);
    lcm_.subscribeFunction("MOCAP_NODE", &Keep<&NodeListenerTest::nodes_>, this);
    sender_.emplace(lcm_sender_, config_, cameras_);
    Listen(cameras_);
    for (StudioCamera& camera : studio_.cameras) {
      Segmenter segmenter(camera.calibration, camera.background(), {});
      workers_.push_back(
          std::make_unique<CameraWorker>(std::move(camera), std::move(segmenter), recorders_));
      workers_.back()->Start();
    }
    for (const CameraCalibration& camera : cameras_)
      remote_.push_back(listener_->Open(camera, kRaysPerPerson));
  }

  void Listen(const std::vector<CameraCalibration>& cameras) {
    listener_.emplace(config_, cameras, [this] { return time_of_day_ns_; });
  }
  template <std::deque<Bytes> NodeListenerTest::*Messages>
  static void Keep(const lcm::ReceiveBuffer* buffer, const std::string&, NodeListenerTest* test) {
    const auto* data = static_cast<const std::uint8_t*>(buffer->data);
    (test->*Messages).emplace_back(data, data + buffer->data_size);
  }

  /// Segments a camera's next picture and sends what it sees, of this moment.
  SegmentedFrame Send(int camera) {
    SegmentedFrame frame;
    EXPECT_EQ(workers_[camera]->Next(kAll, frame), SilhouetteSource::Outcome::kFrame);
    sender_->OnSilhouette(camera, frame);
    lcm_.handle();
    return frame;
  }
  silhouette_t TakeMessage() {
    const silhouette_t message = *DecodeMessage<silhouette_t>(silhouettes_.front());
    silhouettes_.pop_front();
    return message;
  }
  /// Hears a message that was so long on its way.
  void Hear(const silhouette_t& message, std::int64_t transit_ns = kMs) {
    const std::int64_t latest_ns =
        std::numeric_limits<std::int64_t>::max() - std::max<std::int64_t>(0, transit_ns);
    time_of_day_ns_ = std::min(message.sent_ns, latest_ns) + transit_ns;
    Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    listener_->OnSilhouette(bytes);
  }
  void HearAll() {
    while (!silhouettes_.empty()) Hear(TakeMessage());
  }
  void HearOfNode(const std::vector<std::string>& complaints = {}, std::size_t cameras = 2) {
    std::vector<CameraStatus> statuses;
    for (std::size_t i = 0; i < cameras; ++i) statuses.push_back(workers_[i]->Status());
    sender_->Tell(statuses, complaints);
    lcm_.handle();
    time_of_day_ns_ = DecodeMessage<node_t>(nodes_.back())->sent_ns + kMs;
    listener_->OnNode(nodes_.back());
  }
  NodeReport Report() { return listener_->Report().nodes.at(0); }
  /// Whether a camera's source hands on a frame without waiting for one.
  std::optional<SegmentedFrame> Receive(int camera) {
    listener_->LookRound();
    SegmentedFrame frame;
    if (remote_[camera]->Next(kAll, frame) == SilhouetteSource::Outcome::kFrame) return frame;
    return {};
  }

  std::int64_t time_of_day_ns_ = 0;
  Studio studio_ = OpenSimulatedStudio(SmallStudio());
  const std::vector<CameraCalibration> cameras_ = CalibrationsOf(studio_);
  Config config_;
  StageRecorders recorders_;
  lcm::LCM lcm_{"memq://"};
  LcmSender lcm_sender_{lcm_, LcmProvider::kMemory};
  std::deque<Bytes> silhouettes_, nodes_;
  std::optional<SilhouetteSender> sender_;
  std::optional<NodeListener> listener_;
  std::vector<std::unique_ptr<CameraWorker>> workers_;
  std::vector<std::unique_ptr<SilhouetteSource>> remote_;
};

TEST_F(NodeListenerTest, WhatArrivesIsWhatWasSegmentedBitForBit) {
  for (int i = 0; i < 8; ++i) {
    const SegmentedFrame sent = Send(i % 2);
    HearAll();
    const std::optional<SegmentedFrame> received = Receive(i % 2);
    ASSERT_TRUE(received);
    EXPECT_TRUE(received->trimap.person.BoundingBox()) << "the comparison must see somebody";
    EXPECT_EQ(received->trimap.person.words(), sent.trimap.person.words());
    EXPECT_EQ(received->trimap.unknown.words(), sent.trimap.unknown.words());
    EXPECT_EQ(received->shading.dark.words(), sent.shading.dark.words());
    EXPECT_EQ(received->shading.dark_tiles, sent.shading.dark_tiles);
    EXPECT_EQ(received->shading.shades, sent.shading.shades);
    EXPECT_EQ(received->shading.tile_columns, sent.shading.tile_columns);
    ASSERT_EQ(received->outline.size(), sent.outline.size());
    for (std::size_t k = 0; k < sent.outline.size(); ++k) {
      EXPECT_EQ(received->outline[k].direction_W, sent.outline[k].direction_W);
      EXPECT_EQ(received->outline[k].outward_W, sent.outline[k].outward_W);
    }
    EXPECT_EQ(received->X_CW.p, sent.X_CW.p);
    EXPECT_EQ(received->X_CW.R, sent.X_CW.R);
    EXPECT_EQ(received->capture_ns, sent.capture_ns);
    EXPECT_EQ(received->sequence, sent.sequence);
    EXPECT_EQ(received->is_blind, sent.is_blind);
    EXPECT_EQ(received->light, sent.light);
  }
  EXPECT_EQ(remote_[0]->Status().frames, 4);
  EXPECT_EQ(remote_[0]->Status().state, CameraState::kStreaming);
  EXPECT_EQ(Report().received, 8);
  EXPECT_EQ(Report().lost, 0);
}

TEST_F(NodeListenerTest, WhatTheNetworkLosesIsCounted) {
  for (int i = 0; i < 4; ++i) Send(0);
  silhouettes_.erase(silhouettes_.begin() + 1, silhouettes_.begin() + 3);
  HearAll();
  EXPECT_EQ(Report().received, 2);
  EXPECT_EQ(Report().lost, 2);
  EXPECT_EQ(Report().lost_share, 0.5);
  EXPECT_TRUE(Receive(0));
  EXPECT_TRUE(Receive(0));
  EXPECT_EQ(remote_[0]->Status().dropped, 2);
}

TEST_F(NodeListenerTest, WhatWaitedTooLongIsCountedOnce) {
  constexpr int kSent = 11, kWait = 8;
  Send(0);
  HearAll();
  EXPECT_TRUE(Receive(0));
  for (int i = 0; i < kSent; ++i) Send(0);
  HearAll();
  for (int i = 0; i < kWait; ++i) EXPECT_TRUE(Receive(0));
  EXPECT_EQ(remote_[0]->Status().frames, 1 + kWait);
  EXPECT_EQ(remote_[0]->Status().dropped, kSent - kWait);
}

TEST_F(NodeListenerTest, ANodeThatStartsAnewHasLostNothing) {
  Send(0);
  HearAll();
  sender_.emplace(lcm_sender_, config_, cameras_);
  Send(0);
  HearAll();
  EXPECT_EQ(Report().lost, 0);
  EXPECT_EQ(Report().received, 2);
}

TEST_F(NodeListenerTest, SilhouettesOfAClockThatIsOffAreNotHandedOn) {
  Send(0);
  Hear(TakeMessage(), -50 * kMs);
  EXPECT_FALSE(Report().clock_agrees);
  EXPECT_EQ(Report().clock_apart_ns, -50 * kMs);
  std::atomic<bool> done{false};
  std::thread looks([&] {
    while (!done.load()) listener_->LookRound();
  });
  SegmentedFrame frame;
  EXPECT_EQ(remote_[0]->Next(kAll, frame), SilhouetteSource::Outcome::kNothing);
  EXPECT_EQ(remote_[0]->expectation(), Expectation::kNone) << "sets go on without it";
  done.store(true);
  looks.join();
}

TEST_F(NodeListenerTest, StrangersAreToldAndGoNoFurther) {
  Send(0);
  silhouette_t message = TakeMessage();
  message.node = "right";
  Hear(message);
  EXPECT_EQ(listener_->Report().stranger, "cam1 of node right");
  message.node = "left";
  message.camera = "cam9";
  Hear(message);
  EXPECT_EQ(listener_->Report().stranger, "cam9 of node left");
  EXPECT_EQ(Report().received, 0);
}

TEST_F(NodeListenerTest, NumbersThatCannotBeGoNoFurther) {
  Send(0);
  const silhouette_t sound = TakeMessage();
  std::vector<silhouette_t> messages(6, sound);
  messages[0].number = std::numeric_limits<std::int64_t>::max();
  messages[1].capture_ns = std::numeric_limits<std::int64_t>::min();
  messages[2].pan_rad = std::numeric_limits<double>::quiet_NaN();
  messages[3].sequence = -1;
  messages[5].number = std::int64_t{1} << 40;
  messages[4].sent_ns = std::numeric_limits<std::int64_t>::max();
  for (const silhouette_t& message : messages) Hear(message);
  listener_->OnSilhouette({});
  EXPECT_EQ(Report().received, 0);
  EXPECT_EQ(listener_->Report().stranger, "somebody");
}

TEST_F(NodeListenerTest, APictureThatCannotBeUnpackedIsTorn) {
  Send(0);
  silhouette_t message = TakeMessage();
  message.packed.assign(3, 0xff);
  message.num_bytes = 3;
  Hear(message);
  EXPECT_FALSE(Receive(0));
  EXPECT_EQ(remote_[0]->Status().torn, 1);
}

TEST_F(NodeListenerTest, ANodeTellsOfItself) {
  HearOfNode({"cam1 is lost: check its cable and power"});
  const NodeReport report = Report();
  EXPECT_TRUE(report.was_heard);
  EXPECT_TRUE(report.is_of_this_version);
  EXPECT_TRUE(report.has_this_clock);
  EXPECT_THAT(report.complaints, ElementsAre("cam1 is lost: check its cable and power"));
  EXPECT_THAT(report.missing, IsEmpty());
  EXPECT_THAT(report.miscalibrated, IsEmpty());
}

TEST_F(NodeListenerTest, NodesThatComeAndGoLeaveNoMemoryBehind) {
  Send(0);
  silhouette_t message = TakeMessage();
  int stranger = 0;
  const auto come_and_go = [&](int times) {
    for (int i = 0; i < times; ++i) {
      sender_.emplace(lcm_sender_, config_, cameras_);
      HearOfNode({"complaint " + std::to_string(i)});
      nodes_.clear();
      message.node = "left";
      Hear(message);
      ASSERT_TRUE(Receive(0));
      message.node = "stranger" + std::to_string(++stranger);
      Hear(message);
    }
  };
  come_and_go(20);
  const std::int64_t before = HeapBytes();
  come_and_go(300);
  EXPECT_LT(HeapBytes() - before, 3'000);
}

TEST_F(NodeListenerTest, ACameraThatIsCalibratedOtherwiseIsNamed) {
  std::vector<CameraCalibration> moved = cameras_;
  moved[1].X_CW.p.x() += 1;
  Listen(moved);
  HearOfNode();
  EXPECT_THAT(Report().miscalibrated, ElementsAre("cam2"));
}

TEST_F(NodeListenerTest, ACameraThatTheNodeDoesNotHaveIsNamed) {
  sender_.emplace(lcm_sender_, config_, std::span(cameras_).first(1));
  HearOfNode({}, 1);
  EXPECT_THAT(Report().missing, ElementsAre("cam2"));
}

}  // namespace
}  // namespace mocap
