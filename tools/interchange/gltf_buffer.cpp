#include "tools/interchange/gltf_buffer.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "core/errors.h"

namespace mocap {
namespace {

using Json = nlohmann::ordered_json;

// Constants of glTF and GLB.
constexpr int kByte = 5121, kShort = 5123, kFloat = 5126;
constexpr std::uint32_t kMagic = 0x46546c67, kVersion = 2, kJsonChunk = 0x4e4f534a,
                        kBinaryChunk = 0x004e4942;

std::size_t WidthOf(std::string_view type) {
  return type == "MAT4" ? 16 : type == "VEC4" ? 4 : type == "VEC3" ? 3 : 1;
}

}  // namespace

template <typename Number>
int GltfBuffer::Add(std::span<const Number> values, int component_type, const char* type,
                    std::size_t width, Target target) {
  bytes_.PadTo(4);
  Json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size_bytes()}};
  if (target != kNone) view["target"] = static_cast<int>(target);
  for (const Number value : values) bytes_.Add(value);
  accessors_.push_back({{"bufferView", views_.size()},
                        {"componentType", component_type},
                        {"count", values.size() / width},
                        {"type", type}});
  views_.push_back(std::move(view));
  return static_cast<int>(accessors_.size()) - 1;
}

int GltfBuffer::AddFloats(std::span<const float> values, const char* type, Target target) {
  const std::size_t width = WidthOf(type);
  MOCAP_CHECK(values.size() >= width);
  const int accessor = Add(values, kFloat, type, width, target);
  std::vector<float> least(values.begin(), values.begin() + width), most = least;
  for (std::size_t i = 0; i < values.size(); ++i) {
    least[i % width] = std::min(least[i % width], values[i]);
    most[i % width] = std::max(most[i % width], values[i]);
  }
  accessors_.back()["min"] = least;
  accessors_.back()["max"] = most;
  return accessor;
}

int GltfBuffer::AddIndices(std::span<const std::uint16_t> values) {
  return Add(values, kShort, "SCALAR", 1, kIndices);
}

int GltfBuffer::AddBytes(std::span<const std::uint8_t> values, bool is_share) {
  const int accessor = Add(values, kByte, "VEC4", 4, kVertices);
  if (is_share) accessors_.back()["normalized"] = true;
  return accessor;
}

std::string GltfBuffer::Glb(Json file) {
  bytes_.PadTo(4);
  const std::string binary = bytes_.Take();
  file["buffers"] = Json::array({{{"byteLength", binary.size()}}});
  file["bufferViews"] = std::move(views_);
  file["accessors"] = std::move(accessors_);
  // Bytes in names that are not UTF-8 are replaced.
  std::string json = file.dump(-1, ' ', false, Json::error_handler_t::replace);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  ByteWriter glb;
  const auto add = [&](std::size_t number) { glb.Add(static_cast<std::uint32_t>(number)); };
  add(kMagic);
  add(kVersion);
  add(12 + 8 + json.size() + 8 + binary.size());
  add(json.size());
  add(kJsonChunk);
  glb.AddText(json);
  add(binary.size());
  add(kBinaryChunk);
  glb.AddText(binary);
  return glb.Take();
}

}  // namespace mocap
