// Numbers as bytes, little-endian.
#pragma once

#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

namespace mocap {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie");

/// Appends numbers.
class ByteWriter {
 public:
  template <typename T>
  void Add(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    bytes_.append(bytes, sizeof(T));
  }
  template <typename Vector>
  void AddFloats(const Vector& vector) {
    for (const double value : vector) Add(static_cast<float>(value));
  }
  void AddText(std::string_view text) { bytes_ += text; }
  /// Pads to a multiple of a size.
  void PadTo(std::size_t multiple, char filling = 0) {
    bytes_.append((multiple - bytes_.size() % multiple) % multiple, filling);
  }
  std::size_t size() const { return bytes_.size(); }
  std::string Take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

}  // namespace mocap
