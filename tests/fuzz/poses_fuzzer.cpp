#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/errors.h"
#include "tools/results/result.h"

namespace {

/// A folder of one run, in which poses.csv is written anew for each input.
class ResultFolder {
 public:
  ResultFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "fuzz_poses_XXXXXX").string();
    path_ = mkdtemp(name.data());
    mocap::Result result;
    for (const char* joint : {"neck_x", "wrist_l_x"}) result.body.joints.push_back({joint});
    mocap::WriteResult(path_, result);
  }
  ~ResultFolder() { std::filesystem::remove_all(path_); }
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  const std::filesystem::path& Hold(const std::uint8_t* data, std::size_t size) const {
    std::ofstream out(path_ / "poses.csv", std::ios::binary);
    out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return path_;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const ResultFolder folder;
  try {
    mocap::ReadResult(folder.Hold(data, size));
  } catch (const mocap::SetupError&) {
    // The one way to say that a result is wrong.
  }
  return 0;
}
