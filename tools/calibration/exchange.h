// Calibrations of other programs. Their functions state frames and units. Ours: millimetres, world
// to camera; camera x right, y down, z forward; integers at pixel centres.
//
// Readers return a file's content; only CheckForeignCameras validates it. Writers return texts;
// only ExportCameras writes them, after reading them back as the same cameras.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/calibration/foreign_camera.h"

namespace mocap {

/// A file to be written.
struct TextFile {
  std::string name;  ///< In the folder; empty for single-file formats.
  std::string text;
};

/// Names of the readable and writable formats: "mocap", "pose2sim" ….
const std::vector<std::string>& ImportFormats();
const std::vector<std::string>& ExportFormats();

/// Reads and checks a calibration. @throws SetupError  naming file and key, what was found and what
/// was expected.
Imported ImportCameras(const std::string& format, const std::filesystem::path& in,
                       const ImportOptions& options = {});

/// Writes a calibration, after reading it back as the same cameras.
/// @throws SetupError  when the format cannot represent a camera: its lens, its head, its name.
void ExportCameras(const std::string& format, const std::filesystem::path& out,
                   const Cameras& cameras, const ImportOptions& options = {});

/// Pose2Sim, aniposelib and Caliscope: TOML with a table per camera. `matrix`, `distortions` (4, 5
/// or 8; fisheye 4), `rotation` a rotation vector (or, Caliscope, a matrix), `translation`; world
/// to camera. Metres in Pose2Sim and Caliscope; aniposelib uses the unit of its board.
/// @param unit_mm  length of the file's unit.
std::vector<ForeignCamera> ReadPose2Sim(const std::filesystem::path& file, double unit_mm);
std::vector<TextFile> Pose2SimText(const Cameras& cameras, double unit_mm);

/// EasyMocap: a folder with intri.yml and extri.yml in OpenCV's YAML; metres, world to camera. The
/// picture's size is in `H_<name>` and `W_<name>`, or missing.
std::vector<ForeignCamera> ReadEasyMocap(const std::filesystem::path& intri_file,
                                         const std::filesystem::path& extri_file);
std::vector<TextFile> EasyMocapText(const Cameras& cameras);

/// OpenCV's YAML or XML, as its calibration sample writes it: a folder with one file per camera.
/// Keys: `camera_matrix`, `distortion_coefficients`, `image_width`, `image_height`; optionally
/// `rotation` (3 x 3, or a rotation vector) and `translation` (mm), world to camera. ROS's
/// camera_info is the same with a `distortion_model` and without a pose.
std::vector<ForeignCamera> ReadOpenCv(const std::filesystem::path& folder);
std::vector<TextFile> OpenCvText(const Cameras& cameras);

/// Kalibr's camchain: YAML with cam0, cam1 …; pinhole with radtan, equidistant or no distortion;
/// T_cn_cnm1 takes points of the camera before to this one's, in metres. The world is cam0's frame.
std::vector<ForeignCamera> ReadKalibr(const std::filesystem::path& file);

/// Reg Willson's files: a folder with one NAME.cal per camera. Numbers: Ncx Nfx dx dy dpx dpy Cx Cy
/// sx f κ1 Tx Ty Tz Rx Ry Rz p1 p2; mm and rad, R = Rz Ry Rx, world to camera. The picture's height
/// is missing.
std::vector<ForeignCamera> ReadWillson(const std::filesystem::path& folder);
std::vector<TextFile> WillsonText(const Cameras& cameras);

/// Qualisys .qca.txt (XML): mm; the camera looks along its negative z axis; intrinsics in 1/64
/// pixel.
std::vector<ForeignCamera> ReadQualisys(const std::filesystem::path& file);
std::vector<TextFile> QualisysText(const Cameras& cameras);

/// Vicon .xcp (XML): mm; quaternion x y z w of world to camera, position of the lens. Its radial
/// polynomial maps distorted to undistorted, in pixels from the principal point; we invert it by
/// fitting. Only partly documented: check against known reprojections before relying on it.
std::vector<ForeignCamera> ReadVicon(const std::filesystem::path& file);
std::vector<TextFile> ViconText(const Cameras& cameras);

/// Returns the OpenCV lens that maps like `lens` over the picture: itself if it is one, else a fit.
/// @throws SetupError  naming the camera when the fit leaves more than 0.25 px.
OpenCvLens AsOpenCvLens(const CameraCalibration& camera);

/// Returns that lens for formats with five coefficients. @throws SetupError  for a rational one.
OpenCvLens AsFiveCoefficients(const CameraCalibration& camera, const std::string& format);

/// Fits an OpenCV lens to directions and their pixels. @param name  for messages.
OpenCvLens FitOpenCvLens(const std::string& name, const OpenCvLens& start,
                         const std::vector<Vector2>& normalized,
                         const std::vector<Vector2>& pixels);

/// Returns the Tsai lens with the most similar mapping; errors as above.
TsaiLens AsTsaiLens(const CameraCalibration& camera);

/// Returns the root mean square difference of two lenses over a picture's directions [px].
double LensDifferencePx(const CameraCalibration& a, const Lens& b);

}  // namespace mocap
