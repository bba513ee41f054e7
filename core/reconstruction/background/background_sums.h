// §4: what is summed up over pictures of the empty studio, pixel by pixel.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/background/expected_picture.h"

namespace mocap {

/// Sums of colours and of their distortions, in planes. Horprasert, Harwood, Davis 1999, §3.
class BackgroundSums {
 public:
  explicit BackgroundSums(std::size_t pixels);

  /// Empties pixels [begin, begin + count).
  void Clear(std::size_t begin, std::size_t count);
  /// Takes another's pixels for its own first ones.
  void Copy(const BackgroundSums& from, std::size_t begin, std::size_t count);

  /// Adds the colours of consecutive pixels, from `begin` on.
  /// @param gain   what each channel is multiplied by.
  /// @param times  1, or −1 to take them out again.
  void AddColors(const Bgr* pixels, int count, const std::array<float, 3>& gain, float times,
                 std::size_t begin);
  /// Adds how they differ from what is expected at `expected_begin` and on.
  void AddDistortions(const Bgr* pixels, int count, const std::array<float, 3>& gain, float times,
                      const ExpectedPicture& expected, std::size_t expected_begin,
                      std::size_t begin);

  /// Writes what the first of these pixels, from `begin` on, are taken to be.
  /// @param frames    how many pictures were added.
  /// @param shift_px  by how much contours move from one picture to the next.
  void Expect(std::size_t begin, int count, float frames, float shift_px, std::size_t to_begin,
              ExpectedPicture& to) const;

 private:
  std::array<std::vector<float>, 3> value_, value_sq_;
  std::vector<float> alpha_shift_sq_, cd_sq_;
};

}  // namespace mocap
