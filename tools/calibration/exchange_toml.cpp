// Pose2Sim, aniposelib, Caliscope.
#include <algorithm>
#include <sstream>

#include "config/toml_section.h"
#include "core/errors.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/toml_text.h"
#include "tools/calibration/exchange.h"

namespace mocap {
namespace {

ForeignNumbers Numbers(TomlSection& table, const std::string& key) {
  ForeignNumbers numbers{table.Where(key), table.AllNumbers(key)};
  return numbers;
}

ForeignNumbers Needed(TomlSection& table, const std::string& key) {
  if (!table.Has(key)) table.Fail(key, "is missing; expected an array of numbers");
  return Numbers(table, key);
}

ForeignCamera ReadCamera(const std::string& key, TomlSection table, double unit_mm) {
  ForeignCamera camera;
  camera.where = table.Where("name");
  camera.name = table.Text("name", key);
  // Caliscope and aniposelib allow any camera name; if it is invalid, use the table's.
  if (!IsCameraName(camera.name) && IsCameraName(key)) camera.name = key;
  camera.has_lens = table.Has("matrix");
  if (!camera.has_lens) return camera;
  camera.size_px = Needed(table, "size");
  if (camera.size_px.values.size() < 2) table.Fail("size", "is not [width, height]");
  camera.is_fisheye = table.Flag("fisheye", false);
  camera.matrix = Needed(table, "matrix");
  camera.distortion = Needed(table, "distortions");
  const auto pose_part = [&](const std::string& part) -> std::optional<ForeignNumbers> {
    ForeignNumbers numbers = Numbers(table, part);
    if (numbers.values.empty()) return std::nullopt;
    return numbers;
  };
  camera.rotation = pose_part("rotation");
  camera.translation_mm = pose_part("translation");
  if (camera.translation_mm) {
    for (double& value : camera.translation_mm->values) value *= unit_mm;
  }
  return camera;
}

std::string List(const double* numbers, std::size_t count) {
  std::string text = "[ ";
  for (std::size_t i = 0; i < count; ++i) text += TomlNumber(numbers[i]) + ", ";
  return text + "]";
}

}  // namespace

std::vector<ForeignCamera> ReadPose2Sim(const std::filesystem::path& file, double unit_mm) {
  TomlSection root = TomlSection::ReadFile(file);
  // Caliscope has its cameras in a separate table.
  TomlSection tables = root.IsTable("cameras") ? *root.Section("cameras") : root;
  std::vector<ForeignCamera> cameras;
  for (const std::string& key : tables.Keys()) {
    if (!tables.IsTable(key)) continue;
    TomlSection table = *tables.Section(key);
    if (!table.Has("matrix") && !table.Has("size")) continue;
    cameras.push_back(ReadCamera(key, table, unit_mm));
  }
  if (cameras.empty())
    throw SetupError(file.string() +
                     ": contains no camera; expected a table with matrix, distortions, rotation "
                     "and translation");
  return cameras;
}

std::vector<TextFile> Pose2SimText(const Cameras& cameras, double unit_mm) {
  std::ostringstream out;
  for (const CameraCalibration& camera : cameras) {
    const auto* fisheye = std::get_if<FisheyeLens>(&camera.lens);
    const OpenCvLens lens = fisheye != nullptr ? OpenCvLens{} : AsOpenCvLens(camera);
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> K = fisheye != nullptr ? fisheye->K : lens.K;
    const Vector3 w = LogRotation(camera.X_CW.R);
    const Vector3 t = camera.X_CW.p / unit_mm;
    const double size[2] = {static_cast<double>(camera.width_px),
                            static_cast<double>(camera.height_px)};
    out << '[' << camera.name << "]\nname = " << TomlText(camera.name)
        << "\nsize = " << List(size, 2) << "\nmatrix = [ " << List(K.data(), 3) << ", "
        << List(K.data() + 3, 3) << ", " << List(K.data() + 6, 3) << ",]\ndistortions = "
        << (fisheye != nullptr ? List(fisheye->distortion.data(), 4)
                               : List(lens.distortion.data(), lens.IsRational() ? 8 : 5))
        << "\nrotation = " << List(w.data(), 3) << "\ntranslation = " << List(t.data(), 3)
        << "\nfisheye = " << (fisheye != nullptr ? "true" : "false") << "\n\n";
  }
  out << "[metadata]\nadjusted = true\nerror = 0.0\n";
  return {{"", out.str()}};
}

}  // namespace mocap
