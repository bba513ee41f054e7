// Calibrations of other programs. Frames and units of each are stated with its functions; ours is
// millimetres, world to camera, camera x right, y down, z forward, whole numbers at pixel centres.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

using Cameras = std::vector<CameraCalibration>;

/// Pose2Sim, aniposelib and Caliscope: TOML with a table a camera; `matrix`, `distortions` (4 or 5;
/// fisheye 4), `rotation` a rotation vector (or, Caliscope, a matrix), `translation`; world to
/// camera. Metres in Pose2Sim and Caliscope; aniposelib's unit is that of its board.
/// @param millimetres_per_unit  what one unit of the file is.
Cameras ReadPose2Sim(const std::filesystem::path& file, double millimetres_per_unit);
void WritePose2Sim(const std::filesystem::path& file, const Cameras& cameras,
                   double millimetres_per_unit);

/// EasyMocap: a folder with intri.yml and extri.yml in OpenCV's YAML; metres, world to camera. The
/// picture's size is not part of it: twice the principal point, rounded, where `H_<name>` and
/// `W_<name>` are missing.
Cameras ReadEasyMocap(const std::filesystem::path& folder);
void WriteEasyMocap(const std::filesystem::path& folder, const Cameras& cameras);

/// OpenCV's YAML as its calibration sample writes it: one file a camera in a folder, with
/// `camera_matrix`, `distortion_coefficients`, `image_width`, `image_height`; `rotation` (3 x 3)
/// and `translation` (mm), world to camera, where there are any.
Cameras ReadOpenCvYaml(const std::filesystem::path& folder);
void WriteOpenCvYaml(const std::filesystem::path& folder, const Cameras& cameras);

/// Reg Willson's files: one NAME.cal a camera in a folder, the numbers Ncx Nfx dx dy dpx dpy Cx Cy
/// sx f κ1 Tx Ty Tz Rx Ry Rz p1 p2; mm and rad, R = Rz Ry Rx, world to camera. The height of the
/// picture is not part of it: three quarters of Nfx.
Cameras ReadWillson(const std::filesystem::path& folder);
void WriteWillson(const std::filesystem::path& folder, const Cameras& cameras);

/// Qualisys .qca.txt (XML): mm; the camera looks along its negative z axis; intrinsics in 1/64
/// pixel.
Cameras ReadQualisys(const std::filesystem::path& file);
void WriteQualisys(const std::filesystem::path& file, const Cameras& cameras);

/// Vicon .xcp (XML): mm; quaternion x y z w of world to camera, position of the lens. Its radial
/// polynomial maps distorted to undistorted, in pixels from the principal point; we turn it round
/// by fitting. Documented in parts only: check against known reprojections before trusting it.
Cameras ReadVicon(const std::filesystem::path& file);
void WriteVicon(const std::filesystem::path& file, const Cameras& cameras);

/// Gives the OpenCV lens that maps like `lens` over the picture: itself, where it is one; else
/// fitted,
/// @throws SetupError  naming the camera when that leaves more than 0.25 px.
OpenCvLens AsOpenCvLens(const CameraCalibration& camera);

/// Fits an OpenCV lens to directions and the pixels that show them. @param name  for messages.
OpenCvLens FitOpenCvLens(const std::string& name, const OpenCvLens& start,
                         const std::vector<Vector2>& normalized,
                         const std::vector<Vector2>& pixels);

/// Gives the Tsai lens that maps most alike, with errors as above.
TsaiLens AsTsaiLens(const CameraCalibration& camera);

}  // namespace mocap
