#include "daemon/messages/pose_publisher.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>

#include "core/errors.h"
#include "drivers/clock.h"

namespace mocap {
namespace {

/// Keeps what the LCM library says of a failure, in many lines, off standard error: ours is one.
class QuietStandardError {
 public:
  QuietStandardError() : saved_(dup(STDERR_FILENO)) {
    std::fflush(stderr);
    const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(null, STDERR_FILENO);
    close(null);
  }
  ~QuietStandardError() {
    std::fflush(stderr);
    dup2(saved_, STDERR_FILENO);
    close(saved_);
  }
  QuietStandardError(const QuietStandardError&) = delete;
  QuietStandardError& operator=(const QuietStandardError&) = delete;

 private:
  int saved_;
};

}  // namespace

bool HasMulticastRoute() {
  const int socket_fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(7667);
  inet_pton(AF_INET, "239.255.76.67", &group.sin_addr);
  sockaddr address{};
  static_assert(sizeof address == sizeof group);
  std::memcpy(&address, &group, sizeof group);
  const bool has_route = connect(socket_fd, &address, sizeof address) == 0;
  close(socket_fd);
  return has_route;
}

std::unique_ptr<lcm::LCM> OpenLcm(const std::string& url) {
  std::unique_ptr<lcm::LCM> lcm;
  {
    QuietStandardError quiet;
    lcm = std::make_unique<lcm::LCM>(url);
  }
  if (lcm->good()) return lcm;
  if (url.starts_with("udpm:") && !HasMulticastRoute()) {
    throw SetupError("lcm.url: " + url + " needs a multicast route, and there is none; add one: " +
                     "ip link set lo up && ip route add 224.0.0.0/4 dev lo");
  }
  throw SetupError("lcm.url: \"" + url +
                   "\" cannot be opened, wanted one like udpm://239.255.76.67:7667?ttl=0");
}

PosePublisher::PosePublisher(lcm::LCM& lcm, const LcmConfig& config, int cameras,
                             CaptureTimes times)
    : lcm_(lcm),
      pose_channel_(config.prefix + "MOCAP_POSE"),
      body_channel_(config.prefix + "MOCAP_BODY"),
      voxels_channel_(config.prefix + "MOCAP_VOXELS"),
      status_channel_(config.prefix + "MOCAP_STATUS"),
      service_channel_(config.prefix + "MOCAP_SERVICE"),
      cameras_(cameras),
      times_(times),
      body_pacer_(1),
      voxels_pacer_(config.voxels_hz),
      paced_voxels_hz_(config.voxels_hz),
      voxels_hz_(config.voxels_hz) {}

template <typename Message>
void PosePublisher::Publish(const std::string& channel, const Message& message) {
  bytes_.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes_.data(), 0, static_cast<int>(bytes_.size()));
  lcm_.publish(channel, bytes_.data(), static_cast<unsigned>(bytes_.size()));
  if (!tap_) return;
  tap_->Offer([&](TappedMessage& copy) {
    copy.channel = channel;
    copy.bytes = bytes_;
    copy.utime = TimelineNs() / 1000;
    return true;
  });
}

TrackedSet PosePublisher::InTimeOfDay(const TrackedSet& set) const {
  TrackedSet stamped = set;
  const std::int64_t ahead_ns = TheHostClock().OffsetNs();
  if (times_ == CaptureTimes::kPresent) stamped.capture_ns += ahead_ns;
  stamped.complete_ns += ahead_ns;
  return stamped;
}

void PosePublisher::OnSet(const TrackedSet& timeline_set) {
  const TrackedSet set = InTimeOfDay(timeline_set);
  FillPose(set, cameras_, pose_);
  pose_.publish_utime = TimeOfDayNs() / 1000;
  Publish(pose_channel_, pose_);
  const std::int64_t now_ns = SteadyNs();
  const bool body_is_due = body_pacer_.IsDue(now_ns);
  if (set.result.body_changed || body_is_due) {
    FillBody(set.body, set.capture_ns / 1000, body_);
    Publish(body_channel_, body_);
  }
  const double voxels_hz = voxels_hz_.load(std::memory_order_relaxed);
  if (voxels_hz != paced_voxels_hz_) {
    paced_voxels_hz_ = voxels_hz;
    voxels_pacer_ = Pacer(voxels_hz);
  }
  if (voxels_pacer_.IsDue(now_ns)) {
    FillVoxels(set, voxels_);
    Publish(voxels_channel_, voxels_);
  }
}

void PosePublisher::PublishStatus(const ServiceReport& report) {
  const std::int64_t utime = TimeOfDayNs() / 1000;
  FillStatus(report.now, utime, status_);
  lcm_.publish(status_channel_, &status_);
  FillService(report, utime, service_);
  lcm_.publish(service_channel_, &service_);
}

}  // namespace mocap
