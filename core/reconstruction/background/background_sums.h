// §4: per-pixel sums over pictures of the empty studio.
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

  /// Sets the sums of pixels [begin, begin + count) to zero.
  void Clear(std::size_t begin, std::size_t count);
  /// Copies `count` pixels of another object from `begin` on to this object's first pixels.
  void Copy(const BackgroundSums& from, std::size_t begin, std::size_t count);

  /// Adds the colours of consecutive pixels, from `begin` on.
  /// @param gain   factor for each channel.
  /// @param times  1, or −1 to subtract them again.
  void AddColors(const Bgr* pixels, int count, const std::array<float, 3>& gain, float times,
                 std::size_t begin);
  /// Adds their distortions relative to the expected pixels from `expected_begin` on.
  void AddDistortions(const Bgr* pixels, int count, const std::array<float, 3>& gain, float times,
                      const ExpectedPicture& expected, std::size_t expected_begin,
                      std::size_t begin);

  /// Writes the expected appearance of `count` pixels from `begin` on.
  /// @param frames    number of pictures that were added.
  /// @param shift_px  shift of contours from one picture to the next.
  void Expect(std::size_t begin, int count, float frames, float shift_px, std::size_t to_begin,
              ExpectedPicture& to) const;

 private:
  std::array<std::vector<float>, 3> value_, value_sq_;
  std::vector<float> alpha_shift_sq_, cd_sq_;
};

}  // namespace mocap
