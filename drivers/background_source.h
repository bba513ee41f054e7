// Where a camera's pictures of the empty studio come from.
#pragma once

#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/reconstruction/background/background_model.h"

namespace mocap {

/// Reads them each time that it is asked: all at once, or one after the other where they are too
/// many to be in memory. Whoever made it says whether several threads may ask.
class BackgroundSource {
 public:
  using Frames = std::vector<BackgroundFrame>;
  using Visit = std::function<void(const BackgroundFrame&)>;

  BackgroundSource() = default;

  /// @param read  gives all of them.
  template <typename Read>
  requires(std::is_invocable_r_v<Frames, const Read&> && !std::is_same_v<Read, BackgroundSource>)
      BackgroundSource(Read read)  // NOLINT: whatever gives pictures is a source of them.
      : read_([read = std::move(read)](const Visit& visit) {
          for (const BackgroundFrame& frame : read()) visit(frame);
        }) {}

  /// @param read  shows each picture to the visitor, which keeps what it wants.
  static BackgroundSource OneByOne(std::function<void(const Visit&)> read) {
    BackgroundSource source;
    source.read_ = std::move(read);
    return source;
  }

  void ForEach(const Visit& visit) const { read_(visit); }

  Frames operator()() const {
    Frames frames;
    ForEach([&frames](const BackgroundFrame& frame) { frames.push_back(frame); });
    return frames;
  }

 private:
  std::function<void(const Visit&)> read_;
};

}  // namespace mocap
