// OpenCV's own YAML and XML, ROS's camera_info, EasyMocap.
#include <fmt/format.h>

#include <span>

#include "core/errors.h"
#include "drivers/quoted.h"
#include "drivers/take/toml_text.h"
#include "tools/calibration/data_tree.h"
#include "tools/calibration/exchange.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

std::string WhereOf(const DataFile& file, const std::string& key) {
  const DataNode* node = file.root.Find(key);
  return (node != nullptr ? file.At(*node) : Printable(file.path.string())) + ": " + Printable(key);
}

std::optional<ForeignNumbers> Numbers(const DataFile& file, const std::string& key) {
  const DataNode* node = file.root.Find(key);
  if (node == nullptr) return std::nullopt;
  return ForeignNumbers{WhereOf(file, key), file.Numbers(*node, key)};
}

ForeignNumbers Needed(const DataFile& file, const std::string& key) {
  std::optional<ForeignNumbers> numbers = Numbers(file, key);
  if (!numbers) throw SetupError(WhereOf(file, key) + " is missing");
  return *numbers;
}

// Reads two keys; either may be missing.
ForeignNumbers Size(const DataFile& file, const std::string& width, const std::string& height) {
  ForeignNumbers size{WhereOf(file, width), {}};
  const auto w = Numbers(file, width), h = Numbers(file, height);
  if (w && h) {
    size.values = w->values;
    size.values.insert(size.values.end(), h->values.begin(), h->values.end());
  }
  return size;
}

// ROS's distortion model, if given, selects the lens.
void TakeDistortionModel(const DataFile& file, ForeignCamera& camera) {
  const DataNode* model = file.root.Find("distortion_model");
  if (model == nullptr) return;
  if (model->text == "equidistant" || model->text == "fisheye") {
    camera.is_fisheye = true;
  } else if (model->text != "plumb_bob" && model->text != "rational_polynomial" &&
             !model->text.empty()) {
    throw SetupError(WhereOf(file, "distortion_model") + " is " + Quoted(model->text) +
                     "; expected plumb_bob, rational_polynomial or equidistant");
  }
}

ForeignCamera ReadOpenCvFile(const fs::path& path) {
  const std::string text = ReadForeignText(path);
  const std::size_t first = text.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  const bool is_xml = first != std::string::npos && text[first] == '<';
  const DataFile file = is_xml ? ReadOpenCvXml(path) : ReadYaml(path);
  ForeignCamera camera;
  camera.where = Printable(path.string());
  camera.name = path.stem().string();
  camera.size_px = Size(file, "image_width", "image_height");
  camera.matrix = Needed(file, "camera_matrix");
  camera.distortion = Needed(file, "distortion_coefficients");
  // OpenCV's sample tells this only in flags or a comment; our files have a key.
  if (const auto fisheye = Numbers(file, "fisheye_model"))
    camera.is_fisheye = fisheye->values != std::vector<double>{0};
  TakeDistortionModel(file, camera);
  camera.rotation = Numbers(file, "rotation");
  camera.translation_mm = Numbers(file, "translation");
  return camera;
}

template <typename Matrix>
std::string MatrixText(const Matrix& matrix) {
  std::string text = fmt::format("!!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ ",
                                 matrix.rows(), matrix.cols());
  for (Eigen::Index i = 0; i < matrix.size(); ++i)
    text += (i > 0 ? ", " : "") + TomlNumber(matrix(i / matrix.cols(), i % matrix.cols()));
  return text + " ]\n";
}

Eigen::MatrixXd Row(std::span<const double> numbers) {
  return Eigen::Map<const Eigen::RowVectorXd>(numbers.data(),
                                              static_cast<Eigen::Index>(numbers.size()));
}

Eigen::MatrixXd DistortionOf(const OpenCvLens& lens) {
  const std::span all(lens.distortion);
  return Row(lens.IsRational() ? all : all.first(5));
}

constexpr const char* kOpenCvHead = "%YAML:1.0\n---\n";

}  // namespace

std::vector<ForeignCamera> ReadOpenCv(const fs::path& folder) {
  std::vector<ForeignCamera> cameras;
  for (const fs::path& file : FilesOf(folder, {".yml", ".yaml", ".xml"}))
    cameras.push_back(ReadOpenCvFile(file));
  return cameras;
}

std::vector<TextFile> OpenCvText(const Cameras& cameras) {
  std::vector<TextFile> files;
  for (const CameraCalibration& camera : cameras) {
    std::string text = kOpenCvHead + fmt::format("image_width: {}\nimage_height: {}\n",
                                                 camera.width_px, camera.height_px);
    if (const auto* fisheye = std::get_if<FisheyeLens>(&camera.lens)) {
      text += "fisheye_model: 1\ncamera_matrix: " + MatrixText(fisheye->K) +
              "distortion_coefficients: " + MatrixText(Row(fisheye->distortion).transpose());
    } else {
      const OpenCvLens lens = AsOpenCvLens(camera);
      text += "camera_matrix: " + MatrixText(lens.K) +
              "distortion_coefficients: " + MatrixText(DistortionOf(lens).transpose());
    }
    text += "rotation: " + MatrixText(camera.X_CW.R) + "translation: " + MatrixText(camera.X_CW.p);
    files.push_back({camera.name + ".yml", text});
  }
  return files;
}

std::vector<ForeignCamera> ReadEasyMocap(const fs::path& intri_file, const fs::path& extri_file) {
  const DataFile intri = ReadYaml(intri_file), extri = ReadYaml(extri_file);
  const DataNode* names = intri.root.Find("names");
  if (names == nullptr || names->kind != DataNode::Kind::kSequence || names->items.empty())
    throw SetupError(WhereOf(intri, "names") + " lists no camera; expected a list of names");
  std::vector<ForeignCamera> cameras;
  for (const DataNode& node : names->items) {
    ForeignCamera camera;
    camera.where = intri.At(node) + ": names";
    camera.name = node.text;
    camera.size_px = Size(intri, "W_" + camera.name, "H_" + camera.name);
    camera.matrix = Needed(intri, "K_" + camera.name);
    // Newer versions use another name.
    const bool is_newer = intri.root.Find("dist_" + camera.name) == nullptr &&
                          intri.root.Find("D_" + camera.name) != nullptr;
    camera.distortion = Needed(intri, (is_newer ? "D_" : "dist_") + camera.name);
    camera.rotation = Numbers(extri, "Rot_" + camera.name);
    if (!camera.rotation) camera.rotation = Numbers(extri, "R_" + camera.name);
    camera.translation_mm = Numbers(extri, "T_" + camera.name);
    if (camera.translation_mm) {
      for (double& value : camera.translation_mm->values) value *= 1000;
    }
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

std::vector<TextFile> EasyMocapText(const Cameras& cameras) {
  std::string intri = std::string(kOpenCvHead) + "names:\n";
  for (const CameraCalibration& camera : cameras) intri += "   - \"" + camera.name + "\"\n";
  std::string extri = intri;
  for (const CameraCalibration& camera : cameras) {
    const std::string& name = camera.name;
    const OpenCvLens lens = AsOpenCvLens(camera);
    intri += "K_" + name + ": " + MatrixText(lens.K) + "dist_" + name + ": " +
             MatrixText(DistortionOf(lens)) +
             fmt::format("H_{}: {}\nW_{}: {}\n", name, camera.height_px, name, camera.width_px);
    extri += "R_" + name + ": " + MatrixText(LogRotation(camera.X_CW.R)) + "Rot_" + name + ": " +
             MatrixText(camera.X_CW.R) + "T_" + name + ": " +
             MatrixText(Vector3(camera.X_CW.p / 1000));
  }
  return {{"intri.yml", intri}, {"extri.yml", extri}};
}

}  // namespace mocap
