// Records a take: frames and times of all cameras, calibration, background and truth, in a folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/silhouette/silhouette.h"
#include "drivers/take/truth_columns.h"
#include "drivers/take/video_writer.h"

namespace mocap {

/// Contents of take.toml.
struct TakeDescription {
  std::string name;
  double fps_nominal = 30;
  std::vector<CameraCalibration> cameras;
  /// Further keys of take.toml, all strings: origin of the take.
  std::vector<std::pair<std::string, std::string>> notes;
  VideoCodec codec = VideoCodec::kHuffYuv;
};

/// True sizes of the person in a take: truth.toml.
struct TruthSizes {
  double stature_mm = 0;
  double ankle_to_sole_mm = 0;
  /// [lengths], e.g. {"torso_mm", 588.2}.
  std::vector<std::pair<std::string, double>> lengths_mm;
};

/// A range of frames, counted from 0, ends included.
struct FrameSpan {
  std::int64_t first = 0, last = 0;
};

/// Presence of one of several people, for take.toml: when any part of the body is in the room, when
/// all of it is, and when four or more pictures show all of it.
struct PersonStay {
  std::vector<FrameSpan> in_room, whole, covered;
};

/// Checks that nothing is where a take will be written. @param partial  until it is complete.
/// @throws SetupError
void RequireNewTake(const std::filesystem::path& folder, const std::filesystem::path& partial);

/// Writes a take into FOLDER.partial, which is renamed to FOLDER when complete.
///
/// After an interruption, FOLDER.partial opens as a take. The same calls give the same bytes.
/// WriteFrame, SkipFrames, WriteBackground and WriteUnseen may be called from one thread per
/// camera; everything else is thread-bound.
class TakeWriter {
 public:
  /// @throws SetupError  when the folder or its .partial exists or cannot be created, or when the
  /// description names a camera twice.
  /// @throws std::runtime_error  when something cannot be written; then nothing is left behind.
  TakeWriter(const std::filesystem::path& folder, const TakeDescription& description);
  ~TakeWriter();

  /// Appends a frame of a camera.
  /// @param camera      its index in the description.
  /// @param capture_ns  must increase from frame to frame.
  /// @param angles      written for a camera on a head.
  void WriteFrame(int camera, ImageView<const Bgr> image, std::int64_t capture_ns,
                  const PanTiltAngles& angles = {});
  /// Skips frame numbers of a camera for frames that it missed.
  void SkipFrames(int camera, std::uint64_t count);
  /// Appends a frame of the empty studio.
  void WriteBackground(int camera, ImageView<const Bgr> image, std::int64_t capture_ns,
                       const PanTiltAngles& angles = {});
  /// Writes where a fixed camera never saw the empty studio, once.
  void WriteUnseen(int camera, const Silhouette& unseen);
  /// Appends a true mask: 0 background, 255 person; one per frame.
  void WriteMask(int camera, ImageView<const std::uint8_t> mask);

  /// Begins truth.csv; call it before the first WriteTruth.
  /// @param people  if several, each has its own file: person-1/truth.csv and so on.
  void SetTruthColumns(const TruthColumns& columns, int people = 1);
  /// Appends a row of truth.
  /// @param frame   increases from row to row.
  /// @param person  from 0.
  void WriteTruth(std::int64_t frame, std::int64_t capture_ns, const TruthRow& truth,
                  int person = 0);
  /// @pre SetTruthColumns() was called.
  void WriteTruthSizes(const TruthSizes& sizes, int person = 0);

  /// The folder during writing.
  const std::filesystem::path& partial_folder() const;
  /// Adds keys to take.toml.
  void AddNotes(const std::vector<std::pair<std::string, std::string>>& notes);

  /// Adds the presence of several people to take.toml; no notes may follow.
  void AddPeople(std::span<const PersonStay> people);

  /// Completes all files and renames the folder.
  /// @throws std::runtime_error  here and above, when something cannot be written.
  void Finish();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap
