#include <algorithm>
#include <cmath>

#include "config/load_config.h"
#include "config/toml_section.h"
#include "core/errors.h"
#include "drivers/take/take_layout.h"
#include "drivers/utc_time.h"

namespace mocap {
namespace {

constexpr double kRotationTolerance = 1e-3;

Matrix3 ReadRotation(TomlSection& camera) {
  const Matrix3 R = camera.Matrix("rotation");
  const double error = (R * R.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff();
  if (!(error < kRotationTolerance)) {
    camera.Fail("rotation",
                "is not a rotation; expected three rows that are perpendicular unit vectors");
  }
  if (R.determinant() < 0) {
    camera.Fail("rotation", "is a reflection; expected a rotation, whose determinant is +1");
  }
  // The inverse is taken as the transpose, so rounded digits must be corrected.
  return NearestRotation(R);
}

Vector3 ReadAxis(TomlSection& head, const std::string& key) {
  const Vector3 axis = head.Vector(key);
  if (!(std::abs(axis.norm() - 1) < kRotationTolerance)) {
    head.Fail(key, "has length " + std::to_string(axis.norm()) + "; expected a unit vector");
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

Lens ReadOpenCvLens(TomlSection& camera) {
  OpenCvLens lens;
  lens.K = ReadPinhole(camera);
  const std::vector<double> numbers = camera.Numbers("distortion", 5, lens.distortion.size());
  std::copy(numbers.begin(), numbers.end(), lens.distortion.begin());
  return lens;
}

Lens ReadFisheyeLens(TomlSection& camera) {
  FisheyeLens lens;
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
    camera.Fail("pitch_mm", "has a number that is not above 0; expected the size of a pixel");
  }
  lens.center_px = {center[0], center[1]};
  lens.pitch_mm = {pitch[0], pitch[1]};
  return lens;
}

Lens ReadLens(TomlSection& camera) {
  camera.Reserve({"focal_mm", "kappa1", "sx", "center_px", "pitch_mm"}, "needs model = \"tsai\"");
  camera.Reserve({"matrix", "distortion"}, "needs model = \"opencv\" or \"fisheye\"");
  switch (camera.Choice("model", {"tsai", "opencv", "fisheye"})) {
    case 0:
      return ReadTsaiLens(camera);
    case 1:
      return ReadOpenCvLens(camera);
    default:
      return ReadFisheyeLens(camera);
  }
}

PanTiltHead ReadPanTiltHead(TomlSection& section) {
  PanTiltHead head;
  head.pan_axis_W = ReadAxis(section, "pan_axis");
  head.pan_point_W = section.Vector("pan_point_mm");
  head.tilt_axis_W = ReadAxis(section, "tilt_axis");
  head.tilt_point_W = section.Vector("tilt_point_mm");
  head.pan_scale = section.PositiveNumber("pan_scale", 1);
  head.tilt_scale = section.PositiveNumber("tilt_scale", 1);
  head.zero = {section.Number("pan_zero_rad", 0), section.Number("tilt_zero_rad", 0)};
  section.RejectUnknownKeys();
  return head;
}

CameraCalibration ReadCalibratedCamera(const std::string& name, TomlSection section) {
  CameraCalibration camera;
  camera.name = name;
  const std::vector<double> size = section.Numbers("size_px", 2);
  for (const double side : size) {
    if (!(side >= 1 && side <= kLargestPicture_px && side == std::floor(side))) {
      section.Fail("size_px", "is not the size of a picture; expected [width, height] in pixels");
    }
  }
  camera.width_px = static_cast<int>(size[0]);
  camera.height_px = static_cast<int>(size[1]);
  camera.lens = ReadLens(section);
  camera.X_CW.R = ReadRotation(section);
  camera.X_CW.p = section.Vector("translation_mm");
  if (std::optional<TomlSection> head = section.Section("pan_tilt"))
    camera.head = ReadPanTiltHead(*head);
  section.RejectUnknownKeys();
  return camera;
}

std::int64_t ReadTime(TomlSection& section, const std::string& key) {
  if (!section.Has(key)) return 0;
  const std::optional<std::int64_t> time_s = UtcFromText(section.Text(key));
  if (!time_s) section.Fail(key, "is not a time such as \"2026-11-21T20:05:00Z\"");
  return *time_s;
}

void ReadHealth(TomlSection health, CalibrationRecord& record) {
  record.checked_s = ReadTime(health, "time");
  std::optional<TomlSection> cameras = health.Section("cameras");
  for (const std::string& name : cameras ? cameras->Keys() : std::vector<std::string>{}) {
    std::optional<TomlSection> camera = cameras->Section(name);
    if (!camera) cameras->Fail(name, "is not a table of off_px and moved");
    record.offsets.push_back({name, camera->Number("off_px"), camera->Flag("moved")});
    camera->RejectUnknownKeys();
  }
  health.RejectUnknownKeys();
}

CalibrationRecord ReadRecord(TomlSection& root) {
  CalibrationRecord record;
  if (std::optional<TomlSection> made = root.Section("made")) {
    record.made_s = ReadTime(*made, "time");
    record.reprojection_px = made->NumberWithin("reprojection_px", 0, 1000, 0);
    record.refined_s = ReadTime(*made, "refined");
    made->RejectUnknownKeys();
  }
  if (std::optional<TomlSection> health = root.Section("health")) ReadHealth(*health, record);
  return record;
}

std::vector<CameraCalibration> ReadCalibration(TomlSection root) {
  std::optional<TomlSection> section = root.Section("cameras");
  std::vector<CameraCalibration> cameras;
  if (section) {
    for (const std::string& name : section->Keys()) {
      if (!IsCameraName(name)) {
        section->Fail(name, "is not a valid camera name; expected letters, digits, _ and -");
      }
      cameras.push_back(ReadCalibratedCamera(name, *section->Section(name)));
    }
  }
  ReadRecord(root);
  root.RejectUnknownKeys();
  if (cameras.empty()) root.Fail("cameras", "is empty; expected [cameras.cam1]");
  return cameras;
}

}  // namespace

CalibrationRecord LoadCalibrationRecord(const std::filesystem::path& file) {
  TomlSection root = TomlSection::ReadFile(file);
  return ReadRecord(root);
}

std::vector<CameraCalibration> LoadCalibration(const std::filesystem::path& file) {
  return ReadCalibration(TomlSection::ReadFile(file));
}

std::vector<CameraCalibration> ParseCalibration(std::string_view text, const std::string& name) {
  return ReadCalibration(TomlSection::ReadText(text, name));
}

}  // namespace mocap
