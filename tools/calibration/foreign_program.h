// What other programs mean by the keys of their files, and the functions that read and write them.
#pragma once

#include <string>
#include <vector>

#include "tools/calibration/foreign_camera.h"

namespace mocap {

/// A file in memory.
struct TextFile {
  std::string name;  ///< In its folder; for readers the path; empty for a single file to write.
  std::string text;
};
using TextFiles = std::vector<TextFile>;

/// A key that names a camera's lens model, and its words for a pinhole and for a fisheye.
struct LensKey {
  std::string key, pinhole, fisheye;
};

/// A program's format. Several keys of one value are separated by blanks; `*` is the camera's name,
/// `a|b` are names of different versions, `a|0` is 0 where it is missing. Values are as in
/// ForeignCamera, but in the program's units.
struct ForeignProgram {
  std::string name;
  /// Files of its folder: their names, or extensions if each camera has one. None: a single file.
  std::vector<std::string> files{};
  std::string size{}, matrix{}, distortion{}, rotation{}, translation{};
  std::vector<LensKey> lens_keys{};
  double unit_mm = 1, unit_px = 1;
  bool has_own_unit = false;    ///< The user says what unit_mm is.
  bool needs_lens = true;       ///< If false, cameras without intrinsics are left out.
  bool may_lack_poses = false;  ///< Files without any pose are a program's intrinsics.
  bool is_euler = false, is_position = false, looks_back = false;  ///< As in ForeignCamera.
  std::vector<ForeignCamera> (*read)(const TextFiles&, const ForeignProgram&) = nullptr;
  TextFiles (*write)(const Cameras&, const ForeignProgram&) = nullptr;  ///< Null: only read.
};

/// All that can be read. Lengths and poses become millimetres, world to camera.
const std::vector<ForeignProgram>& ForeignPrograms();

/// Steps over the picture, along each side, at which Vicon's lenses are fitted.
inline constexpr int kViconGrid = 12;

/// Readers return what files hold, and throw SetupError where that is no camera of the program.
std::vector<ForeignCamera> ReadPose2Sim(const TextFiles& files, const ForeignProgram& program);
std::vector<ForeignCamera> ReadEasyMocap(const TextFiles& files, const ForeignProgram& program);
std::vector<ForeignCamera> ReadOpenCv(const TextFiles& files, const ForeignProgram& program);
std::vector<ForeignCamera> ReadKalibr(const TextFiles& files, const ForeignProgram& program);
std::vector<ForeignCamera> ReadWillson(const TextFiles& files, const ForeignProgram& program);
std::vector<ForeignCamera> ReadQualisys(const TextFiles& files, const ForeignProgram& program);
std::vector<ForeignCamera> ReadVicon(const TextFiles& files, const ForeignProgram& program);

/// Writers throw SetupError for a lens that the format cannot represent.
TextFiles Pose2SimText(const Cameras& cameras, const ForeignProgram& program);
TextFiles EasyMocapText(const Cameras& cameras, const ForeignProgram& program);
TextFiles OpenCvText(const Cameras& cameras, const ForeignProgram& program);
TextFiles WillsonText(const Cameras& cameras, const ForeignProgram& program);
TextFiles QualisysText(const Cameras& cameras, const ForeignProgram& program);
TextFiles ViconText(const Cameras& cameras, const ForeignProgram& program);

}  // namespace mocap
