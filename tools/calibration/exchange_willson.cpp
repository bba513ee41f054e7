// Files of Reg Willson's Tsai program.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/errors.h"
#include "drivers/quoted.h"
#include "drivers/take/toml_text.h"
#include "tools/calibration/data_tree.h"
#include "tools/calibration/exchange.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

enum Field {
  kNcx,
  kNfx,
  kDx,
  kDy,
  kDpx,
  kDpy,
  kCx,
  kCy,
  kSx,
  kF,
  kKappa1,
  kTx,
  kTy,
  kTz,
  kRx,
  kRy,
  kRz,
  kFields
};

constexpr std::size_t kMostNumbers = kFields + 2;

Matrix3 FromEuler(double x, double y, double z) {
  return (Eigen::AngleAxisd(z, Vector3::UnitZ()) * Eigen::AngleAxisd(y, Vector3::UnitY()) *
          Eigen::AngleAxisd(x, Vector3::UnitX()))
      .toRotationMatrix();
}

Vector3 ToEuler(const Matrix3& R) {
  const double y = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
  // Straight up or down, x and z rotate about the same axis: assign all to z.
  if (std::abs(R(2, 0)) > 1 - 1e-12) return {0, y, std::atan2(-R(0, 1), R(1, 1))};
  return {std::atan2(R(2, 1), R(2, 2)), y, std::atan2(R(1, 0), R(0, 0))};
}

ForeignCamera ReadOne(const fs::path& file) {
  ForeignCamera camera;
  camera.where = Printable(file.string());
  camera.name = file.stem().string();
  std::istringstream in(ReadForeignText(file));
  std::vector<double> n;
  for (std::string word; n.size() <= kMostNumbers && in >> word;)
    n.push_back(FiniteNumber(word, camera.where + ": number " + std::to_string(n.size() + 1)));
  if (n.size() < kFields || n.size() > kMostNumbers)
    throw SetupError(
        camera.where + ": has " +
        (n.size() > kMostNumbers ? "more than " + std::to_string(kMostNumbers)
                                 : std::to_string(n.size())) +
        " numbers; expected Ncx Nfx dx dy dpx dpy Cx Cy sx f kappa1 Tx Ty Tz Rx Ry Rz [p1 p2]");
  for (std::size_t i = kFields; i < n.size(); ++i) {
    if (n[i] != 0)
      throw SetupError(camera.where + ": has p" + std::to_string(i - kFields + 1) +
                       " other than 0; expected a lens without tangential distortion");
  }
  for (const Field field : {kDpx, kDpy, kSx, kF}) {
    if (!(n[field] > 0)) throw SetupError(camera.where + ": dpx, dpy, sx and f must be above 0");
  }
  camera.size_px = {camera.where, {n[kNfx]}};
  camera.lens = TsaiLens{n[kF], n[kKappa1], n[kSx], {n[kCx], n[kCy]}, {n[kDpx], n[kDpy]}};
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = FromEuler(n[kRx], n[kRy], n[kRz]);
  camera.rotation = ForeignNumbers{camera.where + ": Rx Ry Rz", {R.data(), R.data() + 9}};
  camera.translation_mm = ForeignNumbers{camera.where + ": Tx Ty Tz", {n[kTx], n[kTy], n[kTz]}};
  return camera;
}

}  // namespace

std::vector<ForeignCamera> ReadWillson(const fs::path& folder) {
  std::vector<ForeignCamera> cameras;
  for (const fs::path& file : FilesOf(folder, {".cal"})) cameras.push_back(ReadOne(file));
  return cameras;
}

std::vector<TextFile> WillsonText(const Cameras& cameras) {
  std::vector<TextFile> files;
  for (const CameraCalibration& camera : cameras) {
    const TsaiLens lens = AsTsaiLens(camera);
    const Vector3 euler = ToEuler(camera.X_CW.R);
    std::string text;
    const double width = camera.width_px;
    for (const double number :
         {width, width, lens.pitch_mm.x(), lens.pitch_mm.y(), lens.pitch_mm.x(), lens.pitch_mm.y(),
          lens.center_px.x(), lens.center_px.y(), lens.sx, lens.focal_mm, lens.kappa1,
          camera.X_CW.p.x(), camera.X_CW.p.y(), camera.X_CW.p.z(), euler.x(), euler.y(), euler.z(),
          0.0, 0.0})
      text += TomlNumber(number) + '\n';
    files.push_back({camera.name + ".cal", text});
  }
  return files;
}

}  // namespace mocap
