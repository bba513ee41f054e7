#include "tools/witness/fetch_model.h"

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/errors.h"
#include "daemon/base/other_program.h"
#include "drivers/take/text_file.h"
#include "tools/solving/work_folder.h"
#include "tools/witness/self_test.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

/// Debian's: another one in PATH may be without numpy.
constexpr const char* kPython = "/usr/bin/python3";

/// A package of 41 MB takes a slow line some minutes.
constexpr ProgramLimits kFetchLimits{.patience = std::chrono::minutes(15),
                                     .longest_output = 1 << 20};

bool Succeeds(const ProgramRun& run) {
  return run.end == ProgramRun::End::kExited && run.number == 0;
}

/// Runs a program that must succeed.
void Need(const std::vector<std::string>& command, const std::string& to_do) {
  const ProgramRun run = RunOtherProgram(command, "", kFetchLimits);
  if (!Succeeds(run))
    throw std::runtime_error(command.front() + " could not " + to_do + ": " + run.last_words);
}

/// npm's last words are never why.
void Download(const std::string& package, const fs::path& folder) {
  const ProgramRun run = RunOtherProgram(
      {"npm", "pack", "--loglevel=error", "--pack-destination", folder.string(), package}, "",
      kFetchLimits);
  if (!Succeeds(run))
    throw std::runtime_error("npm could not download " + package +
                             ": is there a connection to its registry? npm pack " + package +
                             " says more");
}

void RequirePrograms() {
  for (const char* program : {"npm", "tar"})
    if (!IsProgram(program))
      throw SetupError("--fetch needs the program " + std::string(program) +
                       "; it is in the Debian package of that name");
  if (!Succeeds(RunOtherProgram({kPython, "-c", "import numpy"}, "", kFetchLimits)))
    throw SetupError("--fetch needs Python with numpy; it is in the Debian package python3-numpy");
}

/// The only file that npm has left.
fs::path PackageIn(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".tgz") return entry.path();
  throw std::runtime_error("npm said that it downloaded a package, but left none");
}

}  // namespace

fs::path ModelFolder() {
  if (const char* data = std::getenv("XDG_DATA_HOME"); data && *data)
    return fs::path(data) / "mocap/models";
  const char* home = std::getenv("HOME");
  if (!home || !*home)
    throw SetupError("HOME is not set; expected a folder for networks, or --out");
  return fs::path(home) / ".local/share/mocap/models";
}

fs::path FetchedModel(const fs::path& folder) { return folder / "blazepose_full.onnx"; }

ModelSource BlazePoseSource() {
  return {.package = "@mediapipe/pose@0.5.1675469404", .file = "pose_landmark_full.tflite"};
}

fs::path FetchModel(const ModelSource& source, const fs::path& folder) {
  RequirePrograms();
  MakeFolder(folder);
  const WorkFolder folder_of_work;
  const fs::path& work = folder_of_work.path();
  Download(source.package, work);
  const std::string inside = "package/" + source.file;
  Need({"tar", "-xzf", PackageIn(work).string(), "-C", work.string(), inside}, "unpack " + inside);
  const fs::path script = work / "convert_tflite.py", converted = work / "pose.onnx";
  WriteText(script, kTfliteConverter);
  // Coordinates and presence; heatmaps and segmentation would only cost time.
  Need({kPython, script.string(), (work / inside).string(), converted.string(), "195", "1"},
       "convert " + source.file);
  PoseNetwork network(converted);
  RequireGoodAnswers(network, converted);
  fs::path model = FetchedModel(folder);
  const fs::path unfinished = model.string() + ".new";
  fs::copy_file(converted, unfinished, fs::copy_options::overwrite_existing);
  fs::rename(unfinished, model);
  return model;
}

}  // namespace mocap
