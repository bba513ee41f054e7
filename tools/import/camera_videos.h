// Which video belongs to which camera.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace mocap {

/// A camera's video.
struct NamedVideo {
  std::string camera;
  std::filesystem::path file;
};

/// Matches videos with cameras, by `NAME=FILE`, by the name in the file's name (cam1.mp4,
/// walk_cam1.mov), or in that of its folder (cam1/IMG_0815.MOV). If no file has any camera's name,
/// and there are as many files as cameras, they belong together in their order.
/// @param option   for messages, such as "--background".
/// @param remarks  gets what was decided by order.
/// @return  in the order of the cameras.
/// @throws SetupError  naming the file: no camera, several cameras, or a camera that has a video.
std::vector<NamedVideo> MatchVideos(std::span<const std::string> arguments,
                                    const std::vector<std::string>& cameras,
                                    const std::string& option, std::vector<std::string>& remarks);

}  // namespace mocap
