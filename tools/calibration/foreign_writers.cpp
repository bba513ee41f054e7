// Writes cameras as texts of other programs.
#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>

#include "drivers/take/toml_text.h"
#include "tools/calibration/foreign_program.h"
#include "tools/calibration/lens_conversion.h"

namespace mocap {
namespace {

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

Vector3 ToEuler(const Matrix3& R) {
  const double y = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
  // Straight up or down, x and z rotate about the same axis: assign all to z.
  if (std::abs(R(2, 0)) > 1 - 1e-12) return {0, y, std::atan2(-R(0, 1), R(1, 1))};
  return {std::atan2(R(2, 1), R(2, 2)), y, std::atan2(R(1, 0), R(0, 0))};
}

Vector3 ViconRadial(const CameraCalibration& camera, const OpenCvLens& lens) {
  const double f = lens.K(0, 0), aspect = lens.K(0, 0) / lens.K(1, 1);
  Eigen::MatrixXd A((kViconGrid + 1) * (kViconGrid + 1), 3);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(A.rows());
  A.setZero();
  const double scale = camera.width_px;
  for (int row = 0; row < A.rows(); ++row) {
    const Vector2 pixel((camera.width_px - 1.0) * (row % (kViconGrid + 1)) / kViconGrid,
                        (camera.height_px - 1.0) * (row / (kViconGrid + 1)) / kViconGrid);
    const auto n = NormalizedFromPixel(Lens(lens), pixel);
    Vector2 d = pixel - Vector2(lens.K(0, 2), lens.K(1, 2));
    d.y() *= aspect;
    const double r = d.norm() / scale;
    if (!n || r == 0) continue;
    A.row(row) << std::pow(r, 3), std::pow(r, 5), std::pow(r, 7);
    b[row] = f * n->norm() / scale - r;
  }
  const Vector3 k = A.colPivHouseholderQr().solve(b);
  return {k[0] / std::pow(scale, 2), k[1] / std::pow(scale, 4), k[2] / std::pow(scale, 6)};
}

std::string List(const double* numbers, std::size_t count) {
  std::string text = "[ ";
  for (std::size_t i = 0; i < count; ++i) text += TomlNumber(numbers[i]) + ", ";
  return text + "]";
}

}  // namespace

TextFiles Pose2SimText(const Cameras& cameras, const ForeignProgram& program) {
  std::ostringstream out;
  for (const CameraCalibration& camera : cameras) {
    const auto* fisheye = std::get_if<FisheyeLens>(&camera.lens);
    const OpenCvLens lens = fisheye != nullptr ? OpenCvLens{} : AsOpenCvLens(camera);
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> K = fisheye != nullptr ? fisheye->K : lens.K;
    const Vector3 w = LogRotation(camera.X_CW.R);
    const Vector3 t = camera.X_CW.p / program.unit_mm;
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

TextFiles OpenCvText(const Cameras& cameras, const ForeignProgram&) {
  TextFiles files;
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

TextFiles EasyMocapText(const Cameras& cameras, const ForeignProgram& program) {
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
             MatrixText(Vector3(camera.X_CW.p / program.unit_mm));
  }
  return {{"intri.yml", intri}, {"extri.yml", extri}};
}

TextFiles WillsonText(const Cameras& cameras, const ForeignProgram&) {
  TextFiles files;
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

TextFiles QualisysText(const Cameras& cameras, const ForeignProgram& program) {
  std::ostringstream out;
  out << "<calibration>\n <cameras>\n";
  for (const CameraCalibration& camera : cameras) {
    const OpenCvLens lens = AsFiveCoefficients(camera, "qualisys");
    const Matrix3 M = kTurnedOver * camera.X_CW.R;
    const Vector3 p_WC = camera.X_CW.Inverse().p;
    const auto& d = lens.distortion;
    out << fmt::format(
        "  <camera active=\"1\" avg-residual=\"0\" serial=\"{}\" model=\"Video\" "
        "viewrotation=\"0\">\n"
        "   <fov_video left=\"0\" top=\"0\" right=\"{}\" bottom=\"{}\"/>\n   <transform x=\"{}\" "
        "y=\"{}\" z=\"{}\"",
        camera.name, camera.width_px - 1, camera.height_px - 1, p_WC.x(), p_WC.y(), p_WC.z());
    for (int i = 0; i < 9; ++i)
      out << fmt::format(" r{}{}=\"{}\"", i / 3 + 1, i % 3 + 1, M(i / 3, i % 3));
    out << fmt::format(
        "/>\n   <intrinsic sensorMinU=\"0\" sensorMaxU=\"{}\" sensorMinV=\"0\" sensorMaxV=\"{}\" "
        "focalLengthU=\"{}\" focalLengthV=\"{}\" centerPointU=\"{}\" centerPointV=\"{}\" "
        "skew=\"0\" "
        "radialDistortion1=\"{}\" radialDistortion2=\"{}\" radialDistortion3=\"{}\" "
        "tangentalDistortion1=\"{}\" tangentalDistortion2=\"{}\"/>\n  </camera>\n",
        camera.width_px / program.unit_px - 1, camera.height_px / program.unit_px - 1,
        lens.K(0, 0) / program.unit_px, lens.K(1, 1) / program.unit_px,
        lens.K(0, 2) / program.unit_px, lens.K(1, 2) / program.unit_px, d[0], d[1], d[4], d[2],
        d[3]);
  }
  out << " </cameras>\n</calibration>\n";
  return {{"", out.str()}};
}

TextFiles ViconText(const Cameras& cameras, const ForeignProgram&) {
  std::ostringstream out;
  out << "<Cameras VERSION=\"1.0\">\n";
  for (const CameraCalibration& camera : cameras) {
    const OpenCvLens lens = AsFiveCoefficients(camera, "vicon");
    const Eigen::Quaterniond q(camera.X_CW.R);
    const Vector3 p_WC = camera.X_CW.Inverse().p, k = ViconRadial(camera, lens);
    out << fmt::format(
        " <Camera DEVICEID=\"{}\" SENSOR_SIZE=\"{} {}\" PIXEL_ASPECT_RATIO=\"{}\" SYSTEM=\"DV\">\n"
        "  <KeyFrames>\n   <KeyFrame FRAME=\"0\" FOCAL_LENGTH=\"{}\" PRINCIPAL_POINT=\"{} {}\" "
        "ORIENTATION=\"{} {} {} {}\" POSITION=\"{} {} {}\" VICON_RADIAL2=\"Vicon3Parameter {} {} "
        "{} "
        "{} {}\" WORLD_ERROR=\"0\"/>\n  </KeyFrames>\n </Camera>\n",
        camera.name, camera.width_px, camera.height_px, lens.K(0, 0) / lens.K(1, 1), lens.K(0, 0),
        lens.K(0, 2), lens.K(1, 2), q.x(), q.y(), q.z(), q.w(), p_WC.x(), p_WC.y(), p_WC.z(),
        lens.K(0, 2), lens.K(1, 2), k[0], k[1], k[2]);
  }
  out << "</Cameras>\n";
  return {{"", out.str()}};
}

}  // namespace mocap
