// A small camera for tests of segmenters, and whether their results depend on the pictures before.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "core/reconstruction/silhouette/segmenter.h"
#include "tests/core/reconstruction/lenses.h"

namespace mocap {

inline constexpr int kSmallWidth = 200;
inline constexpr int kSmallHeight = 150;

inline CameraCalibration SmallCamera() {
  CameraCalibration camera;
  camera.name = "cam3";
  camera.width_px = kSmallWidth;
  camera.height_px = kSmallHeight;
  camera.lens = OpenCvLens{PinholeMatrix(200, 200, 100, 75), {}};
  return camera;
}

/// As in an empty studio from which a codec removed the noise [grey levels].
inline constexpr float kNoNoise = 0.01f;

/// Segments pictures in turn, and each by a segmenter that has seen nothing else.
inline void ExpectSameAsFresh(const CameraCalibration& camera,
                              const std::vector<BackgroundFrame>& background,
                              const std::vector<BackgroundFrame>& pictures) {
  Segmenter seasoned(camera, background, {});
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    SCOPED_TRACE(i);
    Segmenter fresh(camera, background, {});
    Trimap expected, trimap;
    fresh.Segment(pictures[i].image.view(), pictures[i].angles, expected);
    seasoned.Segment(pictures[i].image.view(), pictures[i].angles, trimap);
    EXPECT_EQ(trimap.person.words(), expected.person.words());
    EXPECT_EQ(trimap.unknown.words(), expected.unknown.words());
    EXPECT_EQ(seasoned.shading().dark.words(), fresh.shading().dark.words());
    EXPECT_EQ(seasoned.shading().dark_tiles, fresh.shading().dark_tiles);
    EXPECT_EQ(seasoned.shading().shades, fresh.shading().shades);
    EXPECT_EQ(seasoned.conditions().gain, fresh.conditions().gain);
    EXPECT_EQ(seasoned.conditions().drift, fresh.conditions().drift);
    EXPECT_EQ(seasoned.conditions().shift_px, fresh.conditions().shift_px);
    EXPECT_EQ(seasoned.conditions().displacement, fresh.conditions().displacement);
  }
}

}  // namespace mocap
