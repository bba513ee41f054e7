#include "tools/import/sampled_pictures.h"

#include <algorithm>
#include <cmath>

#include "drivers/take/video_reader.h"
#include "tools/stop_on_signals.h"

namespace mocap {
namespace {

/// Containers round times, Matroska to a millisecond.
constexpr std::int64_t kRounding_ns = 600'000;

}  // namespace

std::vector<std::size_t> SpreadFrames(std::span<const std::int64_t> times_ns, std::size_t most) {
  std::vector<std::size_t> chosen;
  const std::size_t count = std::min(most, times_ns.size());
  const double apart = count < 2 ? 0 : 1 / static_cast<double>(count - 1);
  for (std::size_t i = 0, next = 0; i < count; ++i) {
    const auto length_ns = static_cast<double>(times_ns.back() - times_ns.front());
    const std::int64_t wanted_ns =
        times_ns.front() + std::llround(static_cast<double>(i) * apart * length_ns);
    // The nearest one that is left, with one for each that is still to come.
    const std::size_t last = times_ns.size() - (count - i);
    while (next < last && times_ns[next + 1] - wanted_ns < wanted_ns - times_ns[next]) ++next;
    chosen.push_back(next++);
  }
  return chosen;
}

void VisitFrames(const std::filesystem::path& file, std::span<const std::int64_t> times_ns,
                 std::span<const std::size_t> chosen,
                 const std::function<bool(std::size_t frame, ImageView<const Bgr>)>& visit) {
  VideoReader video(file);
  ImageView<const Bgr> image;
  for (const std::size_t frame : chosen) {
    EndIfStopAsked();
    if (!video.GoTo(times_ns[frame] - kRounding_ns)) return;
    const VideoStatus status = video.Read(image);
    if (status == VideoStatus::kEnd) return;
    if (status == VideoStatus::kFrame && !visit(frame, image)) return;
  }
}

}  // namespace mocap
