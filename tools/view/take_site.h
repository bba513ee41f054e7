// A recorded take with its results, as the page asks for it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "drivers/pixels/jpeg_encoder.h"
#include "tools/report/body_outline.h"
#include "tools/report/evaluation.h"
#include "tools/view/take_pictures.h"
#include "tools/view/view_server.h"

namespace mocap {

/// Answers /take.json, /poses.bin and /pictures.bin. Frames are counted in the times of the first
/// result, or of the camera with most frames. Thread-safe.
class TakeSite {
 public:
  /// @param results  folders of mocap track or logs; a folder of several people counts as one
  /// result for each. @throws SetupError  for a take or result that cannot be read.
  TakeSite(const std::filesystem::path& take, const std::vector<std::filesystem::path>& results);

  const std::string& name() const { return pictures_.name(); }
  /// Status 404 for what is none of its, 400 for numbers of nothing.
  ViewReply Answer(const ViewRequest& request);

 private:
  /// A result in the frames of the page.
  struct ShownResult {
    std::string name;
    Evaluation evaluation;
    std::vector<int> rows;  ///< Of each frame; -1: it has none.
  };

  std::string TakeJson() const;
  /// The result that is asked for; null where the take has none.
  const ShownResult* ResultOf(const ViewRequest& request) const;
  std::string Poses(const ViewRequest& request) const;
  std::string Pictures(const ViewRequest& request);
  std::string DrawnOver(const TakePicture& picture, std::vector<BodyLine> body);
  std::string PoseOf(const ShownResult& result, std::size_t frame) const;
  std::string TruthOf(std::size_t frame) const;
  const PoseRow* RowOf(const ShownResult& result, std::size_t frame) const;

  std::mutex mutex_;  ///< Of reading and coding pictures.
  TakePictures pictures_;
  JpegEncoder encoder_;
  Image<Bgr> reduced_;
  std::vector<std::uint8_t> jpeg_;
  std::vector<ShownResult> results_;
  std::vector<std::int64_t> times_ns_;
  std::optional<TakeTruth> truth_;
};

}  // namespace mocap
