// A folder that lives as long as a test.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "core/errors.h"

namespace mocap::testing {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "mocap_XXXXXX").string();
    MOCAP_CHECK(mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string ReadText(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  MOCAP_CHECK(in);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void WriteText(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  MOCAP_CHECK(out);
}

/// Replaces the first `from`, which must be there.
inline void ReplaceInFile(const std::filesystem::path& file, const std::string& from,
                          const std::string& to) {
  std::string text = ReadText(file);
  const std::size_t place = text.find(from);
  MOCAP_CHECK(place != std::string::npos);
  WriteText(file, text.replace(place, from.size(), to));
}

/// Keeps the first part of a file, as a power failure does.
inline void CutFile(const std::filesystem::path& file, double share) {
  const std::string text = ReadText(file);
  WriteText(file,
            text.substr(0, static_cast<std::size_t>(share * static_cast<double>(text.size()))));
}

}  // namespace mocap::testing
