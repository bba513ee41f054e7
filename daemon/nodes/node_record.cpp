#include "daemon/nodes/node_record.h"

#include <span>
#include <utility>

#include "daemon/nodes/host_clock_care.h"
#include "drivers/take/calibration_file.h"

namespace mocap {
namespace {

constexpr std::int64_t kSliceNs = 250'000'000;
/// By then, every camera of a node that returned has been heard.
constexpr std::int64_t kReturnNs = 500'000'000;

}  // namespace

void RecentCount::Add(std::int64_t count, std::int64_t now_ns) {
  const std::int64_t number = now_ns / kSliceNs;
  Slice& slice = slices_[static_cast<std::size_t>(number) % slices_.size()];
  if (std::exchange(slice.number, number) != number) slice.count = 0;
  slice.count += count;
}

std::int64_t RecentCount::Sum(std::int64_t now_ns) const {
  std::int64_t sum = 0;
  const std::int64_t first = now_ns / kSliceNs - static_cast<std::int64_t>(slices_.size()) + 1;
  for (const Slice& slice : slices_)
    if (slice.number >= first) sum += slice.count;
  return sum;
}

NodeRecord::NodeRecord(std::string name, const std::vector<CameraCalibration>& cameras)
    : host_(BootName()) {
  report_.name = std::move(name);
  for (const CameraCalibration& camera : cameras)
    calibrations_[camera.name] = CalibrationText("", std::span(&camera, 1));
}

bool NodeRecord::NoteHeard(std::int64_t transit_ns, std::int64_t set_ns, std::int64_t now_ns) {
  if (report_.was_heard && now_ns - heard_ns_ > kReturnNs) returned_ns_ = now_ns;
  report_.was_heard = true;
  heard_ns_ = now_ns;
  return clock_.Take(transit_ns, set_ns, now_ns);
}

bool NodeRecord::Take(const silhouette_t& message, std::int64_t missed, std::int64_t transit_ns,
                      std::int64_t now_ns) {
  ++report_.received;
  report_.lost += missed;
  const bool is_usable = NoteHeard(transit_ns, message.clock_set_ns, now_ns);
  received_.Add(1, now_ns);
  // Losses during an outage are not present losses.
  if (now_ns - returned_ns_ > kReturnNs) lost_.Add(missed, now_ns);
  bytes_ += message.getEncodedSize();
  transit_.Add(LatencyBuckets::IndexOf(transit_ns), 1);
  return is_usable;
}

void NodeRecord::Take(const node_t& message, std::int64_t transit_ns, std::int64_t now_ns) {
  NoteHeard(transit_ns, message.clock_set_ns, now_ns);
  report_.version = message.version;
  report_.is_of_this_version = message.version == MOCAP_VERSION;
  report_.has_this_clock = !host_.empty() && message.host == host_;
  report_.clock_keeper = message.clock_keeper;
  report_.clock_is_kept = message.clock_is_kept;
  report_.clock_error_ms = message.clock_error_ms;
  report_.complaints = message.complaint;
  report_.miscalibrated.clear();
  report_.missing.clear();
  for (const auto& [camera, calibration] : calibrations_) {
    const node_camera_t* found = nullptr;
    for (const node_camera_t& other : message.cameras)
      if (other.name == camera) found = &other;
    if (!found) {
      report_.missing.push_back(camera);
    } else if (found->calibration != calibration) {
      report_.miscalibrated.push_back(camera);
    }
  }
}

bool NodeRecord::IsConnected(std::int64_t now_ns) const {
  return report_.was_heard && now_ns - heard_ns_ < kSilenceNs && clock_.agrees();
}

NodeReport NodeRecord::Report(std::int64_t now_ns) const {
  NodeReport report = report_;
  report.silent_ns = report.was_heard ? now_ns - heard_ns_ : 0;
  report.clock_agrees = clock_.agrees();
  report.clock_apart_ns = clock_.apart_ns();
  const auto received = static_cast<double>(received_.Sum(now_ns));
  const auto lost = static_cast<double>(lost_.Sum(now_ns));
  report.lost_share = lost > 0 ? lost / (lost + received) : 0;
  report.transit_p50_ms = transit_.PercentileMs(0.5);
  report.transit_p99_ms = transit_.PercentileMs(0.99);
  if (report.received > 0)
    report.bytes_per_frame = static_cast<double>(bytes_) / static_cast<double>(report.received);
  return report;
}

}  // namespace mocap
