// Calibrations of other programs. Frames and units of each are stated with its functions; ours is
// millimetres, world to camera, camera x right, y down, z forward, whole numbers at pixel centres.
//
// Readers give what a file says, and CheckForeignCameras alone believes it. Writers give texts, and
// ExportCameras alone writes them, once they were read again as the same cameras.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/calibration/foreign_camera.h"

namespace mocap {

/// A file as it is to be written.
struct TextFile {
  std::string name;  ///< In the folder; empty for formats of one file.
  std::string text;
};

/// Names of the formats that can be read, and written: "mocap", "pose2sim" ….
const std::vector<std::string>& ImportFormats();
const std::vector<std::string>& ExportFormats();

/// Reads a calibration and checks it. @throws SetupError  naming file and key, what was found and
/// what is wanted.
Imported ImportCameras(const std::string& format, const std::filesystem::path& in,
                       const ImportOptions& options = {});

/// Writes a calibration, after having read it again as the same cameras.
/// @throws SetupError  when the format cannot hold a camera: its lens, its head, its name.
void ExportCameras(const std::string& format, const std::filesystem::path& out,
                   const Cameras& cameras, const ImportOptions& options = {});

/// Pose2Sim, aniposelib and Caliscope: TOML with a table a camera; `matrix`, `distortions` (4, 5 or
/// 8; fisheye 4), `rotation` a rotation vector (or, Caliscope, a matrix), `translation`; world to
/// camera. Metres in Pose2Sim and Caliscope; aniposelib's unit is that of its board.
/// @param unit_mm  what one unit of the file is.
std::vector<ForeignCamera> ReadPose2Sim(const std::filesystem::path& file, double unit_mm);
std::vector<TextFile> Pose2SimText(const Cameras& cameras, double unit_mm);

/// EasyMocap: a folder with intri.yml and extri.yml in OpenCV's YAML; metres, world to camera. The
/// picture's size stands in `H_<name>` and `W_<name>`, or nowhere.
std::vector<ForeignCamera> ReadEasyMocap(const std::filesystem::path& intri_file,
                                         const std::filesystem::path& extri_file);
std::vector<TextFile> EasyMocapText(const Cameras& cameras);

/// OpenCV's YAML or XML as its calibration sample writes it: one file a camera in a folder, with
/// `camera_matrix`, `distortion_coefficients`, `image_width`, `image_height`; `rotation` (3 x 3, or
/// a rotation vector) and `translation` (mm), world to camera, where there are any. ROS's
/// camera_info is the same with a `distortion_model` and without a pose.
std::vector<ForeignCamera> ReadOpenCv(const std::filesystem::path& folder);
std::vector<TextFile> OpenCvText(const Cameras& cameras);

/// Kalibr's camchain: YAML with cam0, cam1 …; pinhole with radtan, equidistant or no distortion;
/// T_cn_cnm1 takes points of the camera before to this one's, in metres. The world is cam0's frame.
std::vector<ForeignCamera> ReadKalibr(const std::filesystem::path& file);

/// Reg Willson's files: one NAME.cal a camera in a folder, the numbers Ncx Nfx dx dy dpx dpy Cx Cy
/// sx f κ1 Tx Ty Tz Rx Ry Rz p1 p2; mm and rad, R = Rz Ry Rx, world to camera. The height of the
/// picture is not part of it.
std::vector<ForeignCamera> ReadWillson(const std::filesystem::path& folder);
std::vector<TextFile> WillsonText(const Cameras& cameras);

/// Qualisys .qca.txt (XML): mm; the camera looks along its negative z axis; intrinsics in 1/64
/// pixel.
std::vector<ForeignCamera> ReadQualisys(const std::filesystem::path& file);
std::vector<TextFile> QualisysText(const Cameras& cameras);

/// Vicon .xcp (XML): mm; quaternion x y z w of world to camera, position of the lens. Its radial
/// polynomial maps distorted to undistorted, in pixels from the principal point; we turn it round
/// by fitting. Documented in parts only: check against known reprojections before trusting it.
std::vector<ForeignCamera> ReadVicon(const std::filesystem::path& file);
std::vector<TextFile> ViconText(const Cameras& cameras);

/// Gives the OpenCV lens that maps like `lens` over the picture: itself, where it is one; else
/// fitted, @throws SetupError  naming the camera when that leaves more than 0.25 px.
OpenCvLens AsOpenCvLens(const CameraCalibration& camera);

/// Gives that lens for formats that know five coefficients. @throws SetupError  for a rational one.
OpenCvLens AsFiveCoefficients(const CameraCalibration& camera, const std::string& format);

/// Fits an OpenCV lens to directions and the pixels that show them. @param name  for messages.
OpenCvLens FitOpenCvLens(const std::string& name, const OpenCvLens& start,
                         const std::vector<Vector2>& normalized,
                         const std::vector<Vector2>& pixels);

/// Gives the Tsai lens that maps most alike, with errors as above.
TsaiLens AsTsaiLens(const CameraCalibration& camera);

/// Tells how far apart two lenses show the directions of a picture: the root mean square [px].
double LensDifferencePx(const CameraCalibration& a, const Lens& b);

}  // namespace mocap
