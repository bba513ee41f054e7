// A checksum of text.
#pragma once

#include <cstdint>
#include <string_view>

namespace mocap {

/// Computes the FNV-1a of bytes: detects changes, not forgery.
inline std::uint64_t Fnv1a(std::string_view bytes) {
  std::uint64_t sum = 0xcbf29ce484222325;
  for (const char byte : bytes) sum = (sum ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  return sum;
}

}  // namespace mocap
