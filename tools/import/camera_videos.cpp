#include "tools/import/camera_videos.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "core/errors.h"
#include "drivers/lowered.h"
#include "drivers/nearest_name.h"
#include "drivers/quoted.h"
#include "drivers/take/input_file.h"

namespace mocap {
namespace {

bool IsOfName(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Whether a text has a name in it, not as a part of a longer one: "cam1" is not in "cam10".
bool HasName(const std::string& text, const std::string& name) {
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    const bool begins = at == 0 || !IsOfName(text[at - 1]);
    if (begins && (end == text.size() || !IsOfName(text[end]))) return true;
  }
  return false;
}

/// The cameras whose names a text has; the whole text is one alone.
std::vector<std::string> CamerasIn(const std::string& text,
                                   const std::vector<std::string>& cameras) {
  std::vector<std::string> found;
  const std::string lowered = Lowered(text);
  for (const std::string& camera : cameras) {
    if (Lowered(camera) == lowered) return {camera};
    if (HasName(lowered, Lowered(camera))) found.push_back(camera);
  }
  return found;
}

[[noreturn]] void FailToMatch(const std::string& option, const std::filesystem::path& file,
                              const std::string& what, const std::vector<std::string>& cameras) {
  throw SetupError(option + file.string() + ": " + what + "; " +
                   ExpectedNames(file.stem().string(), cameras) + "; write NAME=VIDEO, such as " +
                   cameras.front() + "=" + file.filename().string());
}

/// @return  without a camera, if the file's names have none.
NamedVideo MatchVideo(const std::string& argument, const std::vector<std::string>& cameras,
                      const std::string& option) {
  const std::size_t sign = argument.find('=');
  if (sign != std::string::npos && !IsThere(argument)) {
    const std::string name = argument.substr(0, sign);
    if (std::ranges::find(cameras, name) == cameras.end())
      throw SetupError(option + Quoted(argument) + ": the calibration has no camera " +
                       Quoted(name) + "; " + ExpectedNames(name, cameras));
    return {name, argument.substr(sign + 1)};
  }
  const std::filesystem::path file = argument;
  for (const std::string& text : {file.stem().string(), file.parent_path().filename().string()}) {
    const std::vector<std::string> found = CamerasIn(text, cameras);
    if (found.size() > 1)
      FailToMatch(option, file, "has the names of " + ListedNames(found), cameras);
    if (found.size() == 1) return {found[0], file};
  }
  return {"", file};
}

void RequireOneEach(const std::vector<NamedVideo>& videos, const std::string& option) {
  for (std::size_t i = 0; i < videos.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (videos[i].camera == videos[j].camera)
        throw SetupError(option + videos[i].file.string() + ": " + videos[i].camera + " has " +
                         videos[j].file.string() + " already; expected one video of each camera");
    }
  }
}

}  // namespace

std::vector<NamedVideo> MatchVideos(std::span<const std::string> arguments,
                                    const std::vector<std::string>& cameras,
                                    const std::string& option, std::vector<std::string>& remarks) {
  const std::string prefix = option.empty() ? "" : option + " ";
  std::vector<NamedVideo> videos;
  for (const std::string& argument : arguments)
    videos.push_back(MatchVideo(argument, cameras, prefix));
  const auto is_nameless = [](const NamedVideo& video) { return video.camera.empty(); };
  const auto nameless = std::ranges::find_if(videos, is_nameless);
  if (nameless != videos.end()) {
    if (!std::ranges::all_of(videos, is_nameless) || videos.size() != cameras.size())
      FailToMatch(prefix, nameless->file, "has no camera's name", cameras);
    std::string decided;
    for (std::size_t i = 0; i < videos.size(); ++i) {
      videos[i].camera = cameras[i];
      decided += (i == 0 ? "" : ", ") + cameras[i] + "=" + videos[i].file.filename().string();
    }
    remarks.push_back(prefix +
                      "no file has a camera's name, so they are taken in their order: " + decided);
  }
  RequireOneEach(videos, prefix);
  std::ranges::stable_sort(videos, {}, [&](const NamedVideo& video) {
    return std::ranges::find(cameras, video.camera) - cameras.begin();
  });
  return videos;
}

}  // namespace mocap
