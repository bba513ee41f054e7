// Every number that a person may change, with its default.
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

/// How fast a recording is replayed: at its own times, or as fast as it is read.
enum class ReplayRate { kRealtime, kFast };

/// What this mocapd does of the work.
enum class Role {
  kAlone,  ///< All of it.
  kNode,   ///< It has cameras, and sends their silhouettes to a studio.
  kStudio  ///< It carves and tracks by the silhouettes of nodes, and of its own cameras if it has
           ///< any.
};

/// [node]: this computer as a part of a studio.
struct NodeConfig {
  std::string name;
  std::vector<std::string> cameras;  ///< Of a take or the simulated studio; empty: all.
};

/// One [[nodes]] entry of a studio.
struct StudioNode {
  std::string name;
  std::vector<std::string> cameras;
  std::vector<std::string> control;  ///< The command that reaches its mocapd; empty: it cannot be.
};

/// [source]: where frames come from.
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
  double losses_per_minute = 0;  ///< How often each camera fails for two seconds.
  bool follow = false;           ///< Cameras are on heads, which keep the person in view.
  // For "simulated" and live cameras:
  double fps = 30;
};

/// Whether frames come from [[cameras]].
inline bool IsLive(const SourceConfig& source) {
  return source.driver == "v4l2" || source.driver == "aravis";
}

/// [lcm]: where poses go.
struct LcmConfig {
  std::string url = "udpm://239.255.76.67:7667?ttl=0";
  std::string prefix;
  double voxels_hz = 0;  ///< 0: voxels are not published.
};

/// What turns a live camera.
enum class HeadKind { kNone, kFixed, kV4l2, kUvc };

/// A camera's head.
struct HeadConfig {
  HeadKind kind = HeadKind::kNone;
  std::string device;    ///< Of one on USB: serial number, port or bus.
  PanTiltAngles angles;  ///< Of one that is fixed.
  double delay_ms = 0;   ///< By which readings lag behind.
  bool follow = false;   ///< It keeps the person in view.
  /// How far the studio lets it turn: least and most [rad]. Empty: as far as it can.
  std::optional<std::array<double, 2>> pan_range_rad;
  std::optional<std::array<double, 2>> tilt_range_rad;
};

/// One [[cameras]] entry of a live studio.
struct CameraConfig {
  std::string name;
  std::string device;
  std::optional<double> fps;                  ///< Empty: source.fps.
  std::optional<std::array<int, 2>> size_px;  ///< Empty: what the calibration says.
  HeadConfig head;
  V4l2Settings v4l2;      ///< For source.driver "v4l2".
  AravisSettings aravis;  ///< For source.driver "aravis".
};

struct Config {
  Role role = Role::kAlone;
  NodeConfig node;                ///< Of role kNode.
  std::vector<StudioNode> nodes;  ///< Of role kStudio.
  std::filesystem::path calibration;
  std::filesystem::path
      background;  ///< Folder with the live cameras' pictures of the empty studio.
  SourceConfig source;
  double voxel_mm = 25;
  SegmentationOptions segmentation;
  TrackerKind tracker = TrackerKind::kSurface;
  std::string body = "full";  ///< "mikic2003", "full", or the path of a table.
  int people = 4;             ///< Followed at once, at the most.
  LcmConfig lcm;
  std::vector<CameraConfig> cameras;
  ServiceConfig service;
};

}  // namespace mocap
