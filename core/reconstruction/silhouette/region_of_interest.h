// §4: the parts of a picture that are looked at closely.
#pragma once

#include <span>
#include <vector>

#include "core/reconstruction/background/half_picture.h"
#include "core/reconstruction/silhouette/pixel_run.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Whole tiles of a picture, and around them as much as it takes to judge them.
///
/// Reuses its memory.
class RegionOfInterest {
 public:
  static constexpr int kMargin_px = HalfPicture::kTile_px / 2;

  /// Takes in the suspicious tiles and their neighbours.
  /// @param suspicious     one pixel a tile of HalfPicture::kTile_px pixels.
  /// @param width, height  of the picture.
  void Set(const Silhouette& suspicious, int width, int height);
  /// Takes in the whole picture.
  void SetAll(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  /// What surrounds all pixels that are measured: whole words of silhouettes, and a tile above and
  /// below.
  const PixelBox& frame() const { return frame_; }
  /// The pixels of a row that are judged, in runs from left to right.
  std::span<const PixelRun> Judged(int y) const { return judged_.Row(y); }
  /// The pixels of a row whose colours count: those that are judged, and kMargin_px pixels more in
  /// every direction.
  std::span<const PixelRun> Measured(int y) const { return measured_.Row(y); }

 private:
  // Runs of rows of pixels, so many of which have the same.
  class Runs {
   public:
    void Clear(int row_px);
    // `word_at` gives the row's tiles, 64 a word.
    template <typename WordAt>
    void AddRow(int words, int width, int margin_px, WordAt word_at);
    std::span<const PixelRun> Row(int y) const {
      const int row = y / row_px_;
      return {runs_.data() + begins_[row], runs_.data() + begins_[row + 1]};
    }

   private:
    int row_px_ = 1;
    std::vector<PixelRun> runs_;
    std::vector<int> begins_;
  };

  void MeasureFrame();

  int width_ = 0, height_ = 0;
  PixelBox frame_;
  Silhouette tiles_;
  Runs judged_, measured_;
};

}  // namespace mocap
