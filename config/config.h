// Every number that a person may change, with its default.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "config/service_config.h"
#include "core/reconstruction/segmenter.h"

namespace mocap {

/// How fast a recording is replayed: at its own times, or as fast as it is read.
enum class ReplayRate { kRealtime, kFast };

/// [source]: where frames come from.
struct SourceConfig {
  std::string driver = "simulated";  ///< "take", "simulated".
  std::filesystem::path take;
  ReplayRate rate = ReplayRate::kRealtime;
  bool loop = false;
  // For "simulated":
  std::string motion = "walk";
  double stature_mm = 1750;
  int cameras = 6;
  double fps = 30;
  std::uint64_t seed = 1;
};

/// [lcm]: where poses go.
struct LcmConfig {
  std::string url = "udpm://239.255.76.67:7667?ttl=0";
  std::string prefix;
  double voxels_hz = 0;  ///< 0: voxels are not published.
};

/// One [[cameras]] entry of a live studio.
struct CameraConfig {
  std::string name;
  std::string device;
};

struct Config {
  std::filesystem::path calibration;
  SourceConfig source;
  double voxel_mm = 25;
  SegmentationOptions segmentation;
  std::string body = "full";  ///< "mikic2003", "full", or the path of a table.
  LcmConfig lcm;
  std::vector<CameraConfig> cameras;
  ServiceConfig service;
};

}  // namespace mocap
