#include "drivers/take/take_writer.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <set>
#include <stdexcept>

#include "core/errors.h"
#include "drivers/quoted.h"
#include "drivers/take/calibration_file.h"
#include "drivers/take/input_file.h"
#include "drivers/take/mask_video.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/text_file.h"
#include "drivers/take/toml_text.h"
#include "drivers/take/video_writer.h"

namespace mocap {

/// A text file whose write errors are reported.
class TableFile {
 public:
  explicit TableFile(const std::filesystem::path& file) : name_(file.string()), out_(file) {
    Check();
  }

  // Flushed, so that a row goes to the disk right after its frame.
  void Write(const std::string& text) {
    errno = 0;
    out_ << text << std::flush;
    Check();
  }

 private:
  void Check() const {
    if (out_) return;
    throw std::runtime_error(name_ + ": cannot be written: " + std::strerror(errno) +
                             "; check the free space on its disk");
  }

  std::string name_;
  std::ofstream out_;
};

/// A video, optionally with its table.
class RecordedVideo {
 public:
  RecordedVideo(const std::filesystem::path& video, const CameraCalibration& camera, double fps,
                VideoCodec codec)
      : video_(video, camera.width_px, camera.height_px, fps, VideoPixels::kBgr, codec),
        has_head_(camera.head) {}

  void AddTable(const std::filesystem::path& file) {
    table_.emplace(file);
    table_->Write(has_head_ ? "frame,timestamp_ns,pan_rad,tilt_rad\n" : "frame,timestamp_ns\n");
  }

  void Write(ImageView<const Bgr> image, std::int64_t capture_ns, const PanTiltAngles& angles) {
    MOCAP_CHECK(capture_ns > last_ns_);
    last_ns_ = capture_ns;
    video_.Write(image);
    std::string row = std::to_string(frame_++) + ',' + std::to_string(capture_ns);
    if (has_head_) row += ',' + TomlNumber(angles.pan_rad) + ',' + TomlNumber(angles.tilt_rad);
    if (table_) table_->Write(row + '\n');
  }

  void Skip(std::uint64_t count) { frame_ += count; }
  void Finish() {
    video_.Finish();
    table_.reset();
  }

 private:
  VideoWriter video_;
  std::optional<TableFile> table_;
  bool has_head_;
  std::int64_t last_ns_ = -1;
  std::uint64_t frame_ = 0;
};

namespace {

std::string NotesText(const std::vector<std::pair<std::string, std::string>>& notes) {
  std::string text;
  for (const auto& [key, value] : notes) text += key + " = " + TomlText(value) + '\n';
  return text;
}

std::string DescriptionText(const TakeDescription& description) {
  std::string text = "name = " + TomlText(description.name) +
                     "\nfps_nominal = " + TomlNumber(description.fps_nominal) + "\ncameras = [";
  for (const CameraCalibration& camera : description.cameras) {
    text += (text.back() == '[' ? "" : ", ") + TomlText(camera.name);
  }
  text += "]\n";
  return text + NotesText(description.notes);
}

std::string SpansText(const std::vector<FrameSpan>& spans) {
  std::string text = "[";
  for (const FrameSpan& span : spans) {
    text += (text == "[" ? "[" : ", [") + std::to_string(span.first) + ", " +
            std::to_string(span.last) + ']';
  }
  return text + ']';
}

std::string Fixed(double value, int decimals) {
  std::string text(32, '\0');
  text.resize(std::snprintf(text.data(), text.size(), "%.*f", decimals, value));
  return text;
}

void CheckNames(const TakeDescription& description) {
  std::set<std::string> seen;
  for (const CameraCalibration& camera : description.cameras) {
    if (!IsCameraName(camera.name)) {
      throw SetupError("camera " + Quoted(camera.name) +
                       ": the name is not valid; expected letters, digits, _ and -");
    }
    if (!seen.insert(camera.name).second) {
      throw SetupError("camera " + Quoted(camera.name) + ": appears twice");
    }
  }
}

}  // namespace

class TakeWriter::Impl {
 public:
  Impl(const std::filesystem::path& folder, const TakeDescription& description)
      : folder_(PlainFolder(folder)),
        layout_{folder_.string() + ".partial"},
        fps_(description.fps_nominal),
        codec_(description.codec),
        calibrations_(description.cameras),
        description_(DescriptionText(description)) {
    CheckNames(description);
    MakeFolder();
    try {
      Begin();
    } catch (...) {
      std::error_code error;
      std::filesystem::remove_all(layout_.folder, error);
      throw;
    }
    backgrounds_.resize(calibrations_.size());
    masks_.resize(calibrations_.size());
  }

  RecordedVideo& frames(int camera) { return frames_[Checked(camera)]; }

  RecordedVideo& background(int camera) {
    std::optional<RecordedVideo>& video = backgrounds_[Checked(camera)];
    if (!video) {
      const CameraCalibration& calibration = calibrations_[camera];
      std::filesystem::create_directory(layout_.BackgroundVideo("x").parent_path());
      video.emplace(layout_.BackgroundVideo(calibration.name), calibration, fps_, codec_);
      if (calibration.head) video->AddTable(layout_.BackgroundTable(calibration.name));
    }
    return *video;
  }

  void WriteUnseen(int camera, const Silhouette& unseen) {
    const std::string& name = calibrations_[Checked(camera)].name;
    std::filesystem::create_directory(layout_.Background());
    mocap::WriteMask(layout_.BackgroundUnseen(name), unseen);
  }

  VideoWriter& mask(int camera) {
    std::optional<VideoWriter>& video = masks_[Checked(camera)];
    if (!video) {
      const CameraCalibration& calibration = calibrations_[camera];
      std::filesystem::create_directory(layout_.Masks());
      video.emplace(layout_.Mask(calibration.name), calibration.width_px, calibration.height_px,
                    fps_, VideoPixels::kGray);
    }
    return *video;
  }

  void SetTruthColumns(const TruthColumns& columns, int people) {
    MOCAP_CHECK(truths_.empty() && people >= 1);
    truth_columns_ = columns;
    std::string header = "frame,timestamp_ns";
    for (const std::string& point : columns.points)
      for (const std::string& column : PointColumns(point)) header += ',' + column;
    for (const std::string& segment : columns.rotations)
      for (const std::string& column : RotationColumns(segment)) header += ',' + column;
    for (const std::string& point : columns.contacts) header += ',' + ContactColumn(point);
    truths_.reserve(people);
    for (int i = 0; i < people; ++i) {
      const TakeLayout folder = people == 1 ? layout_ : layout_.Person(i + 1);
      std::filesystem::create_directory(folder.folder);
      truths_.push_back({folder, TableFile(folder.TruthTable())});
      truths_.back().table.Write(header + '\n');
    }
  }

  void WriteTruth(std::int64_t frame, std::int64_t capture_ns, const TruthRow& truth, int person) {
    MOCAP_CHECK(truth.points_W.size() == truth_columns_.points.size() &&
                truth.rotations.size() == truth_columns_.rotations.size() &&
                truth.contacts.size() == truth_columns_.contacts.size());
    std::string row = std::to_string(frame) + ',' + std::to_string(capture_ns);
    for (const Vector3& point : truth.points_W)
      for (const double mm : point) row += ',' + Fixed(mm, 3);
    for (const Vector3& rotation : truth.rotations)
      for (const double rad : rotation) row += ',' + Fixed(rad, 6);
    for (const bool contact : truth.contacts) row += contact ? ",1" : ",0";
    truths_.at(person).table.Write(row + '\n');
  }

  void WriteTruthSizes(const TruthSizes& sizes, int person) {
    std::string text = "stature_mm = " + TomlNumber(sizes.stature_mm) +
                       "\nankle_to_sole_mm = " + TomlNumber(sizes.ankle_to_sole_mm) +
                       "\n\n[lengths]\n";
    for (const auto& [key, value] : sizes.lengths_mm)
      text += key + " = " + TomlNumber(value) + '\n';
    WriteText(truths_.at(person).folder.TruthSizes(), text);
  }

  const std::filesystem::path& partial_folder() const { return layout_.folder; }

  void AddNotes(const std::vector<std::pair<std::string, std::string>>& notes) {
    description_ += NotesText(notes);
    // Replaced atomically: a take without its description does not open.
    ReplaceText(layout_.Description(), description_);
  }

  void AddPeople(std::span<const PersonStay> people) {
    for (std::size_t i = 0; i < people.size(); ++i) {
      description_ += "\n[[person]]\nfolder = " +
                      TomlText(layout_.Person(static_cast<int>(i) + 1).folder.filename().string()) +
                      "\nin_room = " + SpansText(people[i].in_room) +
                      "\nwhole = " + SpansText(people[i].whole) +
                      "\ncovered = " + SpansText(people[i].covered) + '\n';
    }
    ReplaceText(layout_.Description(), description_);
  }

  void Finish() {
    for (RecordedVideo& video : frames_) video.Finish();
    for (auto& video : backgrounds_) {
      if (video) video->Finish();
    }
    for (auto& video : masks_) {
      if (video) video->Finish();
    }
    std::error_code error;
    std::filesystem::rename(layout_.folder, folder_, error);
    if (error) {
      throw std::runtime_error(layout_.folder.string() + ": cannot be renamed to " +
                               folder_.string() + ": " + error.message());
    }
  }

 private:
  std::size_t Checked(int camera) const {
    const auto index = static_cast<std::size_t>(camera);
    MOCAP_CHECK(index < calibrations_.size());
    return index;
  }

  void Begin() {
    WriteText(layout_.Description(), description_);
    WriteCalibration(layout_.Calibration(), calibrations_);
    for (const CameraCalibration& camera : calibrations_) {
      frames_.emplace_back(layout_.Video(camera.name), camera, fps_, codec_);
      frames_.back().AddTable(layout_.Table(camera.name));
    }
  }

  void MakeFolder() const {
    if (folder_.empty())
      throw SetupError("the name of the take's folder is empty; expected a name");
    RequireNewTake(folder_, layout_.folder);
    std::error_code error;
    std::filesystem::create_directories(layout_.folder, error);
    if (error)
      throw SetupError(layout_.folder.string() + ": cannot be created: " + error.message());
  }

  std::filesystem::path folder_;
  TakeLayout layout_;
  double fps_;
  VideoCodec codec_;
  std::vector<CameraCalibration> calibrations_;
  std::string description_;  ///< Text of take.toml.
  std::vector<RecordedVideo> frames_;
  std::vector<std::optional<RecordedVideo>> backgrounds_;
  std::vector<std::optional<VideoWriter>> masks_;
  struct Truth {
    TakeLayout folder;
    TableFile table;
  };
  std::vector<Truth> truths_;
  TruthColumns truth_columns_;
};

void RequireNewTake(const std::filesystem::path& folder, const std::filesystem::path& partial) {
  if (IsThere(folder))
    throw SetupError(folder.string() + ": exists; expected the name of a new folder");
  if (IsThere(partial)) {
    throw SetupError(folder.string() + ": " + partial.filename().string() +
                     " beside it is being written, or is of a command that was killed; expected "
                     "another name, or remove it");
  }
}

TakeWriter::TakeWriter(const std::filesystem::path& folder, const TakeDescription& description)
    : impl_(std::make_unique<Impl>(folder, description)) {}
TakeWriter::~TakeWriter() = default;

void TakeWriter::WriteFrame(int camera, ImageView<const Bgr> image, std::int64_t capture_ns,
                            const PanTiltAngles& angles) {
  impl_->frames(camera).Write(image, capture_ns, angles);
}
void TakeWriter::SkipFrames(int camera, std::uint64_t count) { impl_->frames(camera).Skip(count); }
void TakeWriter::WriteBackground(int camera, ImageView<const Bgr> image, std::int64_t capture_ns,
                                 const PanTiltAngles& angles) {
  impl_->background(camera).Write(image, capture_ns, angles);
}
void TakeWriter::WriteUnseen(int camera, const Silhouette& unseen) {
  impl_->WriteUnseen(camera, unseen);
}
void TakeWriter::WriteMask(int camera, ImageView<const std::uint8_t> mask) {
  impl_->mask(camera).Write(mask);
}
void TakeWriter::SetTruthColumns(const TruthColumns& columns, int people) {
  impl_->SetTruthColumns(columns, people);
}
void TakeWriter::WriteTruth(std::int64_t frame, std::int64_t capture_ns, const TruthRow& truth,
                            int person) {
  impl_->WriteTruth(frame, capture_ns, truth, person);
}
void TakeWriter::WriteTruthSizes(const TruthSizes& sizes, int person) {
  impl_->WriteTruthSizes(sizes, person);
}
void TakeWriter::AddPeople(std::span<const PersonStay> people) { impl_->AddPeople(people); }
const std::filesystem::path& TakeWriter::partial_folder() const { return impl_->partial_folder(); }
void TakeWriter::AddNotes(const std::vector<std::pair<std::string, std::string>>& notes) {
  impl_->AddNotes(notes);
}
void TakeWriter::Finish() { impl_->Finish(); }

}  // namespace mocap
