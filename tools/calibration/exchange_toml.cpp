// Pose2Sim, aniposelib, Caliscope.
#include <toml++/toml.h>

#include <sstream>

#include "core/errors.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/text_file.h"
#include "drivers/take/toml_text.h"
#include "tools/calibration/exchange.h"

namespace mocap {
namespace {

std::vector<double> Numbers(const toml::table& camera, const char* key, const std::string& where) {
  std::vector<double> numbers;
  const auto add = [&](const toml::node& node) {
    const auto number = node.value<double>();
    if (!number) throw SetupError(where + key + " holds something that is no number");
    numbers.push_back(*number);
  };
  const toml::array* array = camera[key].as_array();
  if (array == nullptr)
    throw SetupError(where + key + " is missing; an array of numbers is wanted");
  for (const toml::node& node : *array) {
    if (const toml::array* row = node.as_array()) {
      for (const toml::node& inner : *row) add(inner);
    } else {
      add(node);
    }
  }
  return numbers;
}

Matrix3 RowMajor(const std::vector<double>& n) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(n.data());
}

CameraCalibration ReadCamera(const std::string& name, const toml::table& table,
                             const std::string& file, double millimetres_per_unit) {
  const std::string where = file + ": " + name + ".";
  const std::vector<double> size = Numbers(table, "size", where);
  const std::vector<double> matrix = Numbers(table, "matrix", where);
  std::vector<double> distortion = Numbers(table, "distortions", where);
  const std::vector<double> rotation = Numbers(table, "rotation", where);
  const std::vector<double> translation = Numbers(table, "translation", where);
  if (size.size() != 2 || matrix.size() != 9 || translation.size() != 3 ||
      (rotation.size() != 3 && rotation.size() != 9) || distortion.size() > 5)
    throw SetupError(where +
                     "size, matrix, distortions, rotation or translation has another length "
                     "than 2, 9, up to 5, 3 or 9, and 3");
  CameraCalibration camera;
  camera.name = name;
  camera.width_px = static_cast<int>(size[0]);
  camera.height_px = static_cast<int>(size[1]);
  if (table["fisheye"].value_or(false)) {
    FisheyeLens lens{RowMajor(matrix), {}};
    distortion.resize(4);
    std::copy(distortion.begin(), distortion.end(), lens.distortion.begin());
    camera.lens = lens;
  } else {
    OpenCvLens lens{RowMajor(matrix), {}};
    distortion.resize(5);
    std::copy(distortion.begin(), distortion.end(), lens.distortion.begin());
    camera.lens = lens;
  }
  camera.X_CW.R = rotation.size() == 9 ? RowMajor(rotation)
                                       : ExpRotation({rotation[0], rotation[1], rotation[2]});
  camera.X_CW.p = millimetres_per_unit * Vector3(translation[0], translation[1], translation[2]);
  return camera;
}

std::string List(const double* numbers, int count) {
  std::string text = "[ ";
  for (int i = 0; i < count; ++i) text += TomlNumber(numbers[i]) + ", ";
  return text + "]";
}

}  // namespace

Cameras ReadPose2Sim(const std::filesystem::path& file, double millimetres_per_unit) {
  toml::table root;
  try {
    root = toml::parse_file(file.string());
  } catch (const toml::parse_error& error) {
    std::ostringstream line;
    line << file.string() << ':' << error.source().begin.line << ": " << error.description();
    throw SetupError(line.str());
  }
  // Caliscope has its cameras in a table of their own.
  const toml::table* tables = root["cameras"].as_table();
  if (tables == nullptr) tables = &root;
  Cameras cameras;
  for (const auto& [key, node] : *tables) {
    const toml::table* table = node.as_table();
    if (table == nullptr || !table->contains("matrix")) continue;
    std::string name = (*table)["name"].value_or(std::string(key.str()));
    if (!IsCameraName(name)) name = std::string(key.str());
    cameras.push_back(ReadCamera(name, *table, file.string(), millimetres_per_unit));
  }
  if (cameras.empty())
    throw SetupError(file.string() +
                     ": holds no camera; a table with matrix, distortions, rotation "
                     "and translation is wanted");
  return cameras;
}

void WritePose2Sim(const std::filesystem::path& file, const Cameras& cameras,
                   double millimetres_per_unit) {
  std::ostringstream out;
  for (const CameraCalibration& camera : cameras) {
    const auto* fisheye = std::get_if<FisheyeLens>(&camera.lens);
    const OpenCvLens lens = fisheye != nullptr ? OpenCvLens{} : AsOpenCvLens(camera);
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> K = fisheye != nullptr ? fisheye->K : lens.K;
    const Vector3 w = LogRotation(camera.X_CW.R);
    const Vector3 t = camera.X_CW.p / millimetres_per_unit;
    const double size[2] = {static_cast<double>(camera.width_px),
                            static_cast<double>(camera.height_px)};
    out << '[' << camera.name << "]\nname = " << TomlText(camera.name)
        << "\nsize = " << List(size, 2) << "\nmatrix = [ " << List(K.data(), 3) << ", "
        << List(K.data() + 3, 3) << ", " << List(K.data() + 6, 3) << ",]\ndistortions = "
        << (fisheye != nullptr ? List(fisheye->distortion.data(), 4)
                               : List(lens.distortion.data(), 5))
        << "\nrotation = " << List(w.data(), 3) << "\ntranslation = " << List(t.data(), 3)
        << "\nfisheye = " << (fisheye != nullptr ? "true" : "false") << "\n\n";
  }
  out << "[metadata]\nadjusted = true\nerror = 0.0\n";
  ReplaceText(file, out.str());
}

}  // namespace mocap
