// All settings, with their defaults.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/service_config.h"
#include "core/make_motion_capture.h"
#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/silhouette/segmenter.h"
#include "drivers/aravis/aravis_settings.h"
#include "drivers/v4l2/v4l2_settings.h"

namespace mocap {

/// Replay speed of a recording: real time, or as fast as it is read.
enum class ReplayRate { kRealtime, kFast };

/// The part of the work that this mocapd does.
enum class Role {
  kAlone,  ///< All of it.
  kNode,   ///< Has cameras, and sends their silhouettes to a studio.
  kStudio  ///< Carves and tracks from the silhouettes of nodes, and of its own cameras if any.
};

/// [node]: this computer as part of a studio.
struct NodeConfig {
  std::string name;
  std::vector<std::string> cameras;  ///< Of a take or the simulated studio; empty: all.
};

/// One [[nodes]] entry of a studio.
struct StudioNode {
  std::string name;
  std::vector<std::string> cameras;
  std::vector<std::string> control;  ///< Command that reaches its mocapd; empty: unreachable.
};

/// [source]: the origin of frames.
struct SourceConfig {
  std::string driver = "simulated";  ///< "take", "simulated", "v4l2", "aravis", "none".
  std::filesystem::path take;
  ReplayRate rate = ReplayRate::kRealtime;
  bool loop = false;
  bool in_memory = false;  ///< The take is decoded before it starts.
  // For "simulated":
  std::string motion = "walk";
  int people = 1;
  double stature_mm = 1750;
  int cameras = 6;
  int width_px = 640, height_px = 480;
  std::uint64_t seed = 1;
  double losses_per_minute = 0;  ///< Rate at which each camera fails, for two seconds each.
  bool follow = false;           ///< Cameras are on pan-tilt heads, which keep the person in view.
  // For "simulated" and live cameras:
  double fps = 30;
};

/// Whether frames come from [[cameras]].
inline bool IsLive(const SourceConfig& source) {
  return source.driver == "v4l2" || source.driver == "aravis";
}

/// [lcm]: the destination of poses.
struct LcmConfig {
  std::string url = "udpm://239.255.76.67:7667?ttl=0";
  std::string prefix;
  double voxels_hz = 0;  ///< 0: voxels are not published.
};

/// Kind of a live camera's pan-tilt head.
enum class HeadKind { kNone, kFixed, kV4l2, kUvc };

/// A camera's pan-tilt head.
struct HeadConfig {
  HeadKind kind = HeadKind::kNone;
  std::string device;    ///< For a head on USB: serial number, port or bus.
  PanTiltAngles angles;  ///< For a fixed head.
  double delay_ms = 0;   ///< Delay of its readings.
  bool follow = false;   ///< It keeps the person in view.
  /// Range of turning that the studio permits: minimum and maximum [rad]. Empty: its full range.
  std::optional<std::array<double, 2>> pan_range_rad;
  std::optional<std::array<double, 2>> tilt_range_rad;
};

/// One [[cameras]] entry of a live studio.
struct CameraConfig {
  std::string name;
  std::string device;
  std::optional<double> fps;                  ///< Empty: source.fps.
  std::optional<std::array<int, 2>> size_px;  ///< Empty: as in the calibration.
  HeadConfig head;
  V4l2Settings v4l2;      ///< For source.driver "v4l2".
  AravisSettings aravis;  ///< For source.driver "aravis".
};

struct Config {
  std::filesystem::path file;  ///< From which it was read; empty: none.
  Role role = Role::kAlone;
  NodeConfig node;                ///< For role kNode.
  std::vector<StudioNode> nodes;  ///< For role kStudio.
  std::filesystem::path calibration;
  std::filesystem::path
      background;  ///< Folder with the live cameras' pictures of the empty studio.
  SourceConfig source;
  double voxel_mm = 25;
  SegmentationOptions segmentation;
  TrackerKind tracker = TrackerKind::kSurface;
  std::string body = "full";  ///< "mikic2003", "full", or the path of a table.
  int people = 4;             ///< Maximum number tracked at once.
  LcmConfig lcm;
  std::vector<CameraConfig> cameras;
  ServiceConfig service;
};

/// Names a key of a configuration in an error: "mocapd.toml: source.take".
inline std::string WhereOf(const Config& config, const std::string& key) {
  return config.file.empty() ? key : config.file.string() + ": " + key;
}

}  // namespace mocap
