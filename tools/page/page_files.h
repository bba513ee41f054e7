// The page of mocap view, embedded into the program by the build.
#pragma once

#include <span>
#include <string_view>

namespace mocap {

struct BuiltinPageFile {
  std::string_view name;
  std::string_view text;
};

std::span<const BuiltinPageFile> BuiltinPageFiles();

}  // namespace mocap
