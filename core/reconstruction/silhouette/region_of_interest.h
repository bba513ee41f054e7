// §4: the parts of a picture that are segmented at full resolution.
#pragma once

#include <span>
#include <vector>

#include "core/reconstruction/background/half_picture.h"
#include "core/reconstruction/silhouette/pixel_run.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Whole tiles of a picture, with the surroundings that their decisions need. Reuses its memory.
class RegionOfInterest {
 public:
  static constexpr int kMargin_px = HalfPicture::kTile_px / 2;

  /// Sets the suspicious tiles and their neighbours.
  /// @param suspicious     one pixel per tile of HalfPicture::kTile_px pixels.
  /// @param width, height  of the picture.
  void Set(const Silhouette& suspicious, int width, int height);
  /// Sets the whole picture.
  void SetAll(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  /// A box around all measured pixels: whole words of silhouettes, and one tile more above and
  /// below.
  const PixelBox& frame() const { return frame_; }
  /// The judged pixels of a row, in runs from left to right.
  std::span<const PixelRun> Judged(int y) const { return judged_.Row(y); }
  /// The measured pixels of a row: the judged ones, and kMargin_px more in every direction.
  std::span<const PixelRun> Measured(int y) const { return measured_.Row(y); }

 private:
  // Runs per row; `row_px` consecutive pixel rows share the same runs.
  class Runs {
   public:
    void Clear(int row_px);
    // `word_at` returns the row's tiles, 64 per word.
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
