#include "core/kernels/halving.h"

#include <algorithm>

#include "core/kernels/halving_reference.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/halving.cpp"
#include "core/kernels/each_target.h"
#include "core/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

constexpr int kTile = kTileSide;
constexpr float kArea = kTilePixels;

#if HWY_TARGET == HWY_SCALAR

void HalveWholeTiles(const std::uint8_t* from, std::ptrdiff_t stride, int count,
                     const HalvedTiles& to) {
  reference::HalveTiles(from, stride, count, to);
}

#else

// Two adjacent tiles are halved at once. Sixteen pixels become eight.
constexpr int kStrip = 2 * kTile;
constexpr hn::FixedTag<std::uint8_t, 2 * kStrip> kBytes;
constexpr hn::FixedTag<std::uint16_t, kStrip> kShorts;
using Bytes = hn::Vec<decltype(kBytes)>;
using Shorts = hn::Vec<decltype(kShorts)>;

// Averages the bytes of two rows, regardless of channel: more bytes fit into a vector than sums of
// them.
HWY_INLINE Bytes AverageBytes(const std::uint8_t* top, const std::uint8_t* bottom) {
  const Bytes a = hn::LoadU(kBytes, top), b = hn::LoadU(kBytes, top + 3);
  const Bytes c = hn::LoadU(kBytes, bottom), d = hn::LoadU(kBytes, bottom + 3);
  const Bytes ab = hn::AverageRound(a, b), cd = hn::AverageRound(c, d);
  // Rounding up twice gives one too many if a pair's mean and the mean of both are rounded.
  const Bytes excess =
      hn::And(hn::And(hn::Or(hn::Xor(a, b), hn::Xor(c, d)), hn::Xor(ab, cd)), hn::Set(kBytes, 1));
  return hn::AverageRound(ab, cd) - excess;
}

// Places of bytes in the averages of 48 bytes, of which three vectors are read: from bytes 0, 16
// and 29 on. The last vector ends with the last pixel: nothing is read beyond the picture.
constexpr int kSecond = 16, kLast = 6 * kStrip - 3 - 16;
constexpr std::uint8_t kNone = 0x80;
using Order = std::array<std::uint8_t, 16>;
// Orders the bytes of one vector: eight of a channel and then eight of another.
constexpr Order OrderOf(int first_channel, int second_channel, int begin, int end, int offset) {
  Order order{};
  for (int i = 0; i < 16; ++i) {
    const int channel = i < kStrip ? first_channel : second_channel;
    const int byte = channel < 0 ? -1 : 6 * (i % kStrip) + channel;
    order[static_cast<std::size_t>(i)] =
        byte >= begin && byte < end ? static_cast<std::uint8_t>(byte - offset) : kNone;
  }
  return order;
}
struct Orders {
  Order x, y, z;
};
constexpr Orders OrdersOf(int first_channel, int second_channel) {
  return {OrderOf(first_channel, second_channel, 0, kSecond, 0),
          OrderOf(first_channel, second_channel, kSecond, kLast + 3, kSecond),
          OrderOf(first_channel, second_channel, kLast + 3, 48, kLast)};
}
constexpr Orders kBlueAndGreen = OrdersOf(0, 1), kRed = OrdersOf(2, -1);

HWY_INLINE Bytes InOrder(Bytes x, Bytes y, Bytes z, const Orders& orders) {
  return hn::Or(hn::Or(hn::TableLookupBytesOr0(x, hn::LoadU(kBytes, orders.x.data())),
                       hn::TableLookupBytesOr0(y, hn::LoadU(kBytes, orders.y.data()))),
                hn::TableLookupBytesOr0(z, hn::LoadU(kBytes, orders.z.data())));
}

// Sums of the columns of two tiles.
struct Columns {
  Shorts blue, green, red;
};

// Halves two rows to eight pixels, and adds these to the sums.
HWY_INLINE void HalveStrip(const std::uint8_t* top, const std::uint8_t* bottom, std::uint8_t* b,
                           std::uint8_t* g, std::uint8_t* r, Columns& columns) {
  constexpr hn::Half<std::remove_const_t<decltype(kBytes)> > half;
  const Bytes x = AverageBytes(top, bottom), y = AverageBytes(top + kSecond, bottom + kSecond);
  const Bytes z = AverageBytes(top + kLast, bottom + kLast);
  const Bytes blue_green = InOrder(x, y, z, kBlueAndGreen);
  const auto blue = hn::LowerHalf(blue_green), green = hn::UpperHalf(half, blue_green);
  const auto red = hn::LowerHalf(InOrder(x, y, z, kRed));
  hn::StoreU(blue, half, b);
  hn::StoreU(green, half, g);
  hn::StoreU(red, half, r);
  columns.blue = columns.blue + hn::PromoteTo(kShorts, blue);
  columns.green = columns.green + hn::PromoteTo(kShorts, green);
  columns.red = columns.red + hn::PromoteTo(kShorts, red);
}

// Averages two tiles, of which the columns were summed.
HWY_INLINE void AverageTwo(Shorts columns, float* means) {
  constexpr hn::RepartitionToWide<decltype(kShorts)> kPairs;
  constexpr hn::RepartitionToWide<decltype(kPairs)> kTiles;
  const auto shorts = hn::BitCast(kPairs, columns);
  const auto pairs = hn::And(shorts, hn::Set(kPairs, 0xffff)) + hn::ShiftRight<16>(shorts);
  const auto twos = hn::BitCast(kTiles, pairs);
  const auto sums = hn::And(twos, hn::Set(kTiles, 0xffffffff)) + hn::ShiftRight<32>(twos);
  alignas(16) std::array<std::uint64_t, 2> tiles;
  hn::Store(sums, kTiles, tiles.data());
  means[0] = static_cast<float>(static_cast<int>(tiles[0])) / kArea;
  means[1] = static_cast<float>(static_cast<int>(tiles[1])) / kArea;
}

void HalveWholeTiles(const std::uint8_t* from, std::ptrdiff_t stride, int count,
                     const HalvedTiles& to) {
  const auto [b, g, r] = to.color;
  const int width = to.width;
  // If the number of tiles is odd, the last pair overlaps the one before.
  for (int end = 2; end < count + 2; end += 2) {
    const int tile = std::min(end, count) - 2;
    Columns columns = {hn::Zero(kShorts), hn::Zero(kShorts), hn::Zero(kShorts)};
    for (int y = 0; y < kTileRows; ++y) {
      const std::uint8_t* const top = from + kRowStep_px * y * stride + tile * kTile * 6;
      const int i = y * width + tile * kTile;
      HalveStrip(top, top + stride, b + i, g + i, r + i, columns);
    }
    AverageTwo(columns.blue, to.tile_mean[0] + tile);
    AverageTwo(columns.green, to.tile_mean[1] + tile);
    AverageTwo(columns.red, to.tile_mean[2] + tile);
  }
}

#endif  // HWY_TARGET == HWY_SCALAR

void AverageRowOfTiles(const std::uint8_t* pixels, int width, std::uint16_t* columns,
                       float* means) {
  for (int x = 0; x < width; ++x)
    columns[x] = static_cast<std::uint16_t>(pixels[x] + pixels[width + x]);
  for (int i = 0; i < width / kTile; ++i)
    means[i] = static_cast<float>(columns[4 * i] + columns[4 * i + 1] + columns[4 * i + 2] +
                                  columns[4 * i + 3]) /
               kArea;
}

void AverageRowOfVariances(const float* variance, const std::uint8_t* slope, int width,
                           float* columns, float* mean_variance, float* mean_slope_sq) {
  for (int x = 0; x < width; ++x) columns[x] = variance[x] + variance[width + x];
  for (int i = 0; i < width / kTile; ++i)
    mean_variance[i] =
        (columns[4 * i] + columns[4 * i + 1] + columns[4 * i + 2] + columns[4 * i + 3]) / kArea;
  for (int x = 0; x < width; ++x) {
    columns[x] = 0;
    for (int y = 0; y < kTileRows; ++y)
      columns[x] += static_cast<float>(slope[y * width + x] * slope[y * width + x]);
  }
  for (int i = 0; i < width / kTile; ++i)
    mean_slope_sq[i] =
        (columns[4 * i] + columns[4 * i + 1] + columns[4 * i + 2] + columns[4 * i + 3]) / kArea;
}

}  // namespace
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::kernels {

HWY_EXPORT(HalveWholeTiles);
void HalveTiles(const std::uint8_t* from, std::ptrdiff_t stride, int count, const HalvedTiles& to) {
  HWY_DYNAMIC_DISPATCH(HalveWholeTiles)(from, stride, count, to);
}

HWY_EXPORT(AverageRowOfTiles);
void AverageTiles(const std::uint8_t* pixels, int width, std::uint16_t* columns, float* means) {
  HWY_DYNAMIC_DISPATCH(AverageRowOfTiles)(pixels, width, columns, means);
}

HWY_EXPORT(AverageRowOfVariances);
void AverageVariances(const float* variance, const std::uint8_t* slope, int width, float* columns,
                      float* mean_variance, float* mean_slope_sq) {
  HWY_DYNAMIC_DISPATCH(AverageRowOfVariances)
  (variance, slope, width, columns, mean_variance, mean_slope_sq);
}

}  // namespace mocap::kernels
#endif  // HWY_ONCE
