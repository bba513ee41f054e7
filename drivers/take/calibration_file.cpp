#include "drivers/take/calibration_file.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <string>

#include "core/errors.h"
#include "drivers/quoted.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/text_file.h"
#include "drivers/take/toml_text.h"
#include "drivers/utc_time.h"

namespace mocap {
namespace {

std::string Array(std::span<const double> numbers) {
  std::string text = "[";
  for (const double number : numbers) text += (text.size() > 1 ? ", " : "") + TomlNumber(number);
  return text + "]";
}

std::string Array(const Vector2& v) { return Array(std::span(v.data(), 2)); }
std::string Array(const Vector3& v) { return Array(std::span(v.data(), 3)); }

std::string Array(const Matrix3& m) {
  std::string text = "[";
  for (int i = 0; i < 3; ++i) text += (i > 0 ? ", " : "") + Array(Vector3(m.row(i)));
  return text + "]";
}

void Write(std::ostream& out, const TsaiLens& lens) {
  out << "focal_mm = " << TomlNumber(lens.focal_mm) << '\n'
      << "kappa1 = " << TomlNumber(lens.kappa1) << '\n'
      << "sx = " << TomlNumber(lens.sx) << '\n'
      << "center_px = " << Array(lens.center_px) << '\n'
      << "pitch_mm = " << Array(lens.pitch_mm) << '\n';
}

void Write(std::ostream& out, const OpenCvLens& lens) {
  const std::span all(lens.distortion);
  out << "matrix = " << Array(lens.K) << '\n'
      << "distortion = " << Array(lens.IsRational() ? all : all.first(5)) << '\n';
}

void Write(std::ostream& out, const FisheyeLens& lens) {
  out << "matrix = " << Array(lens.K) << '\n' << "distortion = " << Array(lens.distortion) << '\n';
}

bool IsFinite(const TsaiLens& lens) {
  return std::isfinite(lens.focal_mm) && std::isfinite(lens.kappa1) && std::isfinite(lens.sx) &&
         lens.center_px.allFinite() && lens.pitch_mm.allFinite();
}

template <typename OpenCvOrFisheye>
bool IsFinite(const OpenCvOrFisheye& lens) {
  return lens.K.allFinite() && std::all_of(lens.distortion.begin(), lens.distortion.end(),
                                           [](double k) { return std::isfinite(k); });
}

const char* ModelOf(const Lens& lens) {
  if (std::holds_alternative<TsaiLens>(lens)) return "tsai";
  return std::holds_alternative<OpenCvLens>(lens) ? "opencv" : "fisheye";
}

// Omits default values.
void WriteUnless(double usual, const char* key, double value, std::ostream& out) {
  if (value != usual) out << key << " = " << TomlNumber(value) << '\n';
}

void Write(std::ostream& out, const CameraCalibration& camera) {
  out << "[cameras." << camera.name << "]\n"
      << "model = \"" << ModelOf(camera.lens) << "\"\n"
      << "size_px = [" << camera.width_px << ", " << camera.height_px << "]\n";
  std::visit([&out](const auto& lens) { Write(out, lens); }, camera.lens);
  out << "rotation = " << Array(camera.X_CW.R) << '\n'
      << "translation_mm = " << Array(camera.X_CW.p) << '\n';
  if (!camera.head) return;
  out << "\n[cameras." << camera.name << ".pan_tilt]\n"
      << "pan_axis = " << Array(camera.head->pan_axis_W) << '\n'
      << "pan_point_mm = " << Array(camera.head->pan_point_W) << '\n'
      << "tilt_axis = " << Array(camera.head->tilt_axis_W) << '\n'
      << "tilt_point_mm = " << Array(camera.head->tilt_point_W) << '\n';
  WriteUnless(1, "pan_scale", camera.head->pan_scale, out);
  WriteUnless(1, "tilt_scale", camera.head->tilt_scale, out);
  WriteUnless(0, "pan_zero_rad", camera.head->zero.pan_rad, out);
  WriteUnless(0, "tilt_zero_rad", camera.head->zero.tilt_rad, out);
}

void Write(std::ostream& out, const CalibrationRecord& record) {
  const auto write_time = [&out](const char* key, std::int64_t epoch_s) {
    if (epoch_s != 0) out << key << " = " << TomlText(UtcText(epoch_s)) << '\n';
  };
  if (record.made_s != 0) {
    out << "\n[made]\n";
    write_time("time", record.made_s);
    WriteUnless(0, "reprojection_px", record.reprojection_px, out);
    write_time("refined", record.refined_s);
  }
  if (record.checked_s == 0) return;
  out << "\n[health]\n";
  write_time("time", record.checked_s);
  for (const CameraOffset& offset : record.offsets) {
    out << "[health.cameras." << offset.camera << "]\noff_px = " << TomlNumber(offset.px)
        << "\nmoved = " << (offset.has_moved ? "true" : "false") << '\n';
  }
}

// Faults that would break a reader, or a user of the file.
std::string FaultOf(const CameraCalibration& camera) {
  constexpr double kRotationTolerance = 1e-6;
  if (!IsCameraName(camera.name)) return "its name is not valid; expected letters, digits, _ and -";
  const auto is_side = [](int side_px) { return side_px >= 1 && side_px <= kLargestPicture_px; };
  if (!is_side(camera.width_px) || !is_side(camera.height_px))
    return "its picture size is not valid";
  if (!std::visit([](const auto& lens) { return IsFinite(lens); }, camera.lens))
    return "its lens has a number that is not finite";
  const Matrix3& R = camera.X_CW.R;
  const double error = (R * R.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff();
  if (!(error < kRotationTolerance) || !(R.determinant() > 0)) return "its rotation is not valid";
  if (!camera.X_CW.p.allFinite()) return "its translation is not finite";
  if (!camera.head) return "";
  const PanTiltHead& head = *camera.head;
  const bool is_finite = head.pan_axis_W.allFinite() && head.pan_point_W.allFinite() &&
                         head.tilt_axis_W.allFinite() && head.tilt_point_W.allFinite() &&
                         std::isfinite(head.pan_scale) && std::isfinite(head.tilt_scale) &&
                         std::isfinite(head.zero.pan_rad) && std::isfinite(head.zero.tilt_rad);
  return is_finite ? "" : "its head has a number that is not finite";
}

void RequireSound(const std::filesystem::path& file, std::span<const CameraCalibration> cameras) {
  const auto fail = [&](const std::string& name, const std::string& what) {
    throw SetupError(file.string() + ": is not written: camera " + Quoted(name) + ": " + what);
  };
  std::set<std::string> names;
  for (const CameraCalibration& camera : cameras) {
    if (const std::string fault = FaultOf(camera); !fault.empty()) fail(camera.name, fault);
    if (!names.insert(camera.name).second) fail(camera.name, "another camera has its name");
  }
}

}  // namespace

std::vector<std::string> CameraNames(std::span<const CameraCalibration> cameras) {
  std::vector<std::string> names;
  for (const CameraCalibration& camera : cameras) names.push_back(camera.name);
  return names;
}

std::string CalibrationText(const std::filesystem::path& file,
                            std::span<const CameraCalibration> cameras,
                            const CalibrationRecord& record) {
  RequireSound(file, cameras);
  std::ostringstream out;
  for (const CameraCalibration& camera : cameras) {
    if (&camera != cameras.data()) out << '\n';
    Write(out, camera);
  }
  Write(out, record);
  return out.str();
}

void WriteCalibration(const std::filesystem::path& file, std::span<const CameraCalibration> cameras,
                      const CalibrationRecord& record) {
  ReplaceText(file, CalibrationText(file, cameras, record));
}

}  // namespace mocap
