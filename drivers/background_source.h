// The source of a camera's pictures of the empty studio.
#pragma once

#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/reconstruction/silhouette/background_model.h"

namespace mocap {

/// Reads the pictures on each request: all at once, or one after the other if they do not fit into
/// memory. Its creator states whether several threads may use it.
class BackgroundSource {
 public:
  using Frames = std::vector<BackgroundFrame>;
  using Visit = std::function<void(const BackgroundFrame&)>;

  BackgroundSource() = default;

  /// @param read  returns all pictures.
  template <typename Read>
  requires(std::is_invocable_r_v<Frames, const Read&> && !std::is_same_v<Read, BackgroundSource>)
      BackgroundSource(Read read)  // NOLINT: whatever gives pictures is a source of them.
      : read_([read = std::move(read)](const Visit& visit) {
          for (const BackgroundFrame& frame : read()) visit(frame);
        }) {}

  /// @param read  passes each picture to the visitor, which keeps what it needs.
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
