// What the files of other programs say of cameras, before any of it is believed; and the one check
// that all of it passes.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

using Cameras = std::vector<CameraCalibration>;

/// Numbers and where they stand: "file:line: key", for messages.
struct ForeignNumbers {
  std::string where;
  std::vector<double> values;
};

/// One camera as a file has it.
struct ForeignCamera {
  std::string where;  ///< Where its name stands: "file: key".
  std::string name;
  /// Width and height [px]; the height, or both, are missing where the format does not tell.
  ForeignNumbers size_px;
  bool has_lens = true;  ///< Else it is not calibrated, and matrix and distortion say nothing.
  bool is_fisheye = false;
  ForeignNumbers matrix;      ///< Row-major.
  ForeignNumbers distortion;  ///< OpenCV's: none, 4, 5, 8, 12 or 14; a fisheye's: none or 4.
  std::optional<Lens> lens;   ///< Instead of matrix and distortion.
  /// A rotation vector or a matrix, row-major, world to camera; with the translation a pose.
  std::optional<ForeignNumbers> rotation;
  std::optional<ForeignNumbers> translation_mm;
};

/// What a person says of files that do not tell everything.
struct ImportOptions {
  double unit_mm = 1000;                           ///< One unit of a pose2sim file.
  std::optional<std::array<int, 2>> size_px = {};  ///< Of pictures, where a file does not tell.
  bool lenses_alone = false;  ///< Cameras without a pose stay, at the identity.
};

struct Imported {
  Cameras cameras;
  bool are_lenses_alone = false;   ///< Poses are at the identity.
  std::vector<std::string> notes;  ///< What a person should know, a line each.
};

/// Reads a number. @throws SetupError  beginning with `where`, when it is none or not finite.
double FiniteNumber(std::string_view text, const std::string& where);

/// Believes what a file says where it can be: names are names and none stands twice, pictures have
/// a size, lenses have as many coefficients as OpenCV knows and can be kept, rotations are
/// rotations. Nothing is invented: cameras without a pose are left out and told in the notes.
/// @param source  the file or folder, for messages.
/// @throws SetupError  naming file and key, what was found and what is wanted.
Imported CheckForeignCameras(const std::string& source, const std::vector<ForeignCamera>& found,
                             const ImportOptions& options);

/// Tells how much of the picture, from 0 to 1, shows no direction because the lens's radius folds;
/// what a fisheye sees beside itself does not count.
double FoldedShare(const CameraCalibration& camera);

}  // namespace mocap
