// What a pose network wants and gives, as a file beside it says or as well-known ones do.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/body/landmarks.h"
#include "tools/witness/keypoint_decoders.h"

namespace mocap {

/// How a network gives points.
enum class AnswerKind { kHeatmaps, kSimcc, kCoordinates };

struct NetworkDescription {
  int width_px = 0, height_px = 0;  ///< Of the input, 1 × 3 × height × width.
  bool takes_rgb = true;            ///< Otherwise blue comes first.
  /// Of the colours, in their order: (value - mean) / std, for values from 0 to 255.
  std::array<double, 3> mean = {0, 0, 0}, std = {255, 255, 255};
  AnswerKind kind = AnswerKind::kCoordinates;
  std::vector<std::string> outputs;  ///< One; of SimCC along x and along y.
  std::string presence = "";  ///< Output whose probability of a person scales scores; empty: none.
  std::vector<std::optional<Landmark>> landmarks;  ///< In order; empty ones are not used.
  std::vector<AnswerColumn> columns = {};          ///< Of a point with coordinates.
  bool scores_are_logits = false;

  double aspect() const { return static_cast<double>(width_px) / height_px; }
};

/// The file that describes a network: its own name with `.toml` for `.onnx`.
std::filesystem::path DescriptionBeside(const std::filesystem::path& model);

/// Reads such a file.
/// @throws SetupError  naming file, line and key, for a key that is not known too.
NetworkDescription ReadNetworkDescription(const std::filesystem::path& file);

/// MediaPipe's landmark network BlazePose GHUM.
NetworkDescription BlazePoseDescription(const std::string& output, const std::string& presence);
/// MMPose's RTMPose with 17 points of COCO, 26 of HALPE or 133 of COCO-WholeBody.
NetworkDescription RtmPoseDescription(int points, int width_px, int height_px);

}  // namespace mocap
