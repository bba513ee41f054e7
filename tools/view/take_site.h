// Serves a recorded take with its results to the page.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/evidence/keypoint_view.h"
#include "drivers/pixels/jpeg_encoder.h"
#include "tools/report/body_outline.h"
#include "tools/report/people_evaluation.h"
#include "tools/results/take_identity.h"
#include "tools/view/take_pictures.h"
#include "tools/view/view_server.h"
#include "tools/view/wire.h"

namespace mocap {

/// Answers /take.json, /poses.bin and /pictures.bin. Frames have the times of the first result. If
/// that is of several people, or missing, they have the times of the camera with most frames.
/// Keypoints are those of the take's keypoints.csv, if it has one.
/// Thread-safe.
class TakeSite {
 public:
  /// @param results  folders of mocap track or logs; a folder of several people counts as one
  /// result for each. @throws SetupError  for a take or result that cannot be read, and for a
  /// result of another take.
  /// @param prefix  of results that are logs, as of ReadResult.
  TakeSite(const std::filesystem::path& take, const std::vector<std::filesystem::path>& results,
           const std::optional<std::string>& prefix = {});

  const std::string& name() const { return pictures_.name(); }
  /// What is doubtful about the take and the results, one line each.
  const std::vector<std::string>& remarks() const { return remarks_; }
  /// Status 404 for unknown paths, 400 for invalid numbers.
  ViewReply Answer(const ViewRequest& request);

 private:
  /// A result, by the page's frames.
  struct ShownResult {
    std::string name;
    Evaluation evaluation;
    std::size_t group = 0;       ///< Results of one group were tracked together.
    std::string person = {};     ///< Name of one of several people; empty: a single person.
    int true_person = -1;        ///< Most frequent true person; -1: unknown.
    std::vector<int> rows = {};  ///< Row of each frame; -1: none.
  };

  void Add(const TakeIdentity& take, const std::filesystem::path& result,
           const std::optional<std::string>& prefix);
  /// Checks that a result is of the take. @throws SetupError
  void Accept(const TakeIdentity& take, const std::filesystem::path& result, Result& read);
  void ChooseTimes();
  std::string TakeJson() const;
  /// The requested result; null if the take has none.
  const ShownResult* ResultOf(const ViewRequest& request) const;
  std::string Poses(const ViewRequest& request) const;
  std::string Pictures(const ViewRequest& request);
  std::vector<DrawnOutlines> BodiesOf(const ShownResult& result, std::size_t frame,
                                      const TakePicture& picture) const;
  /// Bytes of the keypoints over a picture.
  std::string KeypointsOver(const TakePicture& picture) const;
  std::string DrawnOver(const TakePicture& picture, std::optional<double> unknown_share,
                        std::vector<DrawnOutlines> bodies);
  std::string PoseOf(const ShownResult& result, std::size_t frame) const;
  std::string TruthOf(const TruePerson& person, std::size_t frame) const;
  const PoseRow* RowOf(const ShownResult& result, std::size_t frame) const;

  std::mutex mutex_;  ///< Guards reading and encoding of pictures.
  TakePictures pictures_;
  JpegEncoder encoder_;
  Image<Bgr> reduced_;
  std::vector<std::uint8_t> jpeg_;
  std::vector<KeypointView> keypoints_;  ///< In order of time.
  std::vector<TruePerson> truth_;
  std::vector<ShownResult> results_;
  std::vector<std::string> remarks_;
  std::size_t groups_ = 0;
  std::vector<std::int64_t> times_ns_;
};

}  // namespace mocap
