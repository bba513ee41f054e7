#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "config/load_config.h"
#include "config/toml_section.h"
#include "core/errors.h"
#include "drivers/take_layout.h"

namespace mocap {
namespace {

constexpr int kLargestSide_px = 16384;
constexpr double kRotationTolerance = 1e-3;

Matrix3 ReadRotation(TomlSection& camera) {
  const Matrix3 R = camera.Matrix("rotation");
  const double error = (R * R.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff();
  if (!(error < kRotationTolerance)) {
    camera.Fail("rotation",
                "is no rotation; three rows that are perpendicular unit vectors are wanted");
  }
  if (R.determinant() < 0) {
    camera.Fail("rotation", "is a reflection; a rotation, whose determinant is +1, is wanted");
  }
  // Inverses are taken by transposing, so digits that a person left out are put back.
  const Eigen::JacobiSVD<Matrix3> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return error < 1e-12 ? R : Matrix3(svd.matrixU() * svd.matrixV().transpose());
}

Vector3 ReadAxis(TomlSection& head, const std::string& key) {
  const Vector3 axis = head.Vector(key);
  if (!(std::abs(axis.norm() - 1) < kRotationTolerance)) {
    head.Fail(key, "has length " + std::to_string(axis.norm()) + "; a unit vector is wanted");
  }
  return axis.normalized();
}

Matrix3 ReadPinhole(TomlSection& camera) {
  const Matrix3 K = camera.Matrix("matrix");
  const bool form = K(0, 1) == 0 && K(1, 0) == 0 && K(2, 0) == 0 && K(2, 1) == 0 && K(2, 2) == 1;
  if (!form || !(K(0, 0) > 0) || !(K(1, 1) > 0)) {
    camera.Fail("matrix", "is not [[fx, 0, cx], [0, fy, cy], [0, 0, 1]] with fx and fy above 0");
  }
  return K;
}

template <typename OpenCvOrFisheye>
Lens ReadOpenCvLens(TomlSection& camera) {
  OpenCvOrFisheye lens;
  lens.K = ReadPinhole(camera);
  const std::vector<double> numbers = camera.Numbers("distortion", lens.distortion.size());
  std::copy(numbers.begin(), numbers.end(), lens.distortion.begin());
  return lens;
}

Lens ReadTsaiLens(TomlSection& camera) {
  TsaiLens lens;
  lens.focal_mm = camera.PositiveNumber("focal_mm");
  lens.kappa1 = camera.Number("kappa1");
  lens.sx = camera.PositiveNumber("sx");
  const std::vector<double> center = camera.Numbers("center_px", 2);
  const std::vector<double> pitch = camera.Numbers("pitch_mm", 2);
  if (!(pitch[0] > 0 && pitch[1] > 0)) {
    camera.Fail("pitch_mm", "has a number that is not above 0; the size of a pixel is wanted");
  }
  lens.center_px = {center[0], center[1]};
  lens.pitch_mm = {pitch[0], pitch[1]};
  return lens;
}

Lens ReadLens(TomlSection& camera) {
  switch (camera.Choice("model", {"tsai", "opencv", "fisheye"})) {
    case 0:
      return ReadTsaiLens(camera);
    case 1:
      return ReadOpenCvLens<OpenCvLens>(camera);
    default:
      return ReadOpenCvLens<FisheyeLens>(camera);
  }
}

PanTiltHead ReadHead(TomlSection& section) {
  PanTiltHead head;
  head.pan_axis_W = ReadAxis(section, "pan_axis");
  head.pan_point_W = section.Vector("pan_point_mm");
  head.tilt_axis_W = ReadAxis(section, "tilt_axis");
  head.tilt_point_W = section.Vector("tilt_point_mm");
  section.RejectUnknownKeys();
  return head;
}

CameraCalibration ReadCamera(const std::string& name, TomlSection section) {
  CameraCalibration camera;
  camera.name = name;
  const std::vector<double> size = section.Numbers("size_px", 2);
  for (const double side : size) {
    if (!(side >= 1 && side <= kLargestSide_px && side == std::floor(side))) {
      section.Fail("size_px", "is no size of a picture; [width, height] in pixels is wanted");
    }
  }
  camera.width_px = static_cast<int>(size[0]);
  camera.height_px = static_cast<int>(size[1]);
  camera.lens = ReadLens(section);
  camera.X_CW.R = ReadRotation(section);
  camera.X_CW.p = section.Vector("translation_mm");
  if (std::optional<TomlSection> head = section.Section("pan_tilt")) camera.head = ReadHead(*head);
  section.RejectUnknownKeys();
  return camera;
}

}  // namespace

std::vector<CameraCalibration> LoadCalibration(const std::filesystem::path& file) {
  TomlSection root = TomlSection::ReadFile(file);
  std::optional<TomlSection> section = root.Section("cameras");
  std::vector<CameraCalibration> cameras;
  if (section) {
    for (const std::string& name : section->Keys()) {
      if (!IsCameraName(name)) {
        section->Fail(name, "is no name of a camera; letters, digits, _ and - are wanted");
      }
      cameras.push_back(ReadCamera(name, *section->Section(name)));
    }
  }
  root.RejectUnknownKeys();
  if (cameras.empty()) root.Fail("cameras", "has none; [cameras.cam1] is wanted");
  return cameras;
}

}  // namespace mocap
