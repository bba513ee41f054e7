// Qualisys and Vicon.
#include <fmt/format.h>

#include <Eigen/QR>
#include <cmath>
#include <sstream>

#include "core/errors.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/text_file.h"
#include "tools/calibration/exchange.h"
#include "tools/calibration/xml_tags.h"

namespace mocap {
namespace {

constexpr double kQualisysUnits = 64;  // To the pixel.
constexpr int kGrid = 12;

// Qualisys' cameras look along their negative z with y up.
const Matrix3 kTurnedOver = Vector3(1, -1, -1).asDiagonal();

std::string NameOf(const XmlTag& tag, const char* key) {
  const std::string name = tag.Has(key) ? tag.attributes.at(key) : "";
  return IsCameraName(name) ? name : fmt::format("cam_line{}", tag.line);
}

double One(const XmlTag& tag, const std::string& key, const std::filesystem::path& file) {
  return XmlNumbers(tag, key, 1, file)[0];
}

Lens QualisysLens(const XmlTag& tag, const Vector2& corner_px, const std::filesystem::path& file) {
  OpenCvLens lens;
  lens.K << One(tag, "focalLengthU", file) / kQualisysUnits, 0,
      One(tag, "centerPointU", file) / kQualisysUnits - corner_px.x(), 0,
      One(tag, "focalLengthV", file) / kQualisysUnits,
      One(tag, "centerPointV", file) / kQualisysUnits - corner_px.y(), 0, 0, 1;
  lens.distortion = {One(tag, "radialDistortion1", file), One(tag, "radialDistortion2", file),
                     One(tag, "tangentalDistortion1", file), One(tag, "tangentalDistortion2", file),
                     tag.Has("radialDistortion3") ? One(tag, "radialDistortion3", file) : 0};
  return lens;
}

RigidTransform QualisysPose(const XmlTag& tag, const std::filesystem::path& file) {
  Matrix3 M;
  for (int i = 0; i < 9; ++i)
    M(i / 3, i % 3) = One(tag, fmt::format("r{}{}", i / 3 + 1, i % 3 + 1), file);
  const Vector3 p_WC(One(tag, "x", file), One(tag, "y", file), One(tag, "z", file));
  RigidTransform X_CW;
  X_CW.R = kTurnedOver * M;
  X_CW.p = -(X_CW.R * p_WC);
  return X_CW;
}

// r_u = r_d (1 + k1 r_d² + k2 r_d⁴ + k3 r_d⁶), pixels from the principal point.
CameraCalibration ReadViconCamera(const XmlTag& camera_tag, const XmlTag& key_frame,
                                  const std::filesystem::path& file) {
  CameraCalibration camera;
  camera.name = NameOf(camera_tag, "DEVICEID");
  const std::vector<double> size = XmlNumbers(camera_tag, "SENSOR_SIZE", 2, file);
  camera.width_px = static_cast<int>(size[0]);
  camera.height_px = static_cast<int>(size[1]);
  const double aspect =
      camera_tag.Has("PIXEL_ASPECT_RATIO") ? One(camera_tag, "PIXEL_ASPECT_RATIO", file) : 1;
  const double f = One(key_frame, "FOCAL_LENGTH", file);
  const std::vector<double> c = XmlNumbers(key_frame, "PRINCIPAL_POINT", 2, file);
  Vector3 k = Vector3::Zero();
  if (key_frame.Has("VICON_RADIAL2")) {
    // A word that names the model, the centre, then the coefficients.
    XmlTag numbers = key_frame;
    std::string& text = numbers.attributes["VICON_RADIAL2"];
    text.erase(0, text.find_first_of(" \t"));
    const std::vector<double> n = XmlNumbers(numbers, "VICON_RADIAL2", 5, file);
    k = {n[2], n[3], n[4]};
  } else if (key_frame.Has("VICON_RADIAL")) {
    const std::vector<double> n = XmlNumbers(key_frame, "VICON_RADIAL", 2, file);
    k = {n[0], n[1], 0};
  }
  OpenCvLens start;
  start.K << f, 0, c[0], 0, f / aspect, c[1], 0, 0, 1;
  std::vector<Vector2> normalized, pixels;
  for (int i = 0; i <= kGrid; ++i) {
    for (int j = 0; j <= kGrid; ++j) {
      const Vector2 pixel((size[0] - 1) * i / kGrid, (size[1] - 1) * j / kGrid);
      Vector2 d = pixel - Vector2(c[0], c[1]);
      d.y() *= aspect;
      const double r2 = d.squaredNorm();
      normalized.push_back(d * (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[2]))) / f);
      pixels.push_back(pixel);
    }
  }
  camera.lens = FitOpenCvLens(camera.name, start, normalized, pixels);
  const std::vector<double> q = XmlNumbers(key_frame, "ORIENTATION", 4, file);
  const std::vector<double> p = XmlNumbers(key_frame, "POSITION", 3, file);
  camera.X_CW.R = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized().toRotationMatrix();
  camera.X_CW.p = -(camera.X_CW.R * Vector3(p[0], p[1], p[2]));
  return camera;
}

Vector3 ViconRadial(const CameraCalibration& camera, const OpenCvLens& lens) {
  const double f = lens.K(0, 0), aspect = lens.K(0, 0) / lens.K(1, 1);
  Eigen::MatrixXd A((kGrid + 1) * (kGrid + 1), 3);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(A.rows());
  A.setZero();
  const double scale = camera.width_px;
  for (int row = 0; row < A.rows(); ++row) {
    const Vector2 pixel((camera.width_px - 1.0) * (row % (kGrid + 1)) / kGrid,
                        (camera.height_px - 1.0) * (row / (kGrid + 1)) / kGrid);
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

}  // namespace

Cameras ReadQualisys(const std::filesystem::path& file) {
  Cameras cameras;
  Vector2 corner_px = Vector2::Zero();
  for (const XmlTag& tag : ReadXmlTags(file)) {
    if (tag.name == "camera") {
      cameras.emplace_back();
      cameras.back().name = NameOf(tag, "serial");
      corner_px.setZero();
    }
    if (cameras.empty()) continue;
    CameraCalibration& camera = cameras.back();
    if (tag.name == "fov_video") {
      corner_px = {One(tag, "left", file), One(tag, "top", file)};
      camera.width_px = static_cast<int>(std::lround(One(tag, "right", file) - corner_px.x())) + 1;
      camera.height_px =
          static_cast<int>(std::lround(One(tag, "bottom", file) - corner_px.y())) + 1;
    } else if (tag.name == "transform") {
      camera.X_CW = QualisysPose(tag, file);
    } else if (tag.name == "intrinsic") {
      camera.lens = QualisysLens(tag, corner_px, file);
      if (camera.width_px == 0) {
        camera.width_px = static_cast<int>((One(tag, "sensorMaxU", file) + 1) / kQualisysUnits);
        camera.height_px = static_cast<int>((One(tag, "sensorMaxV", file) + 1) / kQualisysUnits);
      }
    }
  }
  if (cameras.empty())
    throw SetupError(file.string() + ": holds no <camera>; a .qca.txt is wanted");
  return cameras;
}

void WriteQualisys(const std::filesystem::path& file, const Cameras& cameras) {
  std::ostringstream out;
  out << "<calibration>\n <cameras>\n";
  for (const CameraCalibration& camera : cameras) {
    const OpenCvLens lens = AsOpenCvLens(camera);
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
        64 * camera.width_px - 1, 64 * camera.height_px - 1, kQualisysUnits * lens.K(0, 0),
        kQualisysUnits * lens.K(1, 1), kQualisysUnits * lens.K(0, 2), kQualisysUnits * lens.K(1, 2),
        d[0], d[1], d[4], d[2], d[3]);
  }
  out << " </cameras>\n</calibration>\n";
  ReplaceText(file, out.str());
}

Cameras ReadVicon(const std::filesystem::path& file) {
  Cameras cameras;
  XmlTag camera;
  bool waits = false;
  for (const XmlTag& tag : ReadXmlTags(file)) {
    if (tag.name == "Camera") {
      camera = tag;
      waits = true;
    } else if (tag.name == "KeyFrame" && waits) {
      cameras.push_back(ReadViconCamera(camera, tag, file));
      waits = false;
    }
  }
  if (cameras.empty())
    throw SetupError(file.string() + ": holds no <Camera> with a <KeyFrame>; a .xcp is wanted");
  return cameras;
}

void WriteVicon(const std::filesystem::path& file, const Cameras& cameras) {
  std::ostringstream out;
  out << "<Cameras VERSION=\"1.0\">\n";
  for (const CameraCalibration& camera : cameras) {
    const OpenCvLens lens = AsOpenCvLens(camera);
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
  ReplaceText(file, out.str());
}

}  // namespace mocap
