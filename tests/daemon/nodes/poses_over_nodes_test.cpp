#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "config/load_config.h"
#include "daemon/messages/decode_message.h"
#include "daemon/messages/lcm_sender.h"
#include "daemon/nodes/node_listener.h"
#include "daemon/nodes/silhouette_sender.h"
#include "daemon/pipeline/camera_lines.h"
#include "daemon/pipeline/pipeline.h"
#include "drivers/simulation/simulated_studio.h"

namespace mocap {
namespace {

constexpr int kCameras = 4;

Studio Simulation() {
  SimulatedStudioOptions options = RecordedSimulation();
  options.cameras = kCameras;
  options.width_px = 160;
  options.height_px = 120;
  options.seconds = 0.8;
  return OpenSimulatedStudio(options);
}

PipelineOptions Waiting() { return {.voxel_mm = 50, .overflow = Overflow::kWait}; }

class Poses : public PoseSink {
 public:
  void OnSet(const TrackedSet& set) override {
    is_tracked |= set.result.state == CaptureState::kTracking;
    cameras.push_back(set.cameras);
    voxels.push_back(set.grid.words());
    points.push_back(set.result.points_W);
  }

  bool is_tracked = false;
  std::vector<std::uint64_t> cameras;
  std::vector<std::vector<std::uint64_t>> voxels;
  std::vector<BodyPoints> points;
};

/// A node and its studio in one thread. LCM's memq stands for the network.
class Network {
 public:
  explicit Network(const Studio& studio) {
    config_.role = Role::kNode;
    config_.node.name = "left";
    config_.nodes = {{"left", {}, {}}};
    for (const StudioCamera& camera : studio.cameras) {
      cameras_.push_back(camera.calibration);
      config_.nodes[0].cameras.push_back(camera.calibration.name);
    }
    lcm_.subscribeFunction("MOCAP_SILHOUETTE", &Network::Arrive, this);
    sender_ = std::make_unique<SilhouetteSender>(lcm_sender_, config_, cameras_);
    listener_ =
        std::make_unique<NodeListener>(config_, cameras_, [this] { return time_of_day_ns_; });
  }

  void Send(int camera, const SegmentedFrame& frame) {
    sender_->OnSilhouette(camera, frame);
    lcm_.handle();
  }
  std::unique_ptr<SilhouetteSource> Open(const CameraCalibration& camera, int rays) {
    return listener_->Open(camera, rays);
  }

 private:
  static void Arrive(const lcm::ReceiveBuffer* buffer, const std::string&, Network* network) {
    const std::span bytes(static_cast<const std::uint8_t*>(buffer->data), buffer->data_size);
    network->time_of_day_ns_ = DecodeMessage<silhouette_t>(bytes)->sent_ns + 1'000'000;
    network->listener_->OnSilhouette(bytes);
  }

  Config config_;
  std::vector<CameraCalibration> cameras_;
  std::int64_t time_of_day_ns_ = 0;
  lcm::LCM lcm_{"memq://"};
  LcmSender lcm_sender_{lcm_, LcmProvider::kMemory};
  std::unique_ptr<SilhouetteSender> sender_;
  std::unique_ptr<NodeListener> listener_;
};

/// What the studio has of a camera: each of its silhouettes has gone over the network.
class SentCamera : public SilhouetteSource {
 public:
  SentCamera(Network& network, int number, std::unique_ptr<SilhouetteSource> at_node, int rays)
      : network_(network),
        number_(number),
        at_node_(std::move(at_node)),
        received_(network.Open(at_node_->calibration(), rays)) {}

  void Start() override { at_node_->Start(); }
  void Stop() override { at_node_->Stop(); }
  Outcome Next(const std::atomic<std::int64_t>& wanted_from_ns, SegmentedFrame& frame) override {
    SegmentedFrame sent;
    const Outcome outcome = at_node_->Next(wanted_from_ns, sent);
    if (outcome != Outcome::kFrame) return outcome;
    network_.Send(number_, sent);
    return received_->Next(wanted_from_ns, frame);
  }
  const CameraCalibration& calibration() const override { return at_node_->calibration(); }
  Expectation expectation() const override { return at_node_->expectation(); }
  std::int64_t newest_ns() const override { return received_->newest_ns(); }
  CameraStatus Status() const override { return received_->Status(); }

 private:
  Network& network_;
  const int number_;
  const std::unique_ptr<SilhouetteSource> at_node_;
  const std::unique_ptr<SilhouetteSource> received_;
};

TEST(PosesOverNodes, AreThoseOfOneProcessBitForBit) {
  Poses here;
  Pipeline(Simulation(), Waiting(), LoadBodyTable("full"), here).RunSerially();

  Studio at_node = Simulation();
  Network network(at_node);
  StageRecorders recorders;
  std::vector<Segmenter> segmenters = LearnBackgrounds(at_node.cameras, SegmentationOf(Waiting()));
  Studio studio = Simulation();
  for (StudioCamera& camera : studio.cameras) camera.driver = nullptr;
  PipelineOptions options = Waiting();
  int opened = 0;
  options.elsewhere = [&](const CameraCalibration&, int rays) {
    const int number = opened++;
    const auto i = static_cast<std::size_t>(number);
    auto worker =
        std::make_unique<CameraWorker>(std::move(at_node.cameras[i]), std::move(segmenters[i]),
                                       recorders, std::vector<FrameTap*>{}, nullptr, 0);
    return std::make_unique<SentCamera>(network, number, std::move(worker), rays);
  };
  Poses there;
  Pipeline(std::move(studio), options, LoadBodyTable("full"), there).RunSerially();

  ASSERT_EQ(here.points.size(), 24u);
  EXPECT_TRUE(here.is_tracked) << "the comparison must see poses";
  EXPECT_EQ(there.cameras, here.cameras);
  EXPECT_TRUE(there.voxels == here.voxels);
  EXPECT_TRUE(there.points == here.points);
}

}  // namespace
}  // namespace mocap
