#include "tools/background_recorder.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "daemon/clock.h"
#include "drivers/video_writer.h"

namespace mocap {
namespace {

constexpr int kFrames = 50;
constexpr std::int64_t kSettle_ns = 1'000'000'000;
constexpr std::int64_t kPatience_ns = 5'000'000'000;
constexpr std::chrono::milliseconds kGrabTimeout{200};
/// Beyond noise and the flicker of lamps.
constexpr int kClearDifference = 40;
constexpr int kStep_px = 4;

bool Differs(const Bgr& a, const Bgr& b) {
  return std::abs(a.b - b.b) > kClearDifference || std::abs(a.g - b.g) > kClearDifference ||
         std::abs(a.r - b.r) > kClearDifference;
}

/// Keeps every fourth pixel of the first frame, each way, and holds later ones against them.
class ChangeMeter {
 public:
  double Measure(ImageView<const Bgr> image) {
    const int columns = (image.width() + kStep_px - 1) / kStep_px;
    const int rows = (image.height() + kStep_px - 1) / kStep_px;
    const bool is_first = first_.empty();
    if (is_first) first_ = Image<Bgr>(columns, rows);
    int changed = 0;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        const Bgr pixel = image(x * kStep_px, y * kStep_px);
        if (is_first) first_(x, y) = pixel;
        changed += Differs(pixel, first_(x, y));
      }
    }
    return static_cast<double>(changed) / (columns * rows);
  }

 private:
  Image<Bgr> first_;
};

/// Gives the next frame, whatever the weather.
void GrabNext(LiveCamera& camera, Frame& frame) {
  const std::int64_t deadline_ns = SteadyNs() + kPatience_ns;
  while (SteadyNs() < deadline_ns) {
    if (camera.driver->Grab(frame, kGrabTimeout) == GrabStatus::kFrame) return;
  }
  throw std::runtime_error(camera.name + " (" + camera.request.device +
                           ") has delivered no frame for 5 s");
}

}  // namespace

BackgroundRecord RecordBackground(LiveCamera& camera, const std::filesystem::path& file,
                                  double seconds) {
  camera.driver->Start();
  Frame frame;
  GrabNext(camera, frame);
  const std::int64_t begin_ns = frame.capture_ns + kSettle_ns;
  const auto interval_ns = static_cast<std::int64_t>(std::llround(seconds * 1e9 / kFrames));
  VideoWriter writer(file, frame.image.width(), frame.image.height(), kFrames / seconds,
                     VideoPixels::kBgr);
  ChangeMeter meter;
  BackgroundRecord record;
  std::int64_t due_ns = begin_ns;
  while (frame.capture_ns < begin_ns + interval_ns * kFrames && record.frames < kFrames) {
    GrabNext(camera, frame);
    if (frame.capture_ns < due_ns) continue;
    due_ns = std::max(due_ns + interval_ns, frame.capture_ns);
    writer.Write(frame.image);
    record.changed = std::max(record.changed, meter.Measure(frame.image));
    ++record.frames;
  }
  writer.Finish();
  camera.driver->Stop();
  return record;
}

}  // namespace mocap
