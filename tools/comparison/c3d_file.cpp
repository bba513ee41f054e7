#include "tools/comparison/c3d_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/errors.h"
#include "drivers/printable_text.h"
#include "tools/comparison/recorded_motion.h"

namespace mocap {
namespace {

constexpr std::size_t kBlock = 512;

std::string Capitals(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return capitals;
}

std::string WithoutBlanks(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\0' || c == '\t'; };
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  return std::string(text);
}

/// What the header block tells.
struct Header {
  std::size_t points = 0, analog_values = 0;  ///< Per frame.
  std::int64_t first_frame = 0, last_frame = 0;
  double scale = 0;  ///< Negative: the points are floats.
  std::size_t data_block = 0;
  double rate_hz = 0;
};

Header ReadHeader(const C3dBytes& bytes) {
  Header header;
  header.points = bytes.Word(2);
  header.analog_values = bytes.Word(4);
  header.first_frame = bytes.Word(6);
  header.last_frame = bytes.Word(8);
  header.scale = bytes.Real(12);
  header.data_block = bytes.Word(16);
  header.rate_hz = bytes.Real(20);
  return header;
}

/// Reads a parameter's values; what lies beyond the file is left out.
C3dParameter ReadParameter(const C3dBytes& bytes, std::size_t at) {
  C3dParameter parameter;
  if (!bytes.Has(at, 2)) return parameter;
  const int type = static_cast<std::int8_t>(bytes.Byte(at));
  const std::size_t dims = bytes.Byte(at + 1);
  if (dims > 7 || !bytes.Has(at + 2, dims)) return parameter;
  const std::size_t first = dims > 0 ? bytes.Byte(at + 2) : 1;
  std::size_t count = 1;
  for (std::size_t i = 0; i < dims; ++i)
    count = std::min(count * bytes.Byte(at + 2 + i), bytes.size());
  at += 2 + dims;
  if (type == -1) {
    for (std::size_t i = 0; first > 0 && i < count / first; ++i) {
      if (!bytes.Has(at + i * first, first)) break;
      parameter.texts.push_back(WithoutBlanks(bytes.Text(at + i * first, first)));
    }
    return parameter;
  }
  const std::size_t width = type == 4 ? 4 : type == 2 ? 2 : 1;
  for (std::size_t i = 0; i < count && bytes.Has(at + i * width, width); ++i) {
    parameter.numbers.push_back(type == 4   ? bytes.Real(at + 4 * i)
                                : type == 2 ? bytes.Word(at + 2 * i)
                                            : bytes.Byte(at + i));
  }
  return parameter;
}

/// Walks the records of the parameter section. Each leads farther into the file, so this ends.
std::map<std::string, C3dParameter> ReadParameters(const C3dBytes& bytes, std::size_t begin) {
  struct Found {
    int group;
    std::string name;
    std::size_t at;
  };
  std::map<int, std::string> groups;
  std::vector<Found> found;
  for (std::size_t at = begin + 4; bytes.Has(at, 2);) {
    const auto length =
        static_cast<std::size_t>(std::abs(static_cast<std::int8_t>(bytes.Byte(at))));
    const int id = static_cast<std::int8_t>(bytes.Byte(at + 1));
    if (length == 0 || id == 0 || !bytes.Has(at + 2, length + 2)) break;
    const std::string name = Capitals(WithoutBlanks(bytes.Text(at + 2, length)));
    const std::size_t rest = at + 2 + length;
    if (id < 0) groups[-id] = name;
    if (id > 0) found.push_back({id, name, rest + 2});
    const std::size_t offset = bytes.Word(rest);
    if (offset < 2) break;
    at = rest + offset;
  }
  std::map<std::string, C3dParameter> parameters;
  for (const Found& one : found)
    parameters[groups[one.group] + ':' + one.name] = ReadParameter(bytes, one.at);
  return parameters;
}

double NumberIn(const C3dFile& file, const std::string& name, std::size_t i = 0) {
  const auto parameter = file.parameters.find(name);
  if (parameter == file.parameters.end() || parameter->second.numbers.size() <= i) return 0;
  return parameter->second.numbers[i];
}

/// Longer recordings than 16 bits can count have their length in further places.
std::int64_t FramesOf(const C3dFile& file, const Header& header) {
  const auto field = [&](const std::string& name) {
    return NumberIn(file, name, 0) + 65536 * NumberIn(file, name, 1);
  };
  const double by_trial = field("TRIAL:ACTUAL_END_FIELD") - field("TRIAL:ACTUAL_START_FIELD") + 1;
  const double by_long = NumberIn(file, "POINT:LONG_FRAMES");
  const auto by_header = static_cast<double>(header.last_frame - header.first_frame + 1);
  double frames = std::max({by_header, by_trial > 1 ? by_trial : 0, by_long});
  if (!std::isfinite(frames) || frames > 1e9) frames = by_header;
  return static_cast<std::int64_t>(std::max(0.0, frames));
}

Vector3 ReadFloatPoint(const C3dBytes& bytes, std::size_t at) {
  if (bytes.Real(at + 12) < 0) return Unseen();
  return {bytes.Real(at), bytes.Real(at + 4), bytes.Real(at + 8)};
}

Vector3 ReadIntegerPoint(const C3dBytes& bytes, std::size_t at, double scale) {
  const auto number = [&](std::size_t i) {
    return static_cast<double>(static_cast<std::int16_t>(bytes.Word(at + 2 * i)));
  };
  if (number(3) < 0) return Unseen();
  return scale * Vector3(number(0), number(1), number(2));
}

/// Coordinates that are all 0 are those of points that were not seen, in files of programs that
/// set no residual.
Vector3 SeenOrNot(const Vector3& p) {
  constexpr double kLargest = 1e9;
  const bool is_seen = p.allFinite() && !p.isZero(0) && p.cwiseAbs().maxCoeff() < kLargest;
  return is_seen ? p : Unseen();
}

void ReadPoints(const C3dBytes& bytes, const Header& header, C3dFile& file) {
  const bool is_float = header.scale < 0;
  const std::size_t number = is_float ? 4 : 2;
  const std::size_t frame_size = number * (4 * header.points + header.analog_values);
  const std::size_t begin = kBlock * (header.data_block - 1);
  const std::size_t there = begin < bytes.size() ? (bytes.size() - begin) / frame_size : 0;
  const std::size_t frames =
      std::min(there, static_cast<std::size_t>(std::max<std::int64_t>(0, file.declared_frames)));
  file.points.assign(header.points, std::vector<Vector3>(frames));
  for (std::size_t f = 0; f < frames; ++f) {
    std::size_t at = begin + f * frame_size;
    for (std::size_t i = 0; i < header.points; ++i, at += 4 * number)
      file.points[i][f] = SeenOrNot(is_float ? ReadFloatPoint(bytes, at)
                                             : ReadIntegerPoint(bytes, at, header.scale));
  }
}

C3dBytes::Processor ProcessorOf(std::string_view bytes, std::size_t parameters,
                                const std::string& name) {
  const int number = static_cast<std::uint8_t>(bytes[parameters + 3]);
  if (number >= C3dBytes::kIntel && number <= C3dBytes::kMips)
    return static_cast<C3dBytes::Processor>(number);
  throw SetupError(name + ": has the processor number " + std::to_string(number) +
                   "; expected 84 (Intel), 85 (DEC) or 86 (MIPS)");
}

}  // namespace

std::uint16_t C3dBytes::Word(std::size_t at) const {
  const unsigned a = Byte(at), b = Byte(at + 1);
  return static_cast<std::uint16_t>(processor_ == kMips ? a << 8 | b : b << 8 | a);
}

double C3dBytes::Real(std::size_t at) const {
  const std::uint32_t low = Word(at), high = Word(at + 2);
  // MIPS has the high word first, and so has DEC, whose exponents are larger by 2.
  const std::uint32_t bits = processor_ == kIntel ? high << 16 | low : low << 16 | high;
  float value = 0;
  std::memcpy(&value, &bits, sizeof(value));
  return processor_ == kDec ? value / 4.0 : value;
}

std::vector<std::string> C3dFile::Texts(const std::string& name) const {
  std::vector<std::string> texts;
  for (int part = 1;; ++part) {
    const auto parameter = parameters.find(part == 1 ? name : name + std::to_string(part));
    if (parameter == parameters.end()) return texts;
    texts.insert(texts.end(), parameter->second.texts.begin(), parameter->second.texts.end());
  }
}

C3dFile ParseC3d(std::string_view bytes, const std::string& name) {
  if (bytes.size() < 2 * kBlock || bytes[1] != 0x50 || bytes[0] == 0)
    throw SetupError(name + ": is no C3D file");
  const std::size_t parameters = kBlock * (static_cast<std::uint8_t>(bytes[0]) - 1u);
  if (parameters + 4 > bytes.size())
    throw SetupError(name + ": ends before its parameters; expected a whole C3D file");
  const C3dBytes numbers(bytes, ProcessorOf(bytes, parameters, name));
  const Header header = ReadHeader(numbers);
  C3dFile file;
  file.parameters = ReadParameters(numbers, parameters);
  file.rate_hz = header.rate_hz > 0 ? header.rate_hz : NumberIn(file, "POINT:RATE");
  file.declared_frames = FramesOf(file, header);
  if (header.points == 0) throw SetupError(name + ": has no points; expected markers or angles");
  if (!(file.rate_hz > 0) || !(file.rate_hz < 1e6))
    throw SetupError(name + ": has no frame rate; expected POINT:RATE above 0");
  if (header.data_block == 0 || header.scale == 0 || !std::isfinite(header.scale))
    throw SetupError(name + ": has no place or scale of its points in the header");
  ReadPoints(numbers, header, file);
  file.labels = file.Texts("POINT:LABELS");
  file.labels.resize(header.points);
  for (std::size_t i = 0; i < file.labels.size(); ++i)
    if (file.labels[i].empty()) file.labels[i] = "point " + std::to_string(i + 1);
  return file;
}

}  // namespace mocap
