// Reads C3D files of any maker and processor.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry.h"

namespace mocap {

/// Numbers of a file of Intel's, DEC's or MIPS' order.
class C3dBytes {
 public:
  enum Processor { kIntel = 84, kDec = 85, kMips = 86 };

  C3dBytes() = default;
  /// @param bytes  not owned.
  C3dBytes(std::string_view bytes, Processor processor) : bytes_(bytes), processor_(processor) {}

  /// Whether so many bytes are there.
  bool Has(std::size_t at, std::size_t size) const {
    return at <= bytes_.size() && size <= bytes_.size() - at;
  }
  /// @pre  Has(at, size).
  std::uint8_t Byte(std::size_t at) const { return static_cast<std::uint8_t>(bytes_[at]); }
  std::uint16_t Word(std::size_t at) const;
  double Real(std::size_t at) const;
  std::string_view Text(std::size_t at, std::size_t size) const { return bytes_.substr(at, size); }
  std::size_t size() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
  Processor processor_ = kIntel;
};

/// A parameter: an array of numbers or of texts.
struct C3dParameter {
  std::vector<double> numbers;
  std::vector<std::string> texts;  ///< Without blanks at their ends.
};

/// The points of a file.
struct C3dFile {
  std::map<std::string, C3dParameter> parameters;  ///< By "GROUP:NAME", in capitals.
  std::vector<std::string> labels;                 ///< One per point.
  double rate_hz = 0;
  std::int64_t declared_frames = 0;
  /// Of each point, by frame, in the file's unit; NaN: not seen.
  std::vector<std::vector<Vector3>> points;

  /// Texts of NAME, NAME2, NAME3 and so on.
  std::vector<std::string> Texts(const std::string& name) const;
};

/// Parses a file's bytes. Points may be integers or floats; analog data are skipped.
/// @param name  for messages.
/// @throws SetupError  for what is no C3D file, and for a header that contradicts itself.
C3dFile ParseC3d(std::string_view bytes, const std::string& name);

}  // namespace mocap
