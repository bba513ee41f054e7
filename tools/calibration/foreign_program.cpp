#include "tools/calibration/foreign_program.h"

namespace mocap {
namespace {

// OpenCV's own files and ROS's camera_info, the same without a pose. Lengths are millimetres.
ForeignProgram OpenCv(const char* name, TextFiles (*write)(const Cameras&, const ForeignProgram&)) {
  return {
      .name = name,
      .files = {".yml", ".yaml", ".xml"},
      .size = "image_width image_height",
      .matrix = "camera_matrix",
      .distortion = "distortion_coefficients",
      .rotation = "rotation",
      .translation = "translation",
      // OpenCV's sample tells this only in flags or a comment; our files have the first key.
      .lens_keys = {{"fisheye_model", "0", "1"},
                    {"distortion_model", "plumb_bob rational_polynomial", "equidistant fisheye"}},
      .may_lack_poses = true,
      .read = ReadOpenCv,
      .write = write};
}

}  // namespace

const std::vector<ForeignProgram>& ForeignPrograms() {
  static const std::vector<ForeignProgram> programs = {
      // Metres in Pose2Sim and Caliscope; aniposelib uses the unit of its board.
      {.name = "pose2sim",
       .size = "size",
       .matrix = "matrix",
       .distortion = "distortions",
       .rotation = "rotation",
       .translation = "translation",
       .lens_keys = {{"fisheye", "false", "true"}},
       .has_own_unit = true,
       .needs_lens = false,
       .read = ReadPose2Sim,
       .write = Pose2SimText},
      {.name = "easymocap",
       .files = {"intri.yml", "extri.yml"},
       .size = "W_* H_*",
       .matrix = "K_*",
       .distortion = "dist_*|D_*",
       .rotation = "Rot_*|R_*",
       .translation = "T_*",
       .unit_mm = 1000,
       .read = ReadEasyMocap,
       .write = EasyMocapText},
      OpenCv("opencv", OpenCvText),
      OpenCv("ros", nullptr),
      // T_cn_cnm1 takes points of the camera before to this one's, in metres; the world is cam0.
      {.name = "kalibr",
       .size = "resolution",
       .matrix = "intrinsics",
       .distortion = "distortion_coeffs",
       .lens_keys = {{"distortion_model", "radtan none", "equidistant"}},
       .read = ReadKalibr},
      {.name = "willson",
       .files = {".cal"},
       .size = "Nfx",
       .rotation = "Rx Ry Rz",
       .translation = "Tx Ty Tz",
       .is_euler = true,
       .read = ReadWillson,
       .write = WillsonText},
      {.name = "qualisys",
       .matrix = "intrinsic.focalLengthU intrinsic.focalLengthV intrinsic.centerPointU "
                 "intrinsic.centerPointV intrinsic.skew|0",
       .distortion = "intrinsic.radialDistortion1 intrinsic.radialDistortion2 "
                     "intrinsic.tangentalDistortion1 intrinsic.tangentalDistortion2 "
                     "intrinsic.radialDistortion3|0",
       .rotation = "transform.r11 transform.r12 transform.r13 transform.r21 transform.r22 "
                   "transform.r23 transform.r31 transform.r32 transform.r33",
       .translation = "transform.x transform.y transform.z",
       .unit_px = 1.0 / 64,
       .needs_lens = false,
       .is_position = true,
       .looks_back = true,
       .read = ReadQualisys,
       .write = QualisysText},
      // Only partly documented: check against known reprojections before relying on it.
      {.name = "vicon",
       .matrix = "FOCAL_LENGTH FOCAL_LENGTH PRINCIPAL_POINT",
       .rotation = "ORIENTATION",
       .translation = "POSITION",
       .is_position = true,
       .read = ReadVicon,
       .write = ViconText},
  };
  return programs;
}

}  // namespace mocap
