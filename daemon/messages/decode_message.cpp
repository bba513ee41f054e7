#include "daemon/messages/decode_message.h"

namespace mocap {
namespace {

constexpr std::size_t kHash = 8;
constexpr std::size_t kNumber = 8;  ///< int64_t, double
constexpr std::size_t kPoint = 3 * kNumber;
constexpr std::size_t kLeastText = 4 + 1;  ///< Its length and its end.
constexpr std::size_t kPoints = 23;

/// Skips over a message's fields without storing them.
class Skimmer {
 public:
  explicit Skimmer(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  bool sound() const { return sound_; }

  void Skip(std::size_t bytes) {
    sound_ = sound_ && bytes <= rest_.size();
    if (sound_) rest_ = rest_.subspan(bytes);
  }
  /// Reads a count of items of at least `least_bytes` each; 0 once something is wrong.
  std::size_t Count(std::size_t least_bytes) {
    if (rest_.size() < 4) sound_ = false;
    if (!sound_) return 0;
    std::int32_t count = 0;
    for (int i = 0; i < 4; ++i) count = static_cast<std::int32_t>(count << 8 | rest_[i]);
    rest_ = rest_.subspan(4);
    sound_ = count >= 0 && static_cast<std::size_t>(count) <= rest_.size() / least_bytes;
    return sound_ ? static_cast<std::size_t>(count) : 0;
  }
  /// A text with its terminating zero.
  void Text() {
    const std::size_t length = Count(1);
    sound_ = sound_ && length > 0;
    Skip(length);
  }
  void Texts(std::size_t count) {
    for (std::size_t i = 0; sound_ && i < count; ++i) Text();
  }

 private:
  std::span<const std::uint8_t> rest_;
  bool sound_ = true;
};

/// The paper's values, joint angles, points with their deviations, residual and voxels.
void SkipPerson(Skimmer& skimmer) {
  skimmer.Skip(2 * kPoint + 17 * kNumber);
  skimmer.Skip(kNumber * skimmer.Count(kNumber));
  skimmer.Skip(kPoints * (kPoint + kNumber) + kNumber + 4);
}

void SkipBody(Skimmer& skimmer) {
  skimmer.Skip(kNumber);
  skimmer.Text();
  skimmer.Skip(kNumber);
  skimmer.Texts(kPoints);
  skimmer.Skip(kPoints * kPoint);
  const std::size_t joints = skimmer.Count(4);
  skimmer.Texts(joints);
  // Parent, axis, place, limits.
  skimmer.Skip(joints * (4 + 2 * kPoint + 2 * kNumber));
  skimmer.Skip(kPoints * 4);
  const std::size_t sizes = skimmer.Count(4);
  skimmer.Texts(sizes);
  skimmer.Skip(sizes * kNumber);
}

}  // namespace

bool HasSoundCounts(const pose_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  // Times and frame number, state.
  skimmer.Skip(kHash + 4 * kNumber + 1);
  SkipPerson(skimmer);
  skimmer.Skip(skimmer.Count(1));
  return skimmer.sound();
}

bool HasSoundCounts(const people_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  // Times and frame number.
  skimmer.Skip(kHash + 4 * kNumber);
  const std::size_t people = skimmer.Count(2 * kPoint + 17 * kNumber);
  for (std::size_t i = 0; skimmer.sound() && i < people; ++i) {
    skimmer.Skip(4);
    skimmer.Text();
    skimmer.Skip(1);
    SkipPerson(skimmer);
  }
  skimmer.Skip(skimmer.Count(1));
  return skimmer.sound();
}

bool HasSoundCounts(const body_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  skimmer.Skip(kHash);
  SkipBody(skimmer);
  return skimmer.sound();
}

bool HasSoundCounts(const person_body_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  skimmer.Skip(kHash + 4);
  skimmer.Text();
  SkipBody(skimmer);
  return skimmer.sound();
}

bool HasSoundCounts(const person_details_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  // Time and frame number, person and place, state, probability.
  skimmer.Skip(kHash + 2 * kNumber + 2 * 4 + 1 + kNumber);
  const auto skip_named = [&skimmer](std::size_t bytes_each) {
    const std::size_t count = skimmer.Count(kLeastText + bytes_each);
    skimmer.Texts(count);
    skimmer.Skip(count * bytes_each);
  };
  skip_named(kPoint + kNumber);
  skip_named(2 * kNumber);
  skip_named(kNumber);
  skimmer.Skip(kNumber);
  skimmer.Skip(kPoint * skimmer.Count(kPoint));
  return skimmer.sound();
}

bool HasSoundCounts(const status_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  skimmer.Skip(kHash + kNumber);
  skimmer.Text();
  skimmer.Skip(1 + 6 * kNumber);
  const auto skip_named = [&skimmer](std::size_t count, std::size_t bytes_each) {
    for (std::size_t i = 0; skimmer.sound() && i < count; ++i) {
      skimmer.Text();
      skimmer.Skip(bytes_each);
    }
  };
  skip_named(skimmer.Count(4), 1 + 5 * kNumber);
  skip_named(skimmer.Count(4), 4 * kNumber);
  return skimmer.sound();
}

bool HasSoundCounts(const service_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  skimmer.Skip(kHash + kNumber);
  skimmer.Texts(2);
  skimmer.Skip(2 * kNumber);
  skimmer.Texts(skimmer.Count(4));
  for (int made = 0; made < 2; ++made) {
    skimmer.Text();
    skimmer.Skip(kNumber);
  }
  skimmer.Skip(kNumber);
  skimmer.Skip(3 * kNumber * skimmer.Count(3 * kNumber));
  skimmer.Skip(1);
  skimmer.Text();
  skimmer.Skip(3 * kNumber);
  return skimmer.sound();
}

bool HasSoundCounts(const contrast_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  skimmer.Skip(kHash + kNumber);
  const auto cameras = skimmer.Count(4 + kNumber);
  skimmer.Texts(cameras);
  skimmer.Skip(kNumber * cameras);
  return skimmer.sound();
}

bool HasSoundCounts(const studio_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  skimmer.Skip(kHash + kNumber);
  skimmer.Texts(2);
  return skimmer.sound();
}

bool HasSoundCounts(const preview_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  skimmer.Skip(kHash + kNumber);
  skimmer.Text();
  // The camera's pose, and three sizes.
  skimmer.Skip(4 * kPoint + 3 * 4);
  skimmer.Skip(skimmer.Count(1));
  skimmer.Skip(4 * skimmer.Count(4));
  return skimmer.sound();
}

bool HasSoundCounts(const unknown_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  skimmer.Skip(kHash + kNumber);
  skimmer.Text();
  skimmer.Skip(4 * skimmer.Count(4));
  return skimmer.sound();
}

bool HasSoundCounts(const voxels_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  // Times, origin, edge length, sizes.
  skimmer.Skip(kHash + 2 * kNumber + kPoint + kNumber + 3 * 4);
  skimmer.Skip(4 * skimmer.Count(4));
  skimmer.Skip(skimmer.Count(1));
  return skimmer.sound();
}

bool HasSoundCounts(const silhouette_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  // Capture, sending, clock.
  skimmer.Skip(kHash + 3 * kNumber);
  skimmer.Text();
  // Session and number.
  skimmer.Skip(2 * kNumber);
  skimmer.Text();
  // Sequence, angles, blindness, light, nudge, duration, size.
  skimmer.Skip(3 * kNumber + 1 + 3 * kNumber + 2 * 4);
  skimmer.Skip(skimmer.Count(1));
  return skimmer.sound();
}

bool HasSoundCounts(const keypoints_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  skimmer.Skip(kHash + 4);
  // Sender, camera.
  skimmer.Texts(2);
  skimmer.Skip(kNumber + 4);
  const std::size_t points = skimmer.Count(kLeastText + kPoint);
  for (std::size_t i = 0; skimmer.sound() && i < points; ++i) {
    skimmer.Text();
    skimmer.Skip(kPoint);
  }
  return skimmer.sound();
}

bool HasSoundCounts(const keypoint_senders_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  skimmer.Skip(kHash + kNumber);
  const std::size_t senders = skimmer.Count(kLeastText + 5 * kNumber);
  skimmer.Texts(senders);
  skimmer.Skip(5 * kNumber * senders);
  const std::size_t reasons = skimmer.Count(kLeastText);
  skimmer.Texts(reasons);
  // Neither is more than the message has bytes, so the product does not overflow.
  skimmer.Skip(kNumber * senders * reasons);
  return skimmer.sound();
}

bool HasSoundCounts(const look_request_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  skimmer.Skip(kHash);
  skimmer.Text();
  // Rate and hold, person and side, encoding.
  skimmer.Skip(2 * kNumber + 2 * 4 + 1);
  return skimmer.sound();
}

bool HasSoundCounts(const look_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  skimmer.Skip(kHash + kNumber);
  skimmer.Text();
  // Person and region, way up, size and encoding.
  skimmer.Skip(5 * 4 + 2 * kNumber + 4 + 1);
  skimmer.Skip(skimmer.Count(1));
  return skimmer.sound();
}

bool HasSoundCounts(const node_t&, std::span<const std::uint8_t> bytes) {
  Skimmer skimmer(bytes);
  skimmer.Skip(kHash + 2 * kNumber);
  skimmer.Text();
  skimmer.Skip(kNumber);
  // Version, host, program that keeps the clock.
  skimmer.Texts(3);
  skimmer.Skip(1 + kNumber);
  skimmer.Texts(3 * skimmer.Count(3 * 4));
  skimmer.Texts(skimmer.Count(4));
  return skimmer.sound();
}

}  // namespace mocap
