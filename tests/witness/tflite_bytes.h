// A tiny network, written as a TFLite file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace mocap::testing {

/// Writes a FlatBuffer: what is referred to follows the reference.
class FlatBytes {
 public:
  using Place = std::size_t;

  /// A field of a table: a number of 1 or 4 bytes, or a reference, which is 0 until something is
  /// added for it.
  struct Field {
    int number;
    int bytes = 4;
    std::int32_t value = 0;
  };

  const std::string& bytes() const { return bytes_; }
  template <typename Number>
  Place Add(Number value) {
    const Place place = bytes_.size();
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
    return place;
  }
  void AddText(const std::string& text) { bytes_ += text; }

  /// @param from  the reference to it. @return  the places of its fields.
  std::vector<Place> AddTable(Place from, const std::vector<Field>& fields) {
    int most = -1;
    for (const Field& field : fields) most = std::max(most, field.number);
    std::vector<std::uint16_t> offsets(static_cast<std::size_t>(most) + 1, 0);
    auto length = static_cast<std::uint16_t>(sizeof(std::int32_t));
    for (const Field& field : fields) {
      offsets[static_cast<std::size_t>(field.number)] = length;
      length = static_cast<std::uint16_t>(length + field.bytes);
    }
    const Place list = Add(static_cast<std::uint16_t>(4 + 2 * offsets.size()));
    Add(length);
    for (const std::uint16_t offset : offsets) Add(offset);
    Refer(from);
    Add(static_cast<std::int32_t>(bytes_.size() - list));
    std::vector<Place> places;
    for (const Field& field : fields) {
      places.push_back(bytes_.size());
      bytes_.append(reinterpret_cast<const char*>(&field.value),
                    static_cast<std::size_t>(field.bytes));
    }
    return places;
  }
  /// Adds a list of references. @return  their places.
  std::vector<Place> AddList(Place from, int count) {
    Refer(from);
    Add(static_cast<std::uint32_t>(count));
    std::vector<Place> places;
    for (int i = 0; i < count; ++i) places.push_back(Add(std::uint32_t{0}));
    return places;
  }
  void AddIntegers(Place from, const std::vector<std::int32_t>& values) {
    Refer(from);
    Add(static_cast<std::uint32_t>(values.size()));
    for (const std::int32_t value : values) Add(value);
  }
  void AddFloats(Place from, std::span<const float> values) {
    Refer(from);
    Add(static_cast<std::uint32_t>(values.size_bytes()));
    for (const float value : values) Add(value);
  }

 private:
  void Refer(Place from) {
    const auto offset = static_cast<std::uint32_t>(bytes_.size() - from);
    std::memcpy(bytes_.data() + from, &offset, sizeof(offset));
  }

  std::string bytes_;
};

/// A convolution of an input of 32 x 32 by 3 x 3, each second pixel: how red the pixel in the
/// middle is, and how green. TFLite pads only at the right and below.
/// @param operation  3: CONV_2D; others are not known to the converter.
inline std::string ConvolutionAsTflite(int operation = 3) {
  FlatBytes file;
  const auto root = file.Add(std::uint32_t{0});
  file.AddText("TFL3");
  const auto model = file.AddTable(root, {{0, 4, 3}, {1}, {2}, {4}});
  const auto code = file.AddList(model[1], 1);
  file.AddTable(code[0], {{0, 1, operation}, {3, 4, operation}});
  const auto graphs = file.AddList(model[2], 1);
  const auto graph = file.AddTable(graphs[0], {{0}, {1}, {2}, {3}});
  const std::vector<std::vector<std::int32_t>> shapes = {
      {1, 32, 32, 3}, {2, 3, 3, 3}, {2}, {1, 16, 16, 2}};
  const auto tensors = file.AddList(graph[0], 4);
  for (int i = 0; i < 4; ++i) {
    // Buffer 0 is empty by TFLite's rules; those of weights and bias are 1 and 2.
    const int buffer = i == 1 || i == 2 ? i : 0;
    file.AddIntegers(file.AddTable(tensors[i], {{0}, {2, 4, buffer}})[0], shapes[i]);
  }
  file.AddIntegers(graph[1], {0});
  file.AddIntegers(graph[2], {3});
  const auto operators = file.AddList(graph[3], 1);
  const auto convolution = file.AddTable(operators[0], {{0, 4, 0}, {1}, {2}, {3, 1, 1}, {4}});
  file.AddIntegers(convolution[1], {0, 1, 2});
  file.AddIntegers(convolution[2], {3});
  file.AddTable(convolution[4], {{0, 1, 0}, {1, 4, 2}, {2, 4, 2}, {3, 1, 1}});
  const auto buffers = file.AddList(model[3], 3);
  file.AddTable(buffers[0], {{1, 1, 0}});
  std::vector<float> weights(2 * 3 * 3 * 3, 0);
  const auto at = [](int map, int y, int x, int color) {
    return ((map * 3 + y) * 3 + x) * 3 + color;
  };
  weights[at(0, 1, 1, 0)] = weights[at(1, 1, 1, 1)] = 1;
  file.AddFloats(file.AddTable(buffers[1], {{0}})[0], weights);
  file.AddFloats(file.AddTable(buffers[2], {{0}})[0], std::vector<float>{-0.25, -0.25});
  return file.bytes();
}

}  // namespace mocap::testing
