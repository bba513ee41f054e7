// The parameter section of C3D files: groups of named values.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/byte_writer.h"

namespace mocap {

/// Block size of C3D files.
inline constexpr std::size_t kC3dBlock = 512;

/// Writes groups and their parameters in sequence, little-endian.
class C3dParameters {
 public:
  /// Begins a group for the following parameters.
  void Group(std::string_view name);

  void Integer(std::string_view name, int value);
  /// Adds numbers of 16 bits; those above 32,767 are to be read as unsigned.
  /// @param dims  of the array, the fastest first, at most 255 each; their product is the count.
  void Integers(std::string_view name, std::span<const int> values,
                std::initializer_list<std::size_t> dims);
  void Real(std::string_view name, double value);
  void Reals(std::string_view name, std::span<const double> values,
             std::initializer_list<std::size_t> dims);
  void Text(std::string_view name, std::string_view text);
  /// Adds texts of equal width; more than 255 continue in NAME2 and so on.
  void Texts(const std::string& name, std::span<const std::string> texts);
  /// Adds pairs of texts: an array of width × 2 × pairs.
  void TextPairs(std::string_view name, std::span<const std::string> texts);

  /// Returns the section, padded to whole blocks.
  /// @throws SetupError  for more than 255 blocks, the limit of C3D.
  std::string Section();

 private:
  enum Type : std::int8_t { kText = -1, kInteger = 2, kReal = 4 };
  void Begin(std::string_view name, Type type, std::span<const std::size_t> dims,
             std::size_t value_bytes);
  void AddPadded(std::span<const std::string> texts, std::size_t width);

  ByteWriter records_;
  std::int8_t group_ = 0;
};

}  // namespace mocap
