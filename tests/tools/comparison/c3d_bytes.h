// C3D files of three processors, as their makers would write them.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/geometry.h"

namespace mocap::testing {

enum class C3dMaker { kIntel = 84, kDec = 85, kMips = 86 };

class C3dMaking {
 public:
  C3dMaking(C3dMaker maker, double scale) : maker_(maker), scale_(scale) {}

  /// @param frames  places by frame and label; NaN: not seen.
  std::string File(const std::vector<std::string>& labels,
                   const std::vector<std::vector<Vector3>>& frames, double rate_hz,
                   const std::string& units) const {
    std::string section = std::string("\x01\x50", 2) + char(1) + char(maker_);
    section += Group("POINT") + Record("UNITS", -1, {units.size()}, units);
    std::string texts;
    for (const std::string& label : labels) texts += label + std::string(8 - label.size(), ' ');
    section += Record("LABELS", -1, {8, labels.size()}, texts) + std::string(2, '\0');
    section.resize(512);
    std::string header = std::string("\x02\x50", 2) + Word(labels.size()) + Word(0) + Word(1) +
                         Word(frames.size()) + Word(0) + Real(scale_) + Word(3) + Word(0) +
                         Real(rate_hz);
    header.resize(512);
    std::string data;
    for (const auto& places : frames)
      for (const Vector3& place : places) data += Place(place);
    return header + section + data;
  }

 private:
  std::string Word(std::size_t value) const {
    const char low = static_cast<char>(value & 0xff), high = static_cast<char>(value >> 8 & 0xff);
    return maker_ == C3dMaker::kMips ? std::string{high, low} : std::string{low, high};
  }
  std::string Real(double number) const {
    // DEC's exponents count from another zero.
    const auto value = static_cast<float>(maker_ == C3dMaker::kDec ? 4 * number : number);
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof(bits));
    const std::string high = Word(bits >> 16), low = Word(bits & 0xffff);
    return maker_ == C3dMaker::kIntel ? low + high : high + low;
  }
  std::string Place(const Vector3& place) const {
    const bool is_seen = place.allFinite();
    std::string data;
    for (const double mm : is_seen ? place : Vector3(Vector3::Zero()))
      data += scale_ < 0 ? Real(mm)
                         : Word(static_cast<std::uint16_t>(
                               static_cast<std::int16_t>(std::lround(mm / scale_))));
    return data + (scale_ < 0 ? Real(is_seen ? 0 : -1) : Word(is_seen ? 0 : 0xffff));
  }
  std::string Group(const std::string& name) const {
    return char(name.size()) + std::string(1, char(-1)) + name + Word(3) + char(0);
  }
  std::string Record(const std::string& name, int type, const std::vector<std::size_t>& dims,
                     const std::string& values) const {
    std::string body = std::string(1, char(type)) + char(dims.size());
    for (const std::size_t dim : dims) body += char(dim);
    body += values + char(0);
    return char(name.size()) + std::string(1, char(1)) + name + Word(body.size() + 2) + body;
  }

  C3dMaker maker_;
  double scale_;
};

}  // namespace mocap::testing
