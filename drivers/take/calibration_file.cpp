#include "drivers/take/calibration_file.h"

#include <initializer_list>
#include <sstream>
#include <string>
#include <type_traits>

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

template <typename OpenCvOrFisheye>
void Write(std::ostream& out, const OpenCvOrFisheye& lens) {
  out << "matrix = " << Array(lens.K) << '\n' << "distortion = " << Array(lens.distortion) << '\n';
}

const char* ModelOf(const Lens& lens) {
  if (std::holds_alternative<TsaiLens>(lens)) return "tsai";
  return std::holds_alternative<OpenCvLens>(lens) ? "opencv" : "fisheye";
}

// What readers may leave out.
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

}  // namespace

void WriteCalibration(const std::filesystem::path& file, std::span<const CameraCalibration> cameras,
                      const CalibrationRecord& record) {
  std::ostringstream out;
  for (const CameraCalibration& camera : cameras) {
    if (&camera != cameras.data()) out << '\n';
    Write(out, camera);
  }
  Write(out, record);
  ReplaceText(file, out.str());
}

}  // namespace mocap
