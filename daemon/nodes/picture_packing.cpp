#include "daemon/nodes/picture_packing.h"

#include <algorithm>
#include <bit>
#include <optional>

namespace mocap {
namespace {

constexpr int kTile_px = Shading::kTile_px;
constexpr int kWordBits = 64;

int TilesAlong(int pixels) { return (pixels + kTile_px - 1) / kTile_px; }

/// Appends numbers of any size, seven bits per byte.
class Writer {
 public:
  explicit Writer(std::vector<std::uint8_t>& bytes) : bytes_(bytes) { bytes_.clear(); }

  void Number(std::uint32_t number) {
    for (; number >= 0x80; number >>= 7) bytes_.push_back(static_cast<std::uint8_t>(number | 0x80));
    bytes_.push_back(static_cast<std::uint8_t>(number));
  }
  void Number(int number) { Number(static_cast<std::uint32_t>(number)); }
  void Shade(std::int8_t shade) { bytes_.push_back(static_cast<std::uint8_t>(shade)); }

 private:
  std::vector<std::uint8_t>& bytes_;
};

/// Reads the output of Writer. After the first invalid number, all are 0.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// A number from 0 to `most`.
  int Number(int most) {
    std::uint32_t number = 0;
    for (int shift = 0; shift < 28; shift += 7) {
      const std::uint8_t byte = Byte();
      number |= static_cast<std::uint32_t>(byte & 0x7f) << shift;
      if (byte < 0x80) return number <= static_cast<std::uint32_t>(most) ? int(number) : Fail();
    }
    return Fail();
  }
  std::int8_t Shade() { return static_cast<std::int8_t>(Byte()); }
  int Fail() {
    is_sound_ = false;
    return 0;
  }
  bool is_sound() const { return is_sound_; }
  bool is_at_end() const { return at_ == bytes_.size(); }

 private:
  std::uint8_t Byte() {
    if (!is_sound_ || is_at_end()) return static_cast<std::uint8_t>(Fail());
    return bytes_[at_++];
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool is_sound_ = true;
};

/// Returns the next pixel from `x` on that is set (or not set); `width` if there is none.
int Find(const std::uint64_t* row, int x, int width, bool is_set) {
  while (x < width) {
    const std::uint64_t word = is_set ? row[x / kWordBits] : ~row[x / kWordBits];
    const std::uint64_t rest = word >> x % kWordBits;
    if (rest != 0) return std::min(x + std::countr_zero(rest), width);
    x += kWordBits - x % kWordBits;
  }
  return width;
}

int CountRuns(const std::uint64_t* row, int width) {
  int runs = 0;
  for (int x = Find(row, 0, width, true); x < width; x = Find(row, x, width, true)) {
    x = Find(row, x, width, false);
    ++runs;
  }
  return runs;
}

void PackRuns(const Silhouette& picture, Writer& writer) {
  const std::optional<PixelBox> box = picture.BoundingBox();
  const int rows = box ? box->bottom - box->top + 1 : 0;
  writer.Number(rows);
  if (rows == 0) return;
  writer.Number(box->top);
  for (int y = box->top; y <= box->bottom; ++y) {
    const std::uint64_t* const row = picture.row(y);
    writer.Number(CountRuns(row, picture.width()));
    int end = 0;
    for (int begin = Find(row, 0, picture.width(), true); begin < picture.width();
         begin = Find(row, end, picture.width(), true)) {
      writer.Number(begin - end);
      end = Find(row, begin, picture.width(), false);
      writer.Number(end - begin);
    }
  }
}

void SetRun(std::uint64_t* row, int begin, int end) {
  while (begin < end) {
    const int bit = begin % kWordBits;
    const int count = std::min(kWordBits - bit, end - begin);
    row[begin / kWordBits] |= (~std::uint64_t{0} >> (kWordBits - count)) << bit;
    begin += count;
  }
}

void UnpackRuns(Reader& reader, Silhouette& picture) {
  const int rows = reader.Number(picture.height());
  const int top = rows > 0 ? reader.Number(picture.height() - rows) : 0;
  for (int y = top; y < top + rows && reader.is_sound(); ++y) {
    const int runs = reader.Number(picture.width());
    int end = 0;
    for (int run = 0; run < runs && reader.is_sound(); ++run) {
      const int begin = end + reader.Number(picture.width() - end);
      end = begin + reader.Number(picture.width() - begin);
      SetRun(picture.row(y), begin, end);
    }
  }
  picture.KeepBox();
}

void PackShading(const Shading& shading, Writer& writer) {
  const std::vector<std::int8_t>& shades = shading.shades;
  for (auto begin = shades.begin(); begin != shades.end();) {
    const auto end = std::find_if(begin, shades.end(), [=](auto shade) { return shade != *begin; });
    writer.Shade(*begin);
    writer.Number(static_cast<int>(end - begin));
    begin = end;
  }
  writer.Number(static_cast<int>(shading.dark_tiles.size()));
  int last = 0;
  for (const Shading::DarkTile& tile : shading.dark_tiles) {
    const int index = tile.row * shading.tile_columns + tile.column;
    writer.Number(index - last);
    writer.Shade(tile.shade);
    last = index;
  }
}

void UnpackShading(Reader& reader, int width_px, int height_px, Shading& shading) {
  shading.tile_columns = TilesAlong(width_px);
  const int tiles = shading.tile_columns * TilesAlong(height_px);
  shading.shades.clear();
  for (int left = tiles; left > 0 && reader.is_sound();) {
    const std::int8_t shade = reader.Shade();
    const int count = reader.Number(left);
    if (count == 0) reader.Fail();
    shading.shades.insert(shading.shades.end(), static_cast<std::size_t>(count), shade);
    left -= count;
  }
  shading.dark_tiles.clear();
  const int dark_tiles = reader.Number(tiles);
  for (int i = 0, index = 0; i < dark_tiles && reader.is_sound(); ++i) {
    index += reader.Number(tiles - 1 - index);
    shading.dark_tiles.push_back({static_cast<std::int16_t>(index % shading.tile_columns),
                                  static_cast<std::int16_t>(index / shading.tile_columns),
                                  reader.Shade()});
  }
}

}  // namespace

void PackPicture(const Trimap& trimap, const Shading& shading, std::vector<std::uint8_t>& bytes) {
  Writer writer(bytes);
  PackRuns(trimap.person, writer);
  PackRuns(trimap.unknown, writer);
  PackRuns(shading.dark, writer);
  PackShading(shading, writer);
}

bool UnpackPicture(std::span<const std::uint8_t> bytes, int width_px, int height_px, Trimap& trimap,
                   Shading& shading) {
  Reader reader(bytes);
  for (Silhouette* const picture : {&trimap.person, &trimap.unknown, &shading.dark}) {
    picture->Reset(width_px, height_px);
    UnpackRuns(reader, *picture);
  }
  UnpackShading(reader, width_px, height_px, shading);
  return reader.is_sound() && reader.is_at_end();
}

}  // namespace mocap
