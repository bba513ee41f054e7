// A camera of another program's file, and the one check that all of them pass.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "tools/calibration/foreign_file.h"

namespace mocap {

using Cameras = std::vector<CameraCalibration>;

/// Turns the axes of a camera that looks along its negative z, with y up, to ours, and back.
inline const Matrix3 kTurnedOver = Vector3(1, -1, -1).asDiagonal();

/// One camera, as in a file.
struct ForeignCamera {
  std::string where;  ///< Place of its name: "file: key".
  std::string name;
  /// Width and height [px]; the height, or both, may be missing in the format.
  ForeignNumbers size_px;
  bool has_lens = true;  ///< If false, matrix and distortion are meaningless.
  bool is_fisheye = false;
  ForeignNumbers matrix;      ///< Row-major; or fx, fy, cx, cy and perhaps skew.
  ForeignNumbers distortion;  ///< OpenCV's: none, 4, 5, 8, 12 or 14; a fisheye's: none or 4.
  std::optional<Lens> lens;   ///< In place of matrix and distortion.
  /// World to camera: rotation vector, quaternion x y z w or row-major matrix; forms a pose with
  /// the translation.
  std::optional<ForeignNumbers> rotation;
  std::optional<ForeignNumbers> translation_mm;
  bool is_euler = false;     ///< The rotation is Rz Ry Rx, by the angles x y z.
  bool is_position = false;  ///< The translation is the lens's position in the world.
  bool looks_back = false;   ///< The camera looks along its negative z, with y up.
};

/// Values given by the user for incomplete files.
struct ImportOptions {
  double unit_mm = 1000;                           ///< Length of the unit of a pose2sim file.
  std::optional<std::array<int, 2>> size_px = {};  ///< Picture size, if a file lacks it.
  bool lenses_alone = false;  ///< Keep cameras without a pose, at the identity.
};

struct Imported {
  Cameras cameras;
  bool are_lenses_alone = false;   ///< Poses are the identity.
  std::vector<std::string> notes;  ///< Remarks for people, one line each.
};

/// Validates a file's data: names are valid and unique, pictures have a size, lenses have a number
/// of coefficients that OpenCV knows and are supported, rotations are rotations. Nothing is
/// invented. Cameras without a pose are omitted and listed in the notes.
/// @param source  the file or folder, for messages.
/// @throws SetupError  naming file and key, what was found and what was expected.
Imported CheckForeignCameras(const std::string& source, const std::vector<ForeignCamera>& found,
                             const ImportOptions& options);

/// Validates the pose of a camera that has one. @throws SetupError  as above.
RigidTransform CheckForeignPose(const ForeignCamera& camera);

/// Returns the share of the picture, from 0 to 1, that has no direction because the lens's radius
/// folds. Pixels outside a fisheye's field do not count.
double FoldedShare(const CameraCalibration& camera);

}  // namespace mocap
