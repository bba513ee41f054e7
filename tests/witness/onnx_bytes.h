// Tiny networks, written as ONNX files.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mocap::testing {

/// Writes what tests need of the protobuf messages of ONNX, with the field numbers of onnx.proto.
class OnnxGraph {
 public:
  using Shape = std::vector<std::int64_t>;

  void AddInput(const std::string& name, const Shape& shape) { AddValue(11, name, shape); }
  void AddOutput(const std::string& name, const Shape& shape) { AddValue(12, name, shape); }
  void AddConstant(const std::string& name, const Shape& shape, std::span<const float> values) {
    constexpr int kFloat = 1;
    AddTensor(name, shape, kFloat, values.data(), values.size_bytes());
  }
  void AddConstant(const std::string& name, std::span<const std::int64_t> values) {
    constexpr int kInt64 = 7;
    AddTensor(name, {static_cast<std::int64_t>(values.size())}, kInt64, values.data(),
              values.size_bytes());
  }
  /// @param integers  attributes that are lists of integers.
  void AddNode(const std::string& operation, const std::vector<std::string>& inputs,
               const std::string& output,
               const std::vector<std::pair<std::string, Shape>>& integers = {}) {
    std::string node;
    for (const std::string& input : inputs) node += Bytes(1, input);
    node += Bytes(2, output) + Bytes(3, output) + Bytes(4, operation);
    for (const auto& [name, values] : integers) {
      constexpr int kIntegers = 7;
      std::string attribute = Bytes(1, name);
      for (const std::int64_t value : values) attribute += Number(8, value);
      node += Bytes(5, attribute + Number(20, kIntegers));
    }
    graph_ += Bytes(1, node);
  }

  /// The whole file.
  std::string Model() const {
    constexpr int kIrVersion = 7, kOperators = 11;
    return Number(1, kIrVersion) + Bytes(7, graph_ + Bytes(2, "test")) +
           Bytes(8, Bytes(1, "") + Number(2, kOperators));
  }

 private:
  static std::string Varint(std::uint64_t value) {
    std::string bytes;
    for (; value > 0x7f; value >>= 7) bytes += static_cast<char>(value | 0x80);
    return bytes + static_cast<char>(value);
  }
  static std::string Number(int field, std::int64_t value) {
    return Varint(static_cast<std::uint64_t>(field) << 3) +
           Varint(static_cast<std::uint64_t>(value));
  }
  static std::string Bytes(int field, const std::string& bytes) {
    return Varint(static_cast<std::uint64_t>(field) << 3 | 2) + Varint(bytes.size()) + bytes;
  }

  void AddValue(int field, const std::string& name, const Shape& shape) {
    constexpr int kFloat = 1;
    std::string sizes;
    for (const std::int64_t size : shape) sizes += Bytes(1, Number(1, size));
    graph_ +=
        Bytes(field, Bytes(1, name) + Bytes(2, Bytes(1, Number(1, kFloat) + Bytes(2, sizes))));
  }
  void AddTensor(const std::string& name, const Shape& shape, int type, const void* values,
                 std::size_t bytes) {
    std::string tensor;
    for (const std::int64_t size : shape) tensor += Number(1, size);
    tensor += Number(2, type) + Bytes(8, name);
    graph_ += Bytes(5, tensor + Bytes(9, std::string(static_cast<const char*>(values), bytes)));
  }

  std::string graph_;
};

/// Maps of how red and how green each pixel is, of an input of 32 x 32.
inline std::string ColorMapNetwork() {
  OnnxGraph graph;
  const std::vector<float> weights = {1, -1, -1, -1, 1, -1};
  graph.AddInput("picture", {1, 3, 32, 32});
  graph.AddConstant("weights", {2, 3, 1, 1}, weights);
  graph.AddNode("Conv", {"picture", "weights"}, "maps", {{"kernel_shape", {1, 1}}});
  graph.AddOutput("maps", {1, 2, 32, 32});
  return graph.Model();
}

/// Its description: red is the nose, green the neck, which no self-test knows.
inline constexpr const char* kColorMapDescription = R"(width_px = 32
height_px = 32
colors = "rgb"
mean = [0, 0, 0]
std = [255, 255, 255]
kind = "heatmaps"
outputs = ["maps"]
landmarks = ["nose", "neck"]
score = "probability"
)";

/// An RTMPose whose answers are the same for all pictures: point i is at bins (8 i, 4 i).
inline std::string StillRtmPose(int points) {
  constexpr int kColumns = 384, kRows = 512;
  OnnxGraph graph;
  graph.AddInput("input", {1, 3, 256, 192});
  graph.AddNode("GlobalAveragePool", {"input"}, "mean");
  const auto add = [&](const std::string& name, int bins, int step) {
    std::vector<float> nothing(static_cast<std::size_t>(3) * points * bins, 0);
    std::vector<float> peaks(static_cast<std::size_t>(points) * bins, 0);
    for (int i = 0; i < points; ++i) peaks[i * bins + step * i % bins] = 0.5;
    graph.AddConstant(name + "_w", {points * bins, 3, 1, 1}, nothing);
    graph.AddConstant(name + "_b", {points * bins}, peaks);
    graph.AddNode("Conv", {"mean", name + "_w", name + "_b"}, name + "_flat",
                  {{"kernel_shape", {1, 1}}});
    graph.AddConstant(name + "_s", std::vector<std::int64_t>{1, points, bins});
    graph.AddNode("Reshape", {name + "_flat", name + "_s"}, name);
    graph.AddOutput(name, {1, points, bins});
  };
  add("simcc_x", kColumns, 8);
  add("simcc_y", kRows, 4);
  return graph.Model();
}

}  // namespace mocap::testing
