// Numbers in what the page receives.
#pragma once

#include <cstddef>
#include <cstring>
#include <string>

namespace mocap::testing {

/// Reads the number that begins at a byte.
template <typename T>
T NumberAt(const std::string& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

}  // namespace mocap::testing
