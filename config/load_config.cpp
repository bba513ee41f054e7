#include "config/load_config.h"

#include <algorithm>
#include <limits>

#include "config/lcm_url.h"
#include "config/load_service_config.h"
#include "config/read_cameras.h"
#include "config/read_nodes.h"
#include "config/toml_section.h"
#include "core/errors.h"
#include "core/people/people_capture.h"
#include "drivers/virtual_studio/motions/company.h"

namespace mocap {
namespace {

constexpr double kSmallestVoxel_mm = 10;
constexpr double kLargestVoxel_mm = 100;
constexpr std::size_t kLongestPrefix = 32;
constexpr int kLeastPicture_px = 16;
constexpr int kLargestPicture_px = 8192;

SourceConfig ReadSource(TomlSection section, const std::filesystem::path& file) {
  SourceConfig source;
  const std::vector<std::string> drivers = {"take", "simulated", "v4l2", "aravis", "none"};
  source.driver = drivers[section.Choice("driver", drivers, 1)];
  source.take = Resolved(file, section.Text("take", ""));
  source.rate = section.Choice("rate", {"realtime", "fast"}, 0) == 0 ? ReplayRate::kRealtime
                                                                     : ReplayRate::kFast;
  source.loop = section.Flag("loop", source.loop);
  source.in_memory = section.Flag("in_memory", source.in_memory);
  const std::vector<std::string> motions(simulation::kCompanyMotionNames.begin(),
                                         simulation::kCompanyMotionNames.end());
  source.motion = motions[section.Choice("motion", motions, 0)];
  source.people = static_cast<int>(
      section.IntegerWithin("people", 1, simulation::kMostSimulatedPeople, source.people));
  source.stature_mm = section.NumberWithin("stature_mm", 1000, 2100, source.stature_mm);
  source.cameras = static_cast<int>(section.IntegerWithin("cameras", 1, 64, source.cameras));
  source.width_px = static_cast<int>(
      section.IntegerWithin("width", kLeastPicture_px, kLargestPicture_px, source.width_px));
  source.height_px = static_cast<int>(
      section.IntegerWithin("height", kLeastPicture_px, kLargestPicture_px, source.height_px));
  source.fps = section.NumberWithin("fps", 1, 1000, source.fps);
  source.seed = static_cast<std::uint64_t>(section.IntegerWithin(
      "seed", 0, std::numeric_limits<std::int64_t>::max(), static_cast<std::int64_t>(source.seed)));
  source.losses_per_minute =
      section.NumberWithin("losses_per_minute", 0, 12, source.losses_per_minute);
  source.follow = section.Flag("follow", source.follow);
  section.RejectUnknownKeys();
  if (source.driver == "take" && source.take.empty()) {
    section.Fail("take", "is missing; expected the folder of a take");
  }
  return source;
}

double ReadVoxels(TomlSection section, double fallback_mm) {
  const double size_mm =
      section.NumberWithin("size_mm", kSmallestVoxel_mm, kLargestVoxel_mm, fallback_mm);
  section.RejectUnknownKeys();
  return size_mm;
}

SegmentationOptions ReadSegmentation(TomlSection section) {
  SegmentationOptions options;
  options.detection_rate =
      section.NumberWithin("detection_rate", 0.5, 0.9999999, options.detection_rate);
  options.smallest_blob_share =
      section.NumberWithin("smallest_blob_share", 0, 0.5, options.smallest_blob_share);
  section.RejectUnknownKeys();
  return options;
}

void CheckUrl(const TomlSection& section, const std::string& url) {
  if (url.empty()) section.Fail("url", "is empty; expected an LCM address");
  LcmUrl address;
  try {
    address = ParseLcmUrl(url);
  } catch (const SetupError& error) {
    section.Fail("url", error.what());
  }
  if (address.provider == LcmProvider::kFile && !address.is_written) {
    section.Fail("url",
                 "\"" + url + "\" reads a log, but mocapd writes messages; expected ?mode=w");
  }
}

LcmConfig ReadLcm(TomlSection section) {
  LcmConfig lcm;
  lcm.url = section.Text("url", lcm.url);
  CheckUrl(section, lcm.url);
  lcm.prefix = section.Text("prefix", lcm.prefix);
  if (lcm.prefix.size() > kLongestPrefix) {
    section.Fail("prefix", "is longer than " + std::to_string(kLongestPrefix) + " characters");
  }
  lcm.voxels_hz = section.NumberWithin("voxels_hz", 0, 1000, lcm.voxels_hz);
  section.RejectUnknownKeys();
  return lcm;
}

// `body` names a table, or is a section that also selects the tracker.
void ReadBody(TomlSection& root, const std::filesystem::path& file, Config& config) {
  if (root.IsTable("body")) {
    TomlSection section = *root.Section("body");
    const NamedTracker& tracker = Trackers()[section.Choice("tracker", TrackerNames(), 0)];
    config.tracker = tracker.kind;
    config.body = section.Text("table", tracker.body);
    section.RejectUnknownKeys();
  } else {
    config.body = root.Text("body", config.body);
  }
  const bool is_path = config.body.ends_with(".toml") || config.body.find('/') != std::string::npos;
  if (is_path) config.body = Resolved(file, config.body).string();
}

int ReadPeople(TomlSection section, int people) {
  people = static_cast<int>(section.IntegerWithin("most", 1, kMostPeople, people));
  section.RejectUnknownKeys();
  return people;
}

void CheckLiveStudio(const Config& config, const TomlSection& root) {
  const std::string& driver = config.source.driver;
  if (!IsLive(config.source)) return;
  const std::string reason = "; source.driver \"" + driver + "\" needs it";
  if (config.cameras.empty()) root.Fail("cameras", "is missing" + reason);
  if (config.calibration.empty()) root.Fail("calibration", "is missing" + reason);
  if (config.background.empty()) root.Fail("background", "is empty" + reason);
}

}  // namespace

const std::vector<NamedTracker>& Trackers() {
  static const std::vector<NamedTracker> trackers = {
      {"surface", TrackerKind::kSurface, "full"},
      {"mikic2003", TrackerKind::kMikic2003, "mikic2003"}};
  return trackers;
}

std::vector<std::string> TrackerNames() {
  std::vector<std::string> names;
  for (const NamedTracker& tracker : Trackers()) names.push_back(tracker.name);
  return names;
}

Config LoadConfig(const std::filesystem::path& file) {
  TomlSection root = TomlSection::ReadFile(file);
  Config config;
  config.file = file;
  config.calibration = Resolved(file, root.Text("calibration", ""));
  config.background = Resolved(file, root.Text("background", "background"));
  ReadBody(root, file, config);
  if (auto section = root.Section("source")) config.source = ReadSource(*section, file);
  if (auto section = root.Section("voxels"))
    config.voxel_mm = ReadVoxels(*section, config.voxel_mm);
  if (auto section = root.Section("segmentation")) config.segmentation = ReadSegmentation(*section);
  if (auto section = root.Section("people")) config.people = ReadPeople(*section, config.people);
  if (auto section = root.Section("lcm")) config.lcm = ReadLcm(*section);
  config.cameras = ReadCameras(root, config.source.driver);
  config.service = ReadServiceConfig(root, file);
  ReadRole(root, config);
  if (config.source.driver == "none" && config.role != Role::kStudio)
    root.Fail("source", "has driver \"none\", which only role \"studio\" can have");
  root.RejectUnknownKeys();
  CheckRole(root, config);
  CheckLiveStudio(config, root);
  return config;
}

}  // namespace mocap
