#include "tools/calibration/foreign_camera.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/errors.h"
#include "drivers/lowered.h"
#include "drivers/nearest_name.h"
#include "drivers/quoted.h"
#include "drivers/take/calibration_file.h"
#include "drivers/take/take_layout.h"
#include "tools/calibration/lens_conversion.h"
#include "tools/calibration/lens_parameters.h"

namespace mocap {
namespace {

// Some programs print rotations with few digits.
constexpr double kRotationTolerance = 1e-3;
constexpr double kQuaternionTolerance = 1e-2;
constexpr double kMostTurns_rad = 100;
constexpr double kFarthest_mm = 1e6;
constexpr double kNoSkew = 1e-9;
constexpr double kLongestFocal_px = 1e6, kLargestCoefficient = 1e6;
// A studio in metres, read as millimetres, is smaller than a hand.
constexpr double kSmallestStudio_mm = 50;

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

[[noreturn]] void Fail(const ForeignNumbers& numbers, const std::string& what) {
  throw SetupError(numbers.where + " " + what);
}

void CheckName(const ForeignCamera& found, std::set<std::string>& names) {
  if (!IsCameraName(found.name))
    throw SetupError(found.where + ": a camera is called " + Quoted(found.name) +
                     "; expected up to 64 letters, digits, _ and -: rename it there");
  if (!names.insert(found.name).second)
    throw SetupError(found.where + ": a second camera is called " + Quoted(found.name) +
                     "; expected a unique name for each: rename it there");
}

void CheckSize(const ForeignCamera& found, const ImportOptions& options,
               CameraCalibration& camera) {
  ForeignNumbers size = found.size_px;
  if (size.values.size() < 2) {
    if (!options.size_px)
      Fail(size, "does not contain the size of the pictures; add --size WIDTHxHEIGHT, in pixels");
    if (size.values.size() == 1 && size.values[0] != (*options.size_px)[0])
      Fail(size, fmt::format("has pictures {} px wide; --size has {}", size.values[0],
                             (*options.size_px)[0]));
    size.values.assign(options.size_px->begin(), options.size_px->end());
  }
  const auto is_side = [](double side) {
    return side >= 1 && side <= kLargestPicture_px && side == std::floor(side);
  };
  if (size.values.size() != 2 || !std::ranges::all_of(size.values, is_side))
    Fail(size, fmt::format("is {:.60}; expected width and height in whole pixels, from 1 to {}",
                           fmt::format("{}", fmt::join(size.values, " x ")), kLargestPicture_px));
  camera.width_px = static_cast<int>(size.values[0]);
  camera.height_px = static_cast<int>(size.values[1]);
}

Matrix3 CheckMatrix(const ForeignNumbers& matrix) {
  std::vector<double> n = matrix.values;
  if (n.size() == 4) n.push_back(0);
  if (n.size() == 5) n = {n[0], n[4], n[2], 0, n[1], n[3], 0, 0, 1};
  if (n.size() != 9)
    Fail(matrix, fmt::format("has {} numbers; expected 3 x 3, or fx fy cx cy", n.size()));
  Matrix3 K = Eigen::Map<const RowMajor3>(n.data());
  if (std::abs(K(0, 1)) < kNoSkew) K(0, 1) = 0;
  if (K(0, 1) != 0)
    Fail(matrix, fmt::format("has the skew {}; expected a lens without skew", K(0, 1)));
  if (K(1, 0) != 0 || K(2, 0) != 0 || K(2, 1) != 0 || K(2, 2) != 1)
    Fail(matrix, "is not [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]");
  const auto is_focal = [](double f) { return f > 0 && f <= kLongestFocal_px; };
  if (!is_focal(K(0, 0)) || !is_focal(K(1, 1)))
    Fail(matrix,
         fmt::format("has the focal lengths {} and {}; expected pixels, above 0 and up to {}",
                     K(0, 0), K(1, 1), kLongestFocal_px));
  if (!(K.topRightCorner<2, 1>().norm() <= kLongestFocal_px))
    Fail(matrix, "has its centre far outside any picture");
  return K;
}

Lens CheckLens(const ForeignCamera& found) {
  if (found.lens) {
    if (const double f = FocalPx(*found.lens); !(f > 0 && f <= kLongestFocal_px))
      throw SetupError(found.where +
                       fmt::format(": has a focal length of {} px; expected above 0 and up to {}",
                                   f, kLongestFocal_px));
    return *found.lens;
  }
  const Matrix3 K = CheckMatrix(found.matrix);
  const std::vector<double>& k = found.distortion.values;
  for (const double coefficient : k) {
    if (!(std::abs(coefficient) <= kLargestCoefficient))
      Fail(found.distortion, fmt::format("has {}, which no lens has", coefficient));
  }
  const std::string count = fmt::format("has {} numbers; ", k.size());
  if (found.is_fisheye) {
    FisheyeLens lens{K, {}};
    if (!k.empty() && k.size() != 4) Fail(found.distortion, count + "a fisheye has 4: k1 k2 k3 k4");
    std::ranges::copy(k, lens.distortion.begin());
    return lens;
  }
  static const std::set<std::size_t> kCounts = {0, 4, 5, 8, 12, 14};
  if (!kCounts.contains(k.size()))
    Fail(found.distortion, count + "expected 4, 5 or 8: k1 k2 p1 p2 [k3 [k4 k5 k6]]");
  OpenCvLens lens{K, {}};
  for (std::size_t i = 0; i < k.size(); ++i) {
    if (i < lens.distortion.size()) {
      lens.distortion[i] = k[i];
    } else if (k[i] != 0) {
      Fail(found.distortion,
           fmt::format("has {}, of OpenCV's {} model, which is not supported; calibrate with k1 to "
                       "k6, p1 and p2 only",
                       k[i], i < 12 ? "thin prism" : "tilted sensor"));
    }
  }
  return lens;
}

// As printed, often with few digits; only a vector gives an exact rotation.
Matrix3 CheckRotation(const ForeignCamera& found) {
  const ForeignNumbers& rotation = *found.rotation;
  const std::vector<double>& n = rotation.values;
  if (n.size() == 3) {
    const Vector3 w(n[0], n[1], n[2]);
    if (!(w.norm() < kMostTurns_rad))
      Fail(rotation, "is not a rotation vector: it turns too far; expected radians");
    if (!found.is_euler) return ExpRotation(w);
    return (Eigen::AngleAxisd(w.z(), Vector3::UnitZ()) *
            Eigen::AngleAxisd(w.y(), Vector3::UnitY()) * Eigen::AngleAxisd(w.x(), Vector3::UnitX()))
        .toRotationMatrix();
  }
  if (n.size() == 4) {
    const Eigen::Quaterniond q(n[3], n[0], n[1], n[2]);
    if (!(std::abs(q.norm() - 1) < kQuaternionTolerance))
      Fail(rotation, "is not a unit quaternion; expected x y z w");
    return q.normalized().toRotationMatrix();
  }
  if (n.size() != 9)
    Fail(rotation,
         fmt::format("has {} numbers; expected a rotation vector of 3, or a matrix of 3 x 3",
                     n.size()));
  const Matrix3 R = Eigen::Map<const RowMajor3>(n.data());
  if (!((R * R.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff() < kRotationTolerance))
    Fail(rotation, "is not a rotation; expected three rows that are perpendicular unit vectors");
  if (R.determinant() < 0)
    Fail(rotation, "is a reflection; expected a rotation, whose determinant is +1");
  return R;
}

// Notes possible but unusual values.
void Doubt(const std::string& source, const Cameras& cameras, std::vector<std::string>& notes) {
  std::set<std::string> lowered;
  for (const CameraCalibration& camera : cameras) {
    if (!lowered.insert(Lowered(camera.name)).second)
      notes.push_back(source + ": " + camera.name +
                      " differs from the name of another camera only in case; on file systems that "
                      "ignore case, both use the same file");
    if (const double folded = FoldedShare(camera); folded > 0)
      notes.push_back(fmt::format(
          "{}: {}: its lens folds inside the picture: {:.0f} % of it, at the rim, shows no "
          "direction; calibrate it with views that fill the picture",
          source, camera.name, std::max(1.0, 100 * folded)));
  }
}

void DoubtUnit(const std::string& source, const Cameras& cameras, std::vector<std::string>& notes) {
  double widest_mm = 0;
  for (const CameraCalibration& a : cameras) {
    for (const CameraCalibration& b : cameras)
      widest_mm = std::max(widest_mm, (a.X_CW.Inverse().p - b.X_CW.Inverse().p).norm());
  }
  if (cameras.size() > 1 && widest_mm < kSmallestStudio_mm)
    notes.push_back(fmt::format(
        "{}: all cameras stand within {:.1f} mm; its lengths may be in metres instead of "
        "millimetres (--unit)",
        source, widest_mm));
}

}  // namespace

RigidTransform CheckForeignPose(const ForeignCamera& found) {
  Matrix3 R = CheckRotation(found);
  if (found.looks_back) R = kTurnedOver * R;
  const ForeignNumbers& translation = *found.translation_mm;
  if (translation.values.size() != 3)
    Fail(translation, fmt::format("has {} numbers; expected 3", translation.values.size()));
  Vector3 t = Eigen::Map<const Vector3>(translation.values.data());
  if (found.is_position) t = -(R * t);
  if (!(t.norm() <= kFarthest_mm))
    Fail(translation,
         fmt::format("is {:.0f} m long; check the unit of length (--unit)", t.norm() / 1000));
  const bool is_exact = found.rotation->values.size() == 3 && !found.is_euler;
  return {is_exact ? R : NearestRotation(R), t};
}

Imported CheckForeignCameras(const std::string& source, const std::vector<ForeignCamera>& found,
                             const ImportOptions& options) {
  Imported imported;
  imported.are_lenses_alone = options.lenses_alone;
  std::set<std::string> names;
  std::vector<std::string> no_lens, no_pose;
  for (const ForeignCamera& foreign : found) {
    CheckName(foreign, names);
    if (!foreign.has_lens) {
      no_lens.push_back(foreign.name);
      continue;
    }
    CameraCalibration camera;
    camera.name = foreign.name;
    CheckSize(foreign, options, camera);
    camera.lens = CheckLens(foreign);
    if (HiddenShare(camera) == 1)
      throw SetupError(foreign.where + ": " + foreign.name +
                       ": the lens shows nothing in its picture; expected a focal length and "
                       "centre that fit it");
    if (foreign.rotation.has_value() != foreign.translation_mm.has_value())
      throw SetupError(
          foreign.where + ": " + foreign.name + " has a " +
          (foreign.rotation ? "rotation and no translation" : "translation and no rotation") +
          "; expected both or neither");
    if (foreign.rotation) {
      camera.X_CW = CheckForeignPose(foreign);
    } else if (!options.lenses_alone) {
      no_pose.push_back(foreign.name);
      continue;
    }
    imported.cameras.push_back(std::move(camera));
  }
  if (imported.cameras.empty() && no_pose.empty())
    throw SetupError(source + ": contains no camera with a lens; expected a calibration");
  if (imported.cameras.empty())
    throw SetupError(source + ": has no pose of any camera, only intrinsics (" +
                     ListedNames(no_pose) +
                     "); add --lenses to keep those for mocap calibrate extrinsics --intrinsics");
  if (!no_lens.empty())
    imported.notes.push_back(source + ": has no lens of " + ListedNames(no_lens) + "; left out");
  if (!no_pose.empty())
    imported.notes.push_back(source + ": has no pose of " + ListedNames(no_pose) + "; left out");
  Doubt(source, imported.cameras, imported.notes);
  if (!options.lenses_alone) DoubtUnit(source, imported.cameras, imported.notes);
  return imported;
}

}  // namespace mocap
