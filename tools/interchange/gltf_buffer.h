// Binary part of glTF files, with the JSON that describes it.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/geometry.h"
#include "tools/byte_writer.h"

namespace mocap {

/// Collects arrays of numbers, each with its own view and accessor.
class GltfBuffer {
 public:
  /// Use of an array, by glTF's numbers.
  enum Target { kNone = 0, kVertices = 34962, kIndices = 34963 };

  /// Adds floats with their bounds, which glTF requires for positions and times.
  /// @param type  "SCALAR", "VEC3", "VEC4" or "MAT4".
  /// @return  the accessor's index.
  int AddFloats(std::span<const float> values, const char* type, Target target = kNone);
  int AddIndices(std::span<const std::uint16_t> values);
  /// Adds bytes, four per element.
  /// @param is_share  255 means 1.
  int AddBytes(std::span<const std::uint8_t> values, bool is_share);

  /// Adds `buffers`, `bufferViews` and `accessors` to a file's JSON; returns the whole file.
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
