// Kalibr's camchains.
#include <Eigen/Core>
#include <cmath>

#include "core/errors.h"
#include "drivers/quoted.h"
#include "tools/calibration/data_tree.h"
#include "tools/calibration/exchange.h"

namespace mocap {
namespace {

using RowMajor4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

/// One camN of a file.
struct ChainCamera {
  const DataFile& file;
  const std::string& name;
  const DataNode& node;

  std::string Where(const std::string& key) const {
    const DataNode* child = node.Find(key);
    return file.At(child != nullptr ? *child : node) + ": " + Printable(name) + "." + key;
  }
  ForeignNumbers Numbers(const std::string& key) const {
    const DataNode* child = node.Find(key);
    if (child == nullptr) throw SetupError(Where(key) + " is missing");
    return {Where(key), file.Numbers(*child, name + "." + key)};
  }
  std::string Text(const std::string& key) const {
    const DataNode* child = node.Find(key);
    if (child == nullptr) throw SetupError(Where(key) + " is missing");
    return child->text;
  }
};

ForeignCamera ReadLens(const ChainCamera& chain) {
  ForeignCamera camera;
  camera.where = chain.file.At(chain.node);
  camera.name = chain.name;
  if (const std::string model = chain.Text("camera_model"); model != "pinhole")
    throw SetupError(chain.Where("camera_model") + " is " + Quoted(model) +
                     "; expected pinhole: calibrate with a pinhole model");
  const ForeignNumbers f = chain.Numbers("intrinsics");
  if (f.values.size() != 4)
    throw SetupError(f.where + " has " + std::to_string(f.values.size()) +
                     " numbers; expected fu fv pu pv");
  camera.matrix = {f.where, {f.values[0], 0, f.values[2], 0, f.values[1], f.values[3], 0, 0, 1}};
  const std::string model = chain.Text("distortion_model");
  if (model != "radtan" && model != "equidistant" && model != "none")
    throw SetupError(chain.Where("distortion_model") + " is " + Quoted(model) +
                     "; expected radtan, equidistant or none");
  camera.is_fisheye = model == "equidistant";
  camera.distortion = {chain.Where("distortion_coeffs"), {}};
  if (model != "none") camera.distortion = chain.Numbers("distortion_coeffs");
  if (model != "none" && camera.distortion.values.size() != 4)
    throw SetupError(camera.distortion.where + " has " +
                     std::to_string(camera.distortion.values.size()) + " numbers; expected 4");
  camera.size_px = chain.Numbers("resolution");
  if (camera.size_px.values.size() < 2)
    throw SetupError(camera.size_px.where + " is not [width, height]");
  return camera;
}

// Transform from the previous camera.
RigidTransform ReadLink(const ChainCamera& chain) {
  const ForeignNumbers numbers = chain.Numbers("T_cn_cnm1");
  if (numbers.values.size() != 16)
    throw SetupError(numbers.where + " has " + std::to_string(numbers.values.size()) +
                     " numbers; expected 4 x 4");
  const Eigen::Matrix4d T = Eigen::Map<const RowMajor4>(numbers.values.data());
  const Matrix3 R = T.topLeftCorner<3, 3>();
  const bool is_rotation =
      (R * R.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff() < 1e-3 && R.determinant() > 0;
  if (!is_rotation || T.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    throw SetupError(numbers.where + " is not a rigid transform; expected [R t; 0 0 0 1]");
  return {NearestRotation(R), 1000 * T.topRightCorner<3, 1>()};
}

}  // namespace

std::vector<ForeignCamera> ReadKalibr(const std::filesystem::path& path) {
  const DataFile file = ReadYaml(path);
  std::vector<ForeignCamera> cameras;
  // The chain's first camera is the world. After a missing link, cameras have no pose.
  std::optional<RigidTransform> X_CW = RigidTransform{};
  for (;;) {
    const std::string name = "cam" + std::to_string(cameras.size());
    const DataNode* node = file.root.Find(name);
    if (node == nullptr) break;
    const ChainCamera chain{file, name, *node};
    ForeignCamera camera = ReadLens(chain);
    if (!cameras.empty()) {
      if (node->Find("T_cn_cnm1") == nullptr) X_CW.reset();
      if (X_CW) X_CW = ReadLink(chain) * *X_CW;
    }
    if (X_CW) {
      const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = NearestRotation(X_CW->R);
      const Vector3& t = X_CW->p;
      const std::string where = chain.Where("T_cn_cnm1");
      camera.rotation = ForeignNumbers{where, {R.data(), R.data() + 9}};
      camera.translation_mm = ForeignNumbers{where, {t.data(), t.data() + 3}};
    }
    cameras.push_back(std::move(camera));
  }
  if (cameras.empty())
    throw SetupError(Printable(path.string()) +
                     ": contains no cam0; expected a camchain of Kalibr");
  // A first camera alone has intrinsics only.
  if (cameras.size() == 1 || !cameras[1].rotation)
    cameras[0].rotation = cameras[0].translation_mm = std::nullopt;
  return cameras;
}

}  // namespace mocap
