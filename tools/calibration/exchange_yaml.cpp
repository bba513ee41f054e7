// EasyMocap and OpenCV's own YAML.
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/core/persistence.hpp>

#include "core/errors.h"
#include "tools/calibration/exchange.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

cv::FileStorage Open(const fs::path& file, int mode) {
  cv::FileStorage storage;
  try {
    if (storage.open(file.string(), mode)) return storage;
  } catch (const cv::Exception& error) {
    throw SetupError(file.string() + ": is no YAML of OpenCV (" + error.err + ")");
  }
  throw SetupError(file.string() + ": cannot be opened; a file of OpenCV's YAML is wanted");
}

std::vector<double> Numbers(const cv::FileStorage& storage, const std::string& key,
                            const fs::path& file) {
  cv::Mat matrix;
  storage[key] >> matrix;
  if (matrix.empty()) throw SetupError(file.string() + ": " + key + " is missing");
  matrix.convertTo(matrix, CV_64F);
  return {matrix.begin<double>(), matrix.end<double>()};
}

Matrix3 RowMajor(const std::vector<double>& n, const std::string& what) {
  if (n.size() != 9)
    throw SetupError(what + " has " + std::to_string(n.size()) + " numbers, not 9");
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(n.data());
}

Vector3 Three(const std::vector<double>& n, const std::string& what) {
  if (n.size() != 3)
    throw SetupError(what + " has " + std::to_string(n.size()) + " numbers, not 3");
  return {n[0], n[1], n[2]};
}

template <std::size_t kCount>
std::array<double, kCount> UpTo(const std::vector<double>& numbers) {
  std::array<double, kCount> all{};
  std::copy_n(numbers.begin(), std::min(numbers.size(), kCount), all.begin());
  return all;
}

cv::Mat MatOf(const Matrix3& m) {
  cv::Mat mat(3, 3, CV_64F);
  for (int i = 0; i < 9; ++i) mat.at<double>(i / 3, i % 3) = m(i / 3, i % 3);
  return mat;
}

template <typename Container>
cv::Mat Column(const Container& numbers, int count) {
  cv::Mat mat(count, 1, CV_64F);
  for (int i = 0; i < count; ++i) mat.at<double>(i) = numbers[i];
  return mat;
}

}  // namespace

Cameras ReadEasyMocap(const fs::path& folder) {
  const fs::path intri_file = folder / "intri.yml", extri_file = folder / "extri.yml";
  const cv::FileStorage intri = Open(intri_file, cv::FileStorage::READ);
  const cv::FileStorage extri = Open(extri_file, cv::FileStorage::READ);
  Cameras cameras;
  for (const cv::FileNode& node : intri["names"]) {
    const std::string name = static_cast<std::string>(node);
    CameraCalibration camera;
    camera.name = name;
    OpenCvLens lens;
    lens.K = RowMajor(Numbers(intri, "K_" + name, intri_file), intri_file.string() + ": K_" + name);
    lens.distortion = UpTo<5>(Numbers(intri, "dist_" + name, intri_file));
    const int width = static_cast<int>(std::lround(2 * lens.K(0, 2)));
    const int height = static_cast<int>(std::lround(2 * lens.K(1, 2)));
    camera.width_px = intri["W_" + name].empty() ? width : static_cast<int>(intri["W_" + name]);
    camera.height_px = intri["H_" + name].empty() ? height : static_cast<int>(intri["H_" + name]);
    camera.lens = lens;
    camera.X_CW.R = extri["Rot_" + name].empty()
                        ? ExpRotation(Three(Numbers(extri, "R_" + name, extri_file), "R_" + name))
                        : RowMajor(Numbers(extri, "Rot_" + name, extri_file), "Rot_" + name);
    camera.X_CW.p = 1000 * Three(Numbers(extri, "T_" + name, extri_file), "T_" + name);
    cameras.push_back(camera);
  }
  if (cameras.empty()) throw SetupError(intri_file.string() + ": names no camera");
  return cameras;
}

void WriteEasyMocap(const fs::path& folder, const Cameras& cameras) {
  fs::create_directories(folder);
  cv::FileStorage intri = Open(folder / "intri.yml", cv::FileStorage::WRITE);
  cv::FileStorage extri = Open(folder / "extri.yml", cv::FileStorage::WRITE);
  for (cv::FileStorage* storage : {&intri, &extri}) {
    *storage << "names"
             << "[";
    for (const CameraCalibration& camera : cameras) *storage << camera.name;
    *storage << "]";
  }
  for (const CameraCalibration& camera : cameras) {
    const OpenCvLens lens = AsOpenCvLens(camera);
    intri << "K_" + camera.name << MatOf(lens.K);
    intri << "dist_" + camera.name << Column(lens.distortion, 5).t();
    intri << "H_" + camera.name << camera.height_px;
    intri << "W_" + camera.name << camera.width_px;
    extri << "R_" + camera.name << Column(LogRotation(camera.X_CW.R), 3);
    extri << "Rot_" + camera.name << MatOf(camera.X_CW.R);
    extri << "T_" + camera.name << Column(Vector3(camera.X_CW.p / 1000), 3);
  }
}

Cameras ReadOpenCvYaml(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension == ".yml" || extension == ".yaml") files.push_back(entry.path());
    }
  } else {
    files.push_back(folder);
  }
  std::sort(files.begin(), files.end());
  Cameras cameras;
  for (const fs::path& file : files) {
    const cv::FileStorage storage = Open(file, cv::FileStorage::READ);
    CameraCalibration camera;
    camera.name = file.stem().string();
    camera.width_px = static_cast<int>(storage["image_width"]);
    camera.height_px = static_cast<int>(storage["image_height"]);
    const Matrix3 K = RowMajor(Numbers(storage, "camera_matrix", file), "camera_matrix");
    const std::vector<double> distortion = Numbers(storage, "distortion_coefficients", file);
    // OpenCV's sample says so in flags or in a comment only; ours in a key.
    if (static_cast<int>(
            storage["fisheye_model"].empty() ? 0 : static_cast<int>(storage["fisheye_model"])))
      camera.lens = FisheyeLens{K, UpTo<4>(distortion)};
    else
      camera.lens = OpenCvLens{K, UpTo<5>(distortion)};
    if (!storage["rotation"].empty()) {
      camera.X_CW.R = RowMajor(Numbers(storage, "rotation", file), "rotation");
      camera.X_CW.p = Three(Numbers(storage, "translation", file), "translation");
    }
    cameras.push_back(camera);
  }
  if (cameras.empty()) throw SetupError(folder.string() + ": holds no .yml file");
  return cameras;
}

void WriteOpenCvYaml(const fs::path& folder, const Cameras& cameras) {
  fs::create_directories(folder);
  for (const CameraCalibration& camera : cameras) {
    cv::FileStorage storage = Open(folder / (camera.name + ".yml"), cv::FileStorage::WRITE);
    storage << "image_width" << camera.width_px << "image_height" << camera.height_px;
    if (const auto* fisheye = std::get_if<FisheyeLens>(&camera.lens)) {
      storage << "fisheye_model" << 1 << "camera_matrix" << MatOf(fisheye->K)
              << "distortion_coefficients" << Column(fisheye->distortion, 4);
    } else {
      const OpenCvLens lens = AsOpenCvLens(camera);
      storage << "camera_matrix" << MatOf(lens.K) << "distortion_coefficients"
              << Column(lens.distortion, 5);
    }
    storage << "rotation" << MatOf(camera.X_CW.R) << "translation" << Column(camera.X_CW.p, 3);
  }
}

}  // namespace mocap
