#include "tools/interchange/c3d_parameters.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "core/errors.h"

namespace mocap {
namespace {

/// Largest dimension of an array.
constexpr std::size_t kMost = 255;
constexpr std::uint8_t kKey = 0x50;
constexpr std::uint8_t kIntel = 84;

std::size_t WidthOf(std::span<const std::string> texts) {
  std::size_t width = 1;
  for (const std::string& text : texts) width = std::max(width, text.size());
  return std::min(width, kMost);
}

}  // namespace

void C3dParameters::Group(std::string_view name) {
  ++group_;
  records_.Add(static_cast<std::int8_t>(name.size()));
  records_.Add(static_cast<std::int8_t>(-group_));
  records_.AddText(name);
  records_.Add(std::int16_t{3});  // Offset to the next record, from here.
  records_.Add(std::int8_t{0});   // No description.
}

void C3dParameters::Begin(std::string_view name, Type type, std::span<const std::size_t> dims,
                          std::size_t value_bytes) {
  records_.Add(static_cast<std::int8_t>(name.size()));
  records_.Add(group_);
  records_.AddText(name);
  records_.Add(static_cast<std::uint16_t>(2 + 1 + 1 + dims.size() + value_bytes + 1));
  records_.Add(static_cast<std::int8_t>(type));
  records_.Add(static_cast<std::uint8_t>(dims.size()));
  for (const std::size_t dim : dims) {
    MOCAP_CHECK(dim <= kMost);
    records_.Add(static_cast<std::uint8_t>(dim));
  }
}

void C3dParameters::Integer(std::string_view name, int value) { Integers(name, {&value, 1}, {}); }

void C3dParameters::Integers(std::string_view name, std::span<const int> values,
                             std::initializer_list<std::size_t> dims) {
  Begin(name, kInteger, dims, 2 * values.size());
  for (const int value : values) records_.Add(static_cast<std::uint16_t>(value));
  records_.Add(std::int8_t{0});
}

void C3dParameters::Real(std::string_view name, double value) { Reals(name, {&value, 1}, {}); }

void C3dParameters::Reals(std::string_view name, std::span<const double> values,
                          std::initializer_list<std::size_t> dims) {
  Begin(name, kReal, dims, 4 * values.size());
  records_.AddFloats(values);
  records_.Add(std::int8_t{0});
}

void C3dParameters::AddPadded(std::span<const std::string> texts, std::size_t width) {
  for (const std::string& text : texts) {
    std::string padded = text;
    padded.resize(width, ' ');
    records_.AddText(padded);
  }
  records_.Add(std::int8_t{0});
}

void C3dParameters::Text(std::string_view name, std::string_view text) {
  const std::string one(text.substr(0, kMost));
  const std::size_t dims[] = {one.size()};
  Begin(name, kText, dims, one.size());
  AddPadded({&one, 1}, one.size());
}

void C3dParameters::Texts(const std::string& name, std::span<const std::string> texts) {
  const std::size_t width = WidthOf(texts);
  for (std::size_t first = 0, part = 1; first == 0 || first < texts.size();
       first += kMost, ++part) {
    const auto some = texts.subspan(first, std::min(kMost, texts.size() - first));
    const std::size_t dims[] = {width, some.size()};
    Begin(part == 1 ? name : name + std::to_string(part), kText, dims, width * some.size());
    AddPadded(some, width);
  }
}

void C3dParameters::TextPairs(std::string_view name, std::span<const std::string> texts) {
  const std::size_t width = WidthOf(texts);
  const std::size_t dims[] = {width, 2, texts.size() / 2};
  Begin(name, kText, dims, width * texts.size());
  AddPadded(texts, width);
}

std::string C3dParameters::Section() {
  const std::string records = records_.Take();
  const std::size_t blocks = (4 + records.size() + 2 + kC3dBlock - 1) / kC3dBlock;
  if (blocks > kMost) {
    throw SetupError("names of so many people take " + std::to_string(blocks) +
                     " blocks; C3D holds " + std::to_string(kMost));
  }
  ByteWriter section;
  section.Add(std::uint8_t{1});
  section.Add(kKey);
  section.Add(static_cast<std::uint8_t>(blocks));
  section.Add(kIntel);
  section.AddText(records);
  // A record without a name ends the section; the padding is zero anyway.
  section.Add(std::uint16_t{0});
  section.PadTo(kC3dBlock);
  return section.Take();
}

}  // namespace mocap
