// The binary part of glTF files, and the JSON that says what lies where in it.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/geometry.h"
#include "tools/byte_writer.h"

namespace mocap {

/// Collects arrays of numbers, each with a view and an accessor of its own.
class GltfBuffer {
 public:
  /// What an array is used for, as glTF numbers it.
  enum Target { kNone = 0, kVertices = 34962, kIndices = 34963 };

  /// Adds floats, and their bounds, which glTF wants of positions and times.
  /// @param type  "SCALAR", "VEC3", "VEC4" or "MAT4".
  /// @return  the accessor's number.
  int AddFloats(std::span<const float> values, const char* type, Target target = kNone);
  int AddIndices(std::span<const std::uint16_t> values);
  /// Bytes, four an element.
  /// @param is_share  255 means 1.
  int AddBytes(std::span<const std::uint8_t> values, bool is_share);

  /// Puts `buffers`, `bufferViews` and `accessors` into a file's JSON and gives the whole file.
  std::string Glb(nlohmann::ordered_json file);

 private:
  template <typename Number>
  int Add(std::span<const Number> values, int component_type, const char* type, std::size_t width,
          Target target);

  ByteWriter bytes_;
  nlohmann::ordered_json views_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json accessors_ = nlohmann::ordered_json::array();
};

}  // namespace mocap
