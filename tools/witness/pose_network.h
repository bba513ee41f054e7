// A neural network that finds the points of a person in a picture.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "core/evidence/keypoint_view.h"
#include "core/image.h"
#include "tools/witness/network_description.h"
#include "tools/witness/picture_region.h"

namespace mocap {

/// Asks a network by OpenCV's dnn, on one thread. The same picture gives the same points.
/// Thread-bound.
class PoseNetwork {
 public:
  /// Loads an ONNX file. A TOML file beside it describes it; without one it must be BlazePose or
  /// RTMPose, which its outputs show. Computes once, to see that the outputs are as described.
  /// @throws SetupError  naming the file, for one that OpenCV cannot read or compute, whose outputs
  /// do not fit, or that is not described.
  explicit PoseNetwork(const std::filesystem::path& model);
  ~PoseNetwork();
  PoseNetwork(PoseNetwork&&) noexcept;

  const NetworkDescription& description() const;

  /// Finds the points of the person whom a region shows. Beyond the picture all is black.
  /// @return  those that are landmarks and near the region, in the picture [px]. Empty: there are
  /// none, or the network gave numbers that are not finite.
  std::vector<Keypoint> Find(ImageView<const Bgr> picture, const PictureRegion& region);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap
