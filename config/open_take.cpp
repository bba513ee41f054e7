#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "config/camera_files.h"
#include "config/load_config.h"
#include "config/open_studio.h"
#include "config/room_limits.h"
#include "config/take_header.h"
#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "drivers/printable_text.h"
#include "drivers/quoted.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_driver.h"
#include "drivers/take/take_layout.h"

namespace mocap {
namespace {

/// A rate that differs from the nominal one by these factors is wrong, or worth a remark.
constexpr double kRefusedTimes = 50, kDoubtfulTimes = 4;

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The unit that was mistaken for nanoseconds, for times wrong by this factor; empty: none.
const char* UnitOf(double times) {
  if (times > 3e2 && times < 3e3) return "microseconds";
  if (times > 3e5 && times < 3e6) return "milliseconds";
  return times > 3e8 && times < 3e9 ? "seconds" : "";
}

/// Compares a table's times with the rate in take.toml.
/// @throws SetupError  if they cannot be nanoseconds.
void CheckTimes(const TakeTable& table, double fps_nominal, const std::filesystem::path& file,
                std::vector<std::string>& remarks) {
  if (table.is_cut_off) {
    remarks.push_back(file.string() + ": the last line is cut off; that frame is left out");
  }
  const auto apart_ns = static_cast<double>(UsualIntervalNs(table));
  if (apart_ns == 0) return;
  const double wanted_ns = 1e9 / fps_nominal, times = wanted_ns / apart_ns;
  std::ostringstream text;
  text << file.string() << ": its frames are " << apart_ns / 1e6
       << " ms apart, but take.toml has fps_nominal = " << fps_nominal << ", which is "
       << wanted_ns / 1e6 << " ms";
  if (times > kRefusedTimes || times < 1 / kRefusedTimes) {
    const std::string unit = UnitOf(times);
    throw SetupError(
        text.str() + (unit.empty() ? "; expected" : ", as if in " + unit + "; expected") +
        " timestamp_ns in nanoseconds" + (unit.empty() ? ", or another fps_nominal" : ""));
  }
  if (times > kDoubtfulTimes || times < 1 / kDoubtfulTimes) remarks.push_back(text.str());
}

/// The camera had delivered nothing by the end of the recording.
bool IsSilent(const TakeLayout& layout, const std::string& name) {
  return HoldsNoRows(layout.Table(name)) || HoldsNoFrame(layout.Video(name));
}

// The cameras to open, always in the take's order. A silent camera that is named causes an error
// when it is opened.
std::vector<std::string> Choose(const TakeHeader& header, const std::vector<std::string>& wanted,
                                const TakeLayout& layout) {
  for (const std::string& name : wanted) {
    if (!Contains(header.cameras, name)) {
      throw SetupError(layout.folder.string() + ": has no camera " + Quoted(name) + "; " +
                       ExpectedNames(name, header.cameras));
    }
  }
  std::vector<std::string> chosen;
  for (const std::string& name : header.cameras) {
    if (wanted.empty() ? !IsSilent(layout, name) : Contains(wanted, name)) chosen.push_back(name);
  }
  if (chosen.empty()) {
    throw SetupError(layout.folder.string() + ": contains no frame of any camera (" +
                     ListedNames(header.cameras) + "); expected a take with frames");
  }
  return chosen;
}

const CameraCalibration& Find(const std::vector<CameraCalibration>& calibrations,
                              const std::string& name, const std::filesystem::path& file) {
  const auto camera = std::find_if(calibrations.begin(), calibrations.end(),
                                   [&name](const CameraCalibration& c) { return c.name == name; });
  if (camera == calibrations.end()) {
    throw SetupError(file.string() + ": cameras." + name + " is missing; take.toml names it");
  }
  return *camera;
}

/// Takes off the rows before the take begins. @return  how many.
std::size_t TakeOffLead(const TakeHeader& header, const std::filesystem::path& file,
                        TakeTable& table) {
  if (!header.begin_ns) return 0;
  const auto first =
      std::ranges::lower_bound(table.rows, *header.begin_ns, {}, &TakeRow::timestamp_ns);
  if (first == table.rows.end())
    throw SetupError(file.string() + ": ends before begin_ns of take.toml; expected later frames");
  const auto lead = static_cast<std::size_t>(first - table.rows.begin());
  table.rows.erase(table.rows.begin(), first);
  return lead;
}

ReplaySpan SpanOf(const std::vector<TakeTable>& tables, double fps_nominal,
                  const std::filesystem::path& take) {
  ReplaySpan span;
  span.first_ns = tables.front().rows.front().timestamp_ns;
  std::int64_t last_ns = 0;
  for (const TakeTable& table : tables) {
    span.first_ns = std::min(span.first_ns, table.rows.front().timestamp_ns);
    last_ns = std::max(last_ns, table.rows.back().timestamp_ns);
  }
  if (last_ns - span.first_ns > kLongestTake_ns) {
    throw SetupError(take.string() + ": its cameras' times lie more than a week apart");
  }
  span.period_ns = last_ns - span.first_ns + std::llround(1e9 / fps_nominal);
  return span;
}

/// Counts frames, from the first on. @param most  stops there.
std::size_t CountFrames(VideoReader& video, std::size_t most) {
  std::size_t count = 0;
  while (count < most && video.Skip() != VideoStatus::kEnd) ++count;
  return count;
}

/// Opens masks of a camera's frames.
/// @param rows  of the camera's table. A video that was cut off may have fewer frames.
VideoReader OpenMasks(const std::filesystem::path& masks, const std::filesystem::path& pictures,
                      std::size_t rows, const CameraCalibration& camera) {
  RequireFile(masks, "masks of " + camera.name + ", one for each frame");
  VideoReader video = OpenCameraVideo(masks, camera);
  const std::size_t count = CountFrames(video, rows);
  if (count < rows) {
    VideoReader recorded = OpenCameraVideo(pictures, camera);
    const std::size_t frames = CountFrames(recorded, rows);
    if (count < frames) {
      throw SetupError(masks.string() + ": has " + Counted(count, "mask") + "; expected one for " +
                       "each of the " + Counted(frames, "frame") + " of " + camera.name);
    }
  }
  video.Rewind();
  return video;
}

/// Checks the folder of masks, or of the pictures of the empty studio.
void RequireReference(const TakeLayout& layout, const TakeOptions& options) {
  if (!options.masks.empty())
    return RequireFolder(options.masks, "a folder of masks, named CAMERA.mkv");
  // Takes of a board are such.
  if (!IsThere(layout.Background()))
    throw SetupError(layout.folder.string() +
                     ": has no pictures of the empty studio (the folder background); expected a "
                     "take of people");
}

}  // namespace

Studio OpenTake(const std::filesystem::path& take, const TakeOptions& options) {
  const TakeHeader header = ReadTakeHeader(take);
  const TakeLayout layout{take};
  const std::vector<CameraCalibration> calibrations = LoadCalibration(layout.Calibration());
  const std::vector<std::string> names = Choose(header, options.cameras, layout);
  RequireReference(layout, options);

  Studio studio{header.name, header.fps_nominal, {}};
  RemarkOnPlaces(calibrations, layout.Calibration(), studio);
  std::vector<TakeTable> tables;
  std::vector<std::size_t> leads;
  for (const std::string& name : names) {
    const CameraCalibration& camera = Find(calibrations, name, layout.Calibration());
    tables.push_back(ReadCameraTable(layout.Table(name), camera));
    CheckTimes(tables.back(), header.fps_nominal, layout.Table(name), studio.remarks);
    leads.push_back(TakeOffLead(header, layout.Table(name), tables.back()));
    studio.cameras.push_back({camera, nullptr, {}});
    if (options.masks.empty())
      studio.cameras.back().background =
          OpenCameraBackground(layout.BackgroundVideo(name), layout.BackgroundTable(name), camera);
  }
  const bool realtime = options.rate == ReplayRate::kRealtime;
  studio.times = realtime ? CaptureTimes::kPresent : CaptureTimes::kRecorded;
  // Those who share the timeline may replay other cameras of the take.
  std::vector<TakeTable> spanned = tables;
  if (options.begin_ns) {
    for (const std::string& name : Choose(header, {}, layout)) {
      spanned.push_back(
          ReadCameraTable(layout.Table(name), Find(calibrations, name, layout.Calibration())));
      TakeOffLead(header, layout.Table(name), spanned.back());
    }
  }
  const auto replay = std::make_shared<Replay>(
      SpanOf(spanned, header.fps_nominal, take), options.loop,
      realtime ? std::make_unique<TimelineClock>() : nullptr, options.begin_ns);
  for (std::size_t i = 0; i < names.size(); ++i) {
    StudioCamera& camera = studio.cameras[i];
    const std::filesystem::path pictures = layout.Video(names[i]);
    VideoReader video = options.masks.empty()
                            ? OpenCameraVideo(pictures, camera.calibration)
                            : OpenMasks(options.masks / pictures.filename(), pictures,
                                        leads[i] + tables[i].rows.size(), camera.calibration);
    if (options.in_memory) video.KeepInMemory();
    camera.driver =
        std::make_unique<TakeDriver>(std::move(video), std::move(tables[i]), replay, leads[i]);
  }
  return studio;
}

}  // namespace mocap
