// A reader of C3D files that shares nothing with the writer: made from the format's description,
// and proven on a file of Vicon's.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace mocap::testing {

struct C3dParameter {
  std::vector<int> dims;
  std::vector<double> numbers;
  std::vector<std::string> texts;  ///< Without trailing blanks.
};

struct C3dPoint {
  double x = 0, y = 0, z = 0;
  double residual = -1;  ///< [mm]; negative: not seen.
  int cameras = 0;
};

struct ReadC3d {
  int header_points = 0, header_first = 0, header_last = 0, header_data_block = 0;
  int header_analog_values = 0, header_analog_samples = 0;  ///< Per frame: of all channels, of one.
  float header_scale = 0, header_rate_hz = 0;
  std::map<std::string, C3dParameter> parameters;  ///< By "GROUP:NAME".
  std::vector<std::string> labels;
  std::vector<std::vector<C3dPoint>> frames;

  const C3dParameter& At(const std::string& name) const { return parameters.at(name); }
  double Number(const std::string& name, std::size_t i = 0) const { return At(name).numbers.at(i); }
  const C3dPoint& Point(std::size_t frame, const std::string& label) const {
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] == label) return frames.at(frame).at(i);
    }
    throw std::out_of_range(label);
  }
};

class C3dBytes {
 public:
  explicit C3dBytes(const std::string& bytes) : bytes_(bytes) {}
  template <typename T>
  T Get(std::size_t at) const {
    if (at + sizeof(T) > bytes_.size()) throw std::out_of_range("end of file");
    T value;
    std::memcpy(&value, bytes_.data() + at, sizeof(T));
    return value;
  }
  std::string Text(std::size_t at, std::size_t size) const { return bytes_.substr(at, size); }

 private:
  const std::string& bytes_;
};

inline C3dParameter ReadC3dParameter(const C3dBytes& bytes, std::size_t at) {
  C3dParameter parameter;
  const int type = bytes.Get<std::int8_t>(at);
  const int dim_count = bytes.Get<std::uint8_t>(at + 1);
  std::size_t count = 1;
  for (int i = 0; i < dim_count; ++i) {
    parameter.dims.push_back(bytes.Get<std::uint8_t>(at + 2 + i));
    count *= parameter.dims.back();
  }
  at += 2 + dim_count;
  if (type == -1) {
    const std::size_t width = dim_count > 0 ? parameter.dims[0] : 1;
    for (std::size_t i = 0; width > 0 && i < count / width; ++i) {
      std::string text = bytes.Text(at + i * width, width);
      parameter.texts.push_back(text.substr(0, text.find_last_not_of(' ') + 1));
    }
    return parameter;
  }
  for (std::size_t i = 0; i < count; ++i) {
    parameter.numbers.push_back(type == 4   ? bytes.Get<float>(at + 4 * i)
                                : type == 2 ? bytes.Get<std::uint16_t>(at + 2 * i)
                                            : bytes.Get<std::uint8_t>(at + i));
  }
  return parameter;
}

inline void ReadC3dParameters(const C3dBytes& bytes, ReadC3d& c3d) {
  std::size_t at = 512 * (bytes.Get<std::uint8_t>(0) - 1);
  if (bytes.Get<std::uint8_t>(at + 3) != 84) throw std::runtime_error("not of Intel's order");
  const std::size_t end = at + 512 * bytes.Get<std::uint8_t>(at + 2);
  std::map<int, std::string> groups;
  at += 4;
  while (at + 2 < end) {
    const int length = std::abs(bytes.Get<std::int8_t>(at));
    const int id = bytes.Get<std::int8_t>(at + 1);
    if (length == 0 || id == 0) break;
    const std::string name = bytes.Text(at + 2, length);
    const std::size_t rest = at + 2 + length;
    if (id < 0) groups[-id] = name;
    if (id > 0) c3d.parameters[groups.at(id) + ':' + name] = ReadC3dParameter(bytes, rest + 2);
    const int offset = bytes.Get<std::uint16_t>(rest);
    if (offset == 0) break;
    at = rest + offset;
  }
}

/// @throws std::exception  for what is no such file, or one that is cut off.
inline ReadC3d ReadC3dFile(const std::string& file) {
  const C3dBytes bytes(file);
  if (bytes.Get<std::uint8_t>(1) != 0x50) throw std::runtime_error("no C3D file");
  ReadC3d c3d;
  c3d.header_points = bytes.Get<std::uint16_t>(2);
  const std::size_t analog = bytes.Get<std::uint16_t>(4);
  c3d.header_first = bytes.Get<std::uint16_t>(6);
  c3d.header_last = bytes.Get<std::uint16_t>(8);
  const double scale = c3d.header_scale = bytes.Get<float>(12);
  if (scale >= 0) throw std::runtime_error("integers, floats are wanted");
  c3d.header_data_block = bytes.Get<std::uint16_t>(16);
  c3d.header_analog_values = static_cast<int>(analog);
  c3d.header_analog_samples = bytes.Get<std::uint16_t>(18);
  c3d.header_rate_hz = bytes.Get<float>(20);
  std::size_t at = 512 * (c3d.header_data_block - 1);
  ReadC3dParameters(bytes, c3d);
  for (int part = 1;; ++part) {
    const auto labels =
        c3d.parameters.find("POINT:LABELS" + (part == 1 ? "" : std::to_string(part)));
    if (labels == c3d.parameters.end()) break;
    c3d.labels.insert(c3d.labels.end(), labels->second.texts.begin(), labels->second.texts.end());
  }
  const auto field = [&](const char* name) {
    return static_cast<std::int64_t>(c3d.Number(name, 0) + 65536 * c3d.Number(name, 1));
  };
  const std::int64_t frames =
      field("TRIAL:ACTUAL_END_FIELD") - field("TRIAL:ACTUAL_START_FIELD") + 1;
  for (std::int64_t f = 0; f < frames; ++f) {
    std::vector<C3dPoint>& points = c3d.frames.emplace_back(c3d.header_points);
    for (C3dPoint& point : points) {
      const double quality = bytes.Get<float>(at + 12);
      point = {bytes.Get<float>(at), bytes.Get<float>(at + 4), bytes.Get<float>(at + 8)};
      if (quality >= 0) {
        const int word = static_cast<int>(quality);
        point.residual = (word & 0xff) * -scale;
        point.cameras = word >> 8;
      }
      at += 16;
    }
    at += 4 * analog;
  }
  return c3d;
}

}  // namespace mocap::testing
