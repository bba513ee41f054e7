// Qualisys and Vicon.
#include <fmt/format.h>

#include <Eigen/QR>
#include <cmath>
#include <sstream>

#include "core/errors.h"
#include "drivers/quoted.h"
#include "tools/calibration/exchange.h"
#include "tools/calibration/xml_tags.h"

namespace mocap {
namespace {

constexpr double kQualisysUnits = 64;  // Per pixel.
constexpr int kGrid = 12;

// Qualisys cameras look along negative z, with y up.
const Matrix3 kTurnedOver = Vector3(1, -1, -1).asDiagonal();

std::string Where(const std::filesystem::path& file, const XmlTag& tag, const std::string& key) {
  return fmt::format("{}:{}: {}.{}", Printable(file.string()), tag.line, tag.name, key);
}

ForeignCamera NamedCamera(const std::filesystem::path& file, const XmlTag& tag, const char* key) {
  if (!tag.Has(key)) throw SetupError(Where(file, tag, key) + " is missing; expected a name");
  ForeignCamera camera;
  camera.where = Where(file, tag, key);
  camera.name = tag.attributes.at(key);
  return camera;
}

double One(const XmlTag& tag, const std::string& key, const std::filesystem::path& file) {
  return XmlNumbers(tag, key, 1, file)[0];
}

void SetPose(const Matrix3& R_CW, const Vector3& p_WC, const std::string& rotation_where,
             const std::string& translation_where, ForeignCamera& camera) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = R_CW;
  const Vector3 t = -(R_CW * p_WC);
  camera.rotation = ForeignNumbers{rotation_where, {R.data(), R.data() + 9}};
  camera.translation_mm = ForeignNumbers{translation_where, {t.data(), t.data() + 3}};
}

void TakeQualisysLens(const XmlTag& tag, const Vector2& corner_px,
                      const std::filesystem::path& file, ForeignCamera& camera) {
  const auto one = [&](const char* key) { return One(tag, key, file); };
  camera.matrix = {Where(file, tag, "focalLengthU"),
                   {one("focalLengthU") / kQualisysUnits, 0,
                    one("centerPointU") / kQualisysUnits - corner_px.x(), 0,
                    one("focalLengthV") / kQualisysUnits,
                    one("centerPointV") / kQualisysUnits - corner_px.y(), 0, 0, 1}};
  if (tag.Has("skew")) camera.matrix.values[1] = one("skew") / kQualisysUnits;
  camera.distortion = {
      Where(file, tag, "radialDistortion1"),
      {one("radialDistortion1"), one("radialDistortion2"), one("tangentalDistortion1"),
       one("tangentalDistortion2"), tag.Has("radialDistortion3") ? one("radialDistortion3") : 0}};
}

void TakeQualisysPose(const XmlTag& tag, const std::filesystem::path& file, ForeignCamera& camera) {
  Matrix3 M;
  for (int i = 0; i < 9; ++i)
    M(i / 3, i % 3) = One(tag, fmt::format("r{}{}", i / 3 + 1, i % 3 + 1), file);
  const Vector3 p_WC(One(tag, "x", file), One(tag, "y", file), One(tag, "z", file));
  SetPose(kTurnedOver * M, p_WC, Where(file, tag, "r11"), Where(file, tag, "x"), camera);
}

// r_u = r_d (1 + k1 r_d² + k2 r_d⁴ + k3 r_d⁶), pixels from the principal point.
Vector3 ReadViconRadial(const XmlTag& key_frame, const std::filesystem::path& file) {
  if (key_frame.Has("VICON_RADIAL2")) {
    // The model's name, the centre, then the coefficients.
    XmlTag numbers = key_frame;
    std::string& text = numbers.attributes["VICON_RADIAL2"];
    text.erase(0, text.find_first_of(" \t"));
    const std::vector<double> n = XmlNumbers(numbers, "VICON_RADIAL2", 5, file);
    return {n[2], n[3], n[4]};
  }
  if (!key_frame.Has("VICON_RADIAL")) return Vector3::Zero();
  const std::vector<double> n = XmlNumbers(key_frame, "VICON_RADIAL", 2, file);
  return {n[0], n[1], 0};
}

Lens FitViconLens(const ForeignCamera& camera, const OpenCvLens& start, const Vector3& k) {
  const double f = start.K(0, 0), aspect = f / start.K(1, 1);
  const Vector2 center = start.K.topRightCorner<2, 1>();
  std::vector<Vector2> normalized, pixels;
  for (int i = 0; i <= kGrid; ++i) {
    for (int j = 0; j <= kGrid; ++j) {
      const Vector2 pixel((camera.size_px.values[0] - 1) * i / kGrid,
                          (camera.size_px.values[1] - 1) * j / kGrid);
      Vector2 d = pixel - center;
      d.y() *= aspect;
      const double r2 = d.squaredNorm();
      normalized.push_back(d * (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[2]))) / f);
      pixels.push_back(pixel);
    }
  }
  return FitOpenCvLens(camera.where, start, normalized, pixels);
}

ForeignCamera ReadViconCamera(const XmlTag& camera_tag, const XmlTag* key_frame,
                              const std::filesystem::path& file) {
  ForeignCamera camera = NamedCamera(file, camera_tag, "DEVICEID");
  camera.size_px = {Where(file, camera_tag, "SENSOR_SIZE"),
                    XmlNumbers(camera_tag, "SENSOR_SIZE", 2, file)};
  camera.has_lens = key_frame != nullptr;
  if (!camera.has_lens) return camera;
  const double aspect =
      camera_tag.Has("PIXEL_ASPECT_RATIO") ? One(camera_tag, "PIXEL_ASPECT_RATIO", file) : 1;
  const double f = One(*key_frame, "FOCAL_LENGTH", file);
  const std::vector<double> c = XmlNumbers(*key_frame, "PRINCIPAL_POINT", 2, file);
  if (!(aspect > 0))
    throw SetupError(Where(file, camera_tag, "PIXEL_ASPECT_RATIO") + " is not above 0");
  camera.matrix = {Where(file, *key_frame, "FOCAL_LENGTH"),
                   {f, 0, c[0], 0, f / aspect, c[1], 0, 0, 1}};
  camera.distortion = {Where(file, *key_frame, "VICON_RADIAL2"), {}};
  // Fitting requires data that pass the check.
  const Imported plain = CheckForeignCameras(file.string(), {camera}, {.lenses_alone = true});
  const Vector3 k = ReadViconRadial(*key_frame, file);
  camera.lens = FitViconLens(camera, std::get<OpenCvLens>(plain.cameras[0].lens), k);
  const std::vector<double> q = XmlNumbers(*key_frame, "ORIENTATION", 4, file);
  const std::vector<double> p = XmlNumbers(*key_frame, "POSITION", 3, file);
  const Eigen::Quaterniond q_CW(q[3], q[0], q[1], q[2]);
  if (!(std::abs(q_CW.norm() - 1) < 1e-2))
    throw SetupError(Where(file, *key_frame, "ORIENTATION") +
                     " is not a unit quaternion; expected x y z w");
  SetPose(q_CW.normalized().toRotationMatrix(), {p[0], p[1], p[2]},
          Where(file, *key_frame, "ORIENTATION"), Where(file, *key_frame, "POSITION"), camera);
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

std::vector<ForeignCamera> ReadQualisys(const std::filesystem::path& file) {
  std::vector<ForeignCamera> cameras;
  Vector2 corner_px = Vector2::Zero();
  for (const XmlTag& tag : ReadXmlTags(file)) {
    if (tag.name == "camera") {
      cameras.push_back(NamedCamera(file, tag, "serial"));
      corner_px.setZero();
    }
    if (cameras.empty()) continue;
    ForeignCamera& camera = cameras.back();
    if (tag.name == "fov_video") {
      corner_px = {One(tag, "left", file), One(tag, "top", file)};
      camera.size_px = {Where(file, tag, "right"),
                        {std::round(One(tag, "right", file) - corner_px.x()) + 1,
                         std::round(One(tag, "bottom", file) - corner_px.y()) + 1}};
    } else if (tag.name == "transform") {
      TakeQualisysPose(tag, file, camera);
    } else if (tag.name == "intrinsic") {
      TakeQualisysLens(tag, corner_px, file, camera);
      if (camera.size_px.values.empty())
        camera.size_px = {Where(file, tag, "sensorMaxU"),
                          {std::floor((One(tag, "sensorMaxU", file) + 1) / kQualisysUnits),
                           std::floor((One(tag, "sensorMaxV", file) + 1) / kQualisysUnits)}};
    }
  }
  if (cameras.empty())
    throw SetupError(file.string() + ": contains no <camera>; expected a .qca.txt");
  for (ForeignCamera& camera : cameras) camera.has_lens = !camera.matrix.values.empty();
  return cameras;
}

std::vector<TextFile> QualisysText(const Cameras& cameras) {
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
        64 * camera.width_px - 1, 64 * camera.height_px - 1, kQualisysUnits * lens.K(0, 0),
        kQualisysUnits * lens.K(1, 1), kQualisysUnits * lens.K(0, 2), kQualisysUnits * lens.K(1, 2),
        d[0], d[1], d[4], d[2], d[3]);
  }
  out << " </cameras>\n</calibration>\n";
  return {{"", out.str()}};
}

std::vector<ForeignCamera> ReadVicon(const std::filesystem::path& file) {
  std::vector<ForeignCamera> cameras;
  const std::vector<XmlTag> tags = ReadXmlTags(file);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (tags[i].name != "Camera") continue;
    const XmlTag* key_frame = nullptr;
    for (std::size_t k = i + 1; k < tags.size() && tags[k].name != "Camera"; ++k) {
      if (tags[k].name == "KeyFrame" && key_frame == nullptr) key_frame = &tags[k];
    }
    cameras.push_back(ReadViconCamera(tags[i], key_frame, file));
  }
  if (cameras.empty()) throw SetupError(file.string() + ": contains no <Camera>; expected a .xcp");
  return cameras;
}

std::vector<TextFile> ViconText(const Cameras& cameras) {
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
