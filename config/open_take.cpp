#include <algorithm>
#include <cmath>
#include <utility>

#include "config/load_config.h"
#include "config/open_studio.h"
#include "config/toml_section.h"
#include "core/errors.h"
#include "drivers/quoted.h"
#include "drivers/take_driver.h"
#include "drivers/take_layout.h"
#include "drivers/take_table.h"
#include "drivers/video_reader.h"

namespace mocap {
namespace {

// Enough for the statistics of a still picture; an hour of it would not fit into memory. A head
// needs all it has.
constexpr std::size_t kMostStillFrames = 200;

/// What take.toml says that replaying needs; it may say more.
struct TakeHeader {
  std::string name;
  double fps_nominal = 0;
  std::vector<std::string> cameras;
};

TakeHeader ReadHeader(const std::filesystem::path& file) {
  TomlSection section = TomlSection::ReadFile(file);
  TakeHeader header;
  header.name = section.Text("name");
  header.fps_nominal = section.NumberWithin("fps_nominal", 0.1, 10000);
  header.cameras = section.Texts("cameras");
  if (header.cameras.empty()) section.Fail("cameras", "is empty; names of cameras are wanted");
  for (const std::string& name : header.cameras) {
    if (!IsCameraName(name)) {
      section.Fail("cameras", "has a name that is not made of letters, digits, _ and -");
    }
    if (std::count(header.cameras.begin(), header.cameras.end(), name) > 1) {
      section.Fail("cameras", "has \"" + name + "\" twice");
    }
  }
  return header;
}

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// The cameras to open, in the take's order whatever the order of the wish.
std::vector<std::string> Choose(const TakeHeader& header, const std::vector<std::string>& wanted,
                                const std::filesystem::path& take) {
  std::string all;
  for (const std::string& name : header.cameras) all += (all.empty() ? "" : ", ") + name;
  for (const std::string& name : wanted) {
    if (!Contains(header.cameras, name)) {
      throw SetupError(take.string() + ": has no camera " + Quoted(name) + "; it has " + all);
    }
  }
  std::vector<std::string> chosen;
  for (const std::string& name : header.cameras) {
    if (wanted.empty() || Contains(wanted, name)) chosen.push_back(name);
  }
  return chosen;
}

VideoReader OpenVideo(const std::filesystem::path& file, const CameraCalibration& camera) {
  VideoReader video(file);
  if (video.width_px() != camera.width_px || video.height_px() != camera.height_px) {
    const auto size = [](int width, int height) {
      return std::to_string(width) + " x " + std::to_string(height);
    };
    throw SetupError(file.string() + ": has pictures of " +
                     size(video.width_px(), video.height_px()) + "; " + camera.name +
                     " is calibrated for " + size(camera.width_px, camera.height_px));
  }
  return video;
}

// Angles and a head belong together: one without the other would be wrong in silence.
TakeTable ReadTable(const std::filesystem::path& file, const CameraCalibration& camera) {
  TakeTable table = ReadTakeTable(file);
  if (camera.head && !table.has_angles) {
    throw SetupError(file.string() + ":1: has no pan_rad,tilt_rad, but calibration.toml has " +
                     "cameras." + camera.name + ".pan_tilt");
  }
  const bool turns = std::any_of(table.rows.begin(), table.rows.end(),
                                 [](const TakeRow& row) { return row.angles != PanTiltAngles{}; });
  if (!camera.head && turns) {
    throw SetupError(file.string() + ": has pan and tilt, but calibration.toml has no cameras." +
                     camera.name + ".pan_tilt");
  }
  return table;
}

std::vector<BackgroundFrame> ReadBackground(const std::filesystem::path& file,
                                            const CameraCalibration& camera,
                                            const std::vector<TakeRow>& rows) {
  VideoReader video = OpenVideo(file, camera);
  std::vector<BackgroundFrame> frames;
  ImageView<const Bgr> view;
  const std::size_t most = camera.head ? rows.size() : kMostStillFrames;
  for (std::size_t i = 0; i < most; ++i) {
    const VideoStatus status = video.Read(view);
    if (status == VideoStatus::kEnd) break;
    if (status == VideoStatus::kBroken) continue;
    BackgroundFrame frame{Image<Bgr>(view.width(), view.height()), {}};
    for (int y = 0; y < view.height(); ++y) {
      std::copy_n(view.row(y), view.width(), frame.image.row(y));
    }
    if (camera.head) frame.angles = rows[i].angles;
    frames.push_back(std::move(frame));
  }
  return frames;
}

std::function<std::vector<BackgroundFrame>()> OpenBackground(const TakeLayout& layout,
                                                             const CameraCalibration& camera) {
  const std::filesystem::path file = layout.BackgroundVideo(camera.name);
  OpenVideo(file, camera);
  std::vector<TakeRow> rows;
  if (camera.head) rows = ReadTable(layout.BackgroundTable(camera.name), camera).rows;
  return [file, camera, rows = std::move(rows)] { return ReadBackground(file, camera, rows); };
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

}  // namespace

Studio OpenTake(const std::filesystem::path& take, const TakeOptions& options) {
  if (!std::filesystem::is_directory(take)) {
    throw SetupError(take.string() + ": is no folder; a take is wanted");
  }
  const TakeLayout layout{take};
  const TakeHeader header = ReadHeader(layout.Description());
  const std::vector<CameraCalibration> calibrations = LoadCalibration(layout.Calibration());
  const std::vector<std::string> names = Choose(header, options.cameras, take);

  Studio studio{header.name, header.fps_nominal, {}};
  std::vector<TakeTable> tables;
  for (const std::string& name : names) {
    const CameraCalibration& camera = Find(calibrations, name, layout.Calibration());
    tables.push_back(ReadTable(layout.Table(name), camera));
    studio.cameras.push_back({camera, nullptr, OpenBackground(layout, camera)});
  }
  const bool realtime = options.rate == ReplayRate::kRealtime;
  const auto replay =
      std::make_shared<Replay>(SpanOf(tables, header.fps_nominal, take), options.loop,
                               realtime ? MakeSystemClock() : nullptr);
  for (std::size_t i = 0; i < names.size(); ++i) {
    StudioCamera& camera = studio.cameras[i];
    camera.driver = std::make_unique<TakeDriver>(
        OpenVideo(layout.Video(names[i]), camera.calibration), std::move(tables[i]), replay);
  }
  return studio;
}

}  // namespace mocap
