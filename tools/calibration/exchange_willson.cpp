// Files of Reg Willson's Tsai program.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/errors.h"
#include "drivers/take/text_file.h"
#include "drivers/take/toml_text.h"
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

Matrix3 FromEuler(double x, double y, double z) {
  return (Eigen::AngleAxisd(z, Vector3::UnitZ()) * Eigen::AngleAxisd(y, Vector3::UnitY()) *
          Eigen::AngleAxisd(x, Vector3::UnitX()))
      .toRotationMatrix();
}

Vector3 ToEuler(const Matrix3& R) {
  const double y = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
  // Straight up or down x and z turn about one axis: all of it is given to z.
  if (std::abs(R(2, 0)) > 1 - 1e-12) return {0, y, std::atan2(-R(0, 1), R(1, 1))};
  return {std::atan2(R(2, 1), R(2, 2)), y, std::atan2(R(1, 0), R(0, 0))};
}

CameraCalibration ReadOne(const fs::path& file) {
  std::ifstream in(file);
  std::vector<double> n;
  for (double number = 0; in >> number;) n.push_back(number);
  if (n.size() < kFields)
    throw SetupError(
        file.string() + ": has " + std::to_string(n.size()) +
        " numbers; Ncx Nfx dx dy dpx dpy Cx Cy sx f kappa1 Tx Ty Tz Rx Ry Rz are wanted");
  CameraCalibration camera;
  camera.name = file.stem().string();
  camera.width_px = static_cast<int>(n[kNfx]);
  camera.height_px = static_cast<int>(n[kNfx] * 3 / 4);
  camera.lens = TsaiLens{n[kF], n[kKappa1], n[kSx], {n[kCx], n[kCy]}, {n[kDpx], n[kDpy]}};
  camera.X_CW = {FromEuler(n[kRx], n[kRy], n[kRz]), {n[kTx], n[kTy], n[kTz]}};
  return camera;
}

}  // namespace

Cameras ReadWillson(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() == ".cal") files.push_back(entry.path());
    }
  } else {
    files.push_back(folder);
  }
  std::sort(files.begin(), files.end());
  Cameras cameras;
  for (const fs::path& file : files) cameras.push_back(ReadOne(file));
  if (cameras.empty()) throw SetupError(folder.string() + ": holds no .cal file");
  return cameras;
}

void WriteWillson(const fs::path& folder, const Cameras& cameras) {
  fs::create_directories(folder);
  for (const CameraCalibration& camera : cameras) {
    const TsaiLens lens = AsTsaiLens(camera);
    const Vector3 euler = ToEuler(camera.X_CW.R);
    const fs::path file = folder / (camera.name + ".cal");
    std::ostringstream out;
    const double width = camera.width_px;
    for (const double number :
         {width, width, lens.pitch_mm.x(), lens.pitch_mm.y(), lens.pitch_mm.x(), lens.pitch_mm.y(),
          lens.center_px.x(), lens.center_px.y(), lens.sx, lens.focal_mm, lens.kappa1,
          camera.X_CW.p.x(), camera.X_CW.p.y(), camera.X_CW.p.z(), euler.x(), euler.y(), euler.z(),
          0.0, 0.0})
      out << TomlNumber(number) << '\n';
    ReplaceText(file, out.str());
  }
}

}  // namespace mocap
