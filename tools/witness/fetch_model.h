// A pose network for who has none.
#pragma once

#include <filesystem>
#include <string>

namespace mocap {

/// tools/witness/convert_tflite.py, which is part of the program.
extern const char* const kTfliteConverter;

/// Where fetched networks are: `mocap/models` among the user's data.
/// @throws SetupError  without a home folder.
std::filesystem::path ModelFolder();
/// The fetched network there.
std::filesystem::path FetchedModel(const std::filesystem::path& folder);

/// Where a network comes from.
struct ModelSource {
  std::string package;  ///< As npm takes it: a name and version, or a file.
  std::string file;     ///< The TFLite network in the package.
};
/// The landmark network *full* of MediaPipe's BlazePose.
ModelSource BlazePoseSource();

/// Lets npm download the package, converts the network to ONNX, tests it, and keeps it in `folder`,
/// which is created.
/// @return  the file. @throws SetupError  if npm, Python or numpy is missing; std::runtime_error if
/// they fail, with their last words.
std::filesystem::path FetchModel(const ModelSource& source, const std::filesystem::path& folder);

}  // namespace mocap
