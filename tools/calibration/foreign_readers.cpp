// Reads cameras by the keys of their programs, and what keys alone do not say.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "core/errors.h"
#include "drivers/quoted.h"
#include "drivers/take/take_layout.h"
#include "tools/calibration/foreign_program.h"
#include "tools/calibration/lens_conversion.h"

namespace mocap {
namespace {

using ForeignCameras = std::vector<ForeignCamera>;

// The numbers of Willson's files, in their order; the last two may be missing.
constexpr std::array kWillsonKeys = {"Ncx", "Nfx", "dx", "dy",     "dpx", "dpy", "Cx",
                                     "Cy",  "sx",  "f",  "kappa1", "Tx",  "Ty",  "Tz",
                                     "Rx",  "Ry",  "Rz", "p1",     "p2"};
constexpr std::size_t kLeastWillsonNumbers = 17;

std::vector<std::string> WordsOf(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

// The keys of a value in this file. Of names of versions it is the first that the file has.
std::vector<std::string> KeysIn(const ForeignTable& table, const std::string& patterns,
                                const std::string& name) {
  std::vector<std::string> keys = WordsOf(patterns);
  for (std::string& key : keys) {
    const std::size_t bar = key.find('|');
    std::vector<std::string> versions = {key.substr(0, bar)};
    if (bar != key.npos) versions.push_back(key.substr(bar + 1));
    for (std::string& version : versions) {
      if (const std::size_t star = version.find('*'); star != version.npos)
        version.replace(star, 1, name);
    }
    const auto place = std::ranges::find_if(
        versions, [&](const std::string& version) { return table.Has(version); });
    const bool may_be_missing = versions.back() == "0";
    key = place != versions.end() ? *place : may_be_missing ? "0" : versions[0];
  }
  return keys;
}

/// Reads a value. Empty: the file has none of its keys. An incomplete one is an error.
std::optional<ForeignNumbers> ReadValue(const ForeignTable& table,
                                        const std::vector<std::string>& keys, double unit = 1) {
  const auto has = [&](const std::string& key) { return table.Has(key); };
  if (std::ranges::none_of(keys, has)) return std::nullopt;
  ForeignNumbers all{table.Where(keys[0]), {}};
  for (const std::string& key : keys) {
    const std::vector<double> values = key == "0" ? std::vector{0.0} : table.Numbers(key).values;
    for (const double value : values) all.values.push_back(value * unit);
  }
  return all;
}

ForeignNumbers ReadNeeded(const ForeignTable& table, const std::vector<std::string>& keys) {
  const std::optional<ForeignNumbers> value = ReadValue(table, keys);
  if (!value) table.Fail(keys[0], "is missing; expected numbers");
  return *value;
}

// @return  whether the lens is distorted.
bool ReadLensKind(const ForeignTable& table, const LensKey& lens_key, ForeignCamera& camera) {
  const std::string kind = table.Has(lens_key.key) ? table.Text(lens_key.key) : "";
  const std::vector<std::string> pinholes = WordsOf(lens_key.pinhole);
  const std::vector<std::string> fisheyes = WordsOf(lens_key.fisheye);
  if (std::ranges::count(fisheyes, kind) > 0) {
    camera.is_fisheye = true;
  } else if (!kind.empty() && std::ranges::count(pinholes, kind) == 0) {
    table.Fail(lens_key.key, fmt::format("is {}; expected {} or {}", Quoted(kind),
                                         fmt::join(pinholes, ", "), fmt::join(fisheyes, " or ")));
  }
  return kind != "none";
}

ForeignCamera ReadByKeys(const ForeignProgram& program, const std::string& name,
                         const ForeignTable& intrinsics, const ForeignTable& extrinsics) {
  ForeignCamera camera;
  camera.name = name;
  camera.is_euler = program.is_euler;
  camera.is_position = program.is_position;
  camera.looks_back = program.looks_back;
  const auto size_keys = KeysIn(intrinsics, program.size, name);
  if (!size_keys.empty())
    camera.size_px = ReadValue(intrinsics, size_keys)
                         .value_or(ForeignNumbers{intrinsics.Where(size_keys[0]), {}});
  const auto pose_part = [&](const std::string& keys, double unit) {
    auto part = ReadValue(extrinsics, KeysIn(extrinsics, keys, name), unit);
    return part && part->values.empty() ? std::nullopt : part;
  };
  camera.rotation = pose_part(program.rotation, 1);
  camera.translation_mm = pose_part(program.translation, program.unit_mm);
  if (program.matrix.empty()) return camera;
  const auto matrix_keys = KeysIn(intrinsics, program.matrix, name);
  const auto matrix = ReadValue(intrinsics, matrix_keys, program.unit_px);
  camera.has_lens = matrix || program.needs_lens;
  if (!camera.has_lens) return camera;
  camera.matrix = matrix ? *matrix : ReadNeeded(intrinsics, matrix_keys);
  bool is_distorted = !program.distortion.empty();
  for (const LensKey& lens_key : program.lens_keys)
    is_distorted = ReadLensKind(intrinsics, lens_key, camera) && is_distorted;
  if (is_distorted)
    camera.distortion = ReadNeeded(intrinsics, KeysIn(intrinsics, program.distortion, name));
  return camera;
}

Lens FitViconLens(const ForeignCamera& camera, const OpenCvLens& start, const Vector3& k) {
  const double f = start.K(0, 0), aspect = f / start.K(1, 1);
  const Vector2 center = start.K.topRightCorner<2, 1>();
  std::vector<Vector2> normalized, pixels;
  for (int i = 0; i <= kViconGrid; ++i) {
    for (int j = 0; j <= kViconGrid; ++j) {
      const Vector2 pixel((camera.size_px.values[0] - 1) * i / kViconGrid,
                          (camera.size_px.values[1] - 1) * j / kViconGrid);
      Vector2 d = pixel - center;
      d.y() *= aspect;
      const double r2 = d.squaredNorm();
      normalized.push_back(d * (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[2]))) / f);
      pixels.push_back(pixel);
    }
  }
  return FitOpenCvLens(camera.where, start, normalized, pixels);
}

// r_u = r_d (1 + k1 r_d² + k2 r_d⁴ + k3 r_d⁶), pixels from the principal point.
Vector3 ReadViconRadial(const ForeignTable& key_frame) {
  const bool is_newer = key_frame.Has("VICON_RADIAL2");
  const std::string key = is_newer ? "VICON_RADIAL2" : "VICON_RADIAL";
  if (!key_frame.Has(key)) return Vector3::Zero();
  // The newer one has the model's name and the centre before three coefficients, the older one two.
  std::vector<std::string> words = WordsOf(key_frame.Text(key));
  if (is_newer && !words.empty()) words.erase(words.begin());
  std::vector<double> n;
  for (const std::string& word : words) n.push_back(FiniteNumber(word, key_frame.Where(key)));
  if (n.size() < (is_newer ? 5 : 2)) key_frame.Fail(key, "has too few numbers");
  return is_newer ? Vector3(n[2], n[3], n[4]) : Vector3(n[0], n[1], 0);
}

ForeignCamera ReadViconCamera(const ForeignProgram& program, const ForeignTable& table) {
  const std::string name = table.Text("DEVICEID");
  const std::vector<ForeignTable> key_frames = table.Tables("KeyFrame");
  ForeignCamera camera;
  if (key_frames.empty()) {
    camera.has_lens = false;
  } else {
    camera = ReadByKeys(program, name, key_frames[0], key_frames[0]);
  }
  camera.name = name;
  camera.where = table.Where("DEVICEID");
  camera.size_px = ReadNeeded(table, {"SENSOR_SIZE"});
  if (!camera.has_lens) return camera;
  const double aspect = table.Has("PIXEL_ASPECT_RATIO") ? table.Number("PIXEL_ASPECT_RATIO") : 1;
  if (!(aspect > 0)) table.Fail("PIXEL_ASPECT_RATIO", "is not above 0");
  camera.matrix.values[1] /= aspect;
  // Fitting requires data that pass the check.
  const Imported plain = CheckForeignCameras(camera.where, {camera}, {.lenses_alone = true});
  camera.lens = FitViconLens(camera, std::get<OpenCvLens>(plain.cameras[0].lens),
                             ReadViconRadial(key_frames[0]));
  return camera;
}

// Transform from the previous camera.
RigidTransform ReadKalibrLink(const ForeignTable& table) {
  const ForeignNumbers T = table.Numbers("T_cn_cnm1");
  const std::vector<double>& n = T.values;
  if (n.size() != 16 || n[12] != 0 || n[13] != 0 || n[14] != 0 || n[15] != 1)
    throw SetupError(T.where + " is not a rigid transform; expected [R t; 0 0 0 1]");
  ForeignCamera link;
  link.rotation = {T.where, {n[0], n[1], n[2], n[4], n[5], n[6], n[8], n[9], n[10]}};
  link.translation_mm = {T.where, {1000 * n[3], 1000 * n[7], 1000 * n[11]}};
  return CheckForeignPose(link);
}

}  // namespace

ForeignCameras ReadPose2Sim(const TextFiles& files, const ForeignProgram& program) {
  const ForeignTable root = ForeignTable::OfToml(files[0].text, files[0].name);
  ForeignCameras cameras;
  // Caliscope has its cameras in a separate table.
  for (const ForeignTable& table : root.Table("cameras").value_or(root).Tables()) {
    if (!table.Has("matrix") && !table.Has("size")) continue;
    std::string name = table.Has("name") ? table.Text("name") : table.Name();
    // Caliscope and aniposelib allow any camera name; if it is invalid, use the table's.
    if (!IsCameraName(name) && IsCameraName(table.Name())) name = table.Name();
    cameras.push_back(ReadByKeys(program, name, table, table));
    cameras.back().where = table.Where("name");
  }
  if (cameras.empty())
    throw SetupError(files[0].name +
                     ": contains no camera; expected a table with matrix, distortions, rotation "
                     "and translation");
  return cameras;
}

ForeignCameras ReadEasyMocap(const TextFiles& files, const ForeignProgram& program) {
  const ForeignTable intri = ForeignTable::OfYaml(files[0].text, files[0].name);
  const ForeignTable extri = ForeignTable::OfYaml(files[1].text, files[1].name);
  ForeignCameras cameras;
  if (intri.Has("names")) {
    for (const std::string& name : intri.Words("names")) {
      cameras.push_back(ReadByKeys(program, name, intri, extri));
      cameras.back().where = intri.Where("names");
    }
  }
  if (cameras.empty()) intri.Fail("names", "lists no camera; expected a list of names");
  return cameras;
}

ForeignCameras ReadOpenCv(const TextFiles& files, const ForeignProgram& program) {
  ForeignCameras cameras;
  for (const TextFile& file : files) {
    const std::size_t first = file.text.find_first_not_of("\xEF\xBB\xBF \t\r\n");
    const bool is_xml = first != std::string::npos && file.text[first] == '<';
    const std::optional<ForeignTable> table =
        is_xml ? ForeignTable::OfXml(file.text, file.name).Table("opencv_storage")
               : ForeignTable::OfYaml(file.text, file.name);
    if (!table) throw SetupError(file.name + ": is not XML of OpenCV; expected <opencv_storage>");
    const std::string name = std::filesystem::path(file.name).stem().string();
    cameras.push_back(ReadByKeys(program, name, *table, *table));
    cameras.back().where = file.name;
  }
  return cameras;
}

ForeignCameras ReadKalibr(const TextFiles& files, const ForeignProgram& program) {
  const ForeignTable root = ForeignTable::OfYaml(files[0].text, files[0].name);
  ForeignCameras cameras;
  // The chain's first camera is the world. After a missing link, cameras have no pose.
  std::optional<RigidTransform> X_CW = RigidTransform{};
  for (;;) {
    const std::string name = "cam" + std::to_string(cameras.size());
    const std::optional<ForeignTable> table = root.Table(name);
    if (!table) break;
    if (const std::string model = table->Text("camera_model"); model != "pinhole")
      table->Fail("camera_model",
                  "is " + Quoted(model) + "; expected pinhole: calibrate with a pinhole model");
    ForeignCamera camera = ReadByKeys(program, name, *table, *table);
    camera.where = root.Where(name);
    if (!cameras.empty() && !table->Has("T_cn_cnm1")) X_CW.reset();
    if (!cameras.empty() && X_CW) X_CW = ReadKalibrLink(*table) * *X_CW;
    if (X_CW) {
      const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = NearestRotation(X_CW->R);
      const Vector3& t = X_CW->p;
      camera.rotation = {table->Where("T_cn_cnm1"), {R.data(), R.data() + 9}};
      camera.translation_mm = {table->Where("T_cn_cnm1"), {t.data(), t.data() + 3}};
    }
    if (table->Text("distortion_model") == "none") camera.distortion.values.assign(4, 0);
    for (const ForeignNumbers& numbers : {camera.matrix, camera.distortion}) {
      if (numbers.values.size() != 4)
        throw SetupError(
            fmt::format("{} has {} numbers; expected 4", numbers.where, numbers.values.size()));
    }
    cameras.push_back(std::move(camera));
  }
  if (cameras.empty())
    throw SetupError(files[0].name + ": contains no cam0; expected a camchain of Kalibr");
  // A first camera alone has intrinsics only.
  if (cameras.size() == 1 || !cameras[1].rotation)
    cameras[0].rotation = cameras[0].translation_mm = std::nullopt;
  return cameras;
}

ForeignCameras ReadWillson(const TextFiles& files, const ForeignProgram& program) {
  ForeignCameras cameras;
  for (const TextFile& file : files) {
    ForeignFile numbers{file.name};
    std::istringstream in(file.text);
    std::size_t count = 0;
    for (std::string word; count <= kWillsonKeys.size() && in >> word; ++count)
      numbers.values[count < kWillsonKeys.size() ? kWillsonKeys[count] : ""].words = {word};
    if (count < kLeastWillsonNumbers || count > kWillsonKeys.size())
      throw SetupError(fmt::format(
          "{}: has {}{} numbers; expected {}", file.name,
          count > kWillsonKeys.size() ? "more than " : "", std::min(count, kWillsonKeys.size()),
          "Ncx Nfx dx dy dpx dpy Cx Cy sx f kappa1 Tx Ty Tz Rx Ry Rz [p1 p2]"));
    const ForeignTable table(std::move(numbers));
    for (std::size_t i = 0; i < count; ++i) {
      const std::string key = kWillsonKeys[i];
      const double number = table.Number(key);
      if (i >= kLeastWillsonNumbers && number != 0)
        table.Fail(key, "is other than 0; expected a lens without tangential distortion");
      if (std::ranges::count(WordsOf("dpx dpy sx f"), key) > 0 && !(number > 0))
        table.Fail(key, "must be above 0");
    }
    const auto one = [&](const char* key) { return table.Number(key); };
    const std::string name = std::filesystem::path(file.name).stem().string();
    cameras.push_back(ReadByKeys(program, name, table, table));
    cameras.back().where = file.name;
    cameras.back().lens = TsaiLens{
        one("f"), one("kappa1"), one("sx"), {one("Cx"), one("Cy")}, {one("dpx"), one("dpy")}};
  }
  return cameras;
}

ForeignCameras ReadQualisys(const TextFiles& files, const ForeignProgram& program) {
  const ForeignTable root = ForeignTable::OfXml(files[0].text, files[0].name);
  ForeignCameras cameras;
  for (const ForeignTable& table : root.Tables("camera")) {
    ForeignCamera camera = ReadByKeys(program, table.Text("serial"), table, table);
    camera.where = table.Where("serial");
    const auto one = [&](const char* key) { return table.Number(key); };
    if (table.Table("fov_video")) {
      const double left = one("fov_video.left"), top = one("fov_video.top");
      camera.size_px = {table.Where("fov_video.right"),
                        {std::round(one("fov_video.right") - left) + 1,
                         std::round(one("fov_video.bottom") - top) + 1}};
      if (camera.has_lens) camera.matrix.values[2] -= left;
      if (camera.has_lens) camera.matrix.values[3] -= top;
    } else if (camera.has_lens) {
      camera.size_px = {table.Where("intrinsic.sensorMaxU"),
                        {std::floor((one("intrinsic.sensorMaxU") + 1) * program.unit_px),
                         std::floor((one("intrinsic.sensorMaxV") + 1) * program.unit_px)}};
    }
    cameras.push_back(std::move(camera));
  }
  if (cameras.empty())
    throw SetupError(files[0].name + ": contains no <camera>; expected a .qca.txt");
  return cameras;
}

ForeignCameras ReadVicon(const TextFiles& files, const ForeignProgram& program) {
  const ForeignTable root = ForeignTable::OfXml(files[0].text, files[0].name);
  ForeignCameras cameras;
  for (const ForeignTable& table : root.Tables("Camera"))
    cameras.push_back(ReadViconCamera(program, table));
  if (cameras.empty()) throw SetupError(files[0].name + ": contains no <Camera>; expected a .xcp");
  return cameras;
}

}  // namespace mocap
