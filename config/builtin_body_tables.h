// The body tables of config/body, compiled into the library.
#pragma once

#include <span>
#include <string_view>

namespace mocap {

struct BuiltinBodyTable {
  std::string_view name;
  std::string_view toml;
};

std::span<const BuiltinBodyTable> BuiltinBodyTables();

}  // namespace mocap
