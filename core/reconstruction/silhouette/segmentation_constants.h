// §4: thresholds of segmentation. Those that a person may change are in SegmentationOptions;
// thresholds of pixels and windows are learned (DistortionThresholds).
#pragma once

#include <array>
#include <cstddef>

#include "core/kernels/windows.h"

namespace mocap::segmentation {

// Coarse pass: conditions of a picture as a whole.

/// This many tiles are enough for a median.
inline constexpr std::size_t kTileSamples = 200;
/// Near black, colour ratios mean nothing [grey levels].
inline constexpr float kDarkestForGain = 8;
inline constexpr float kLargestGain = 4;
/// Values that differ from the median by more than this share are not background.
inline constexpr float kFlatness = 0.06f;
/// Fewer contour pixels do not tell how far contours moved.
inline constexpr std::size_t kFewestSteep = 50;
inline constexpr float kLargestShift_px = 1;
/// People, shadows and light reflected by them may cover more than half of the picture. So standard
/// deviations are read at these quantiles. For a normal distribution, the quantiles lie at this
/// length in three dimensions, and at this absolute value in one.
inline constexpr double kUndisturbedTiles = 0.4;
inline constexpr float kUndisturbedLength = 1.367f;
inline constexpr double kUndisturbedContours = 0.25;
inline constexpr float kUndisturbedSize = 0.3186f;
/// Up to this factor, a deviation counts as usual. The other two limits are for what is left [grey
/// levels, pixels].
inline constexpr float kNotable = 1.5f;
inline constexpr float kNegligibleDrift = 0.3f;
inline constexpr float kNegligibleShift_px = 0.1f;
/// Drift is not normally distributed: some walls change, others do not [factor, grey levels].
inline constexpr float kDriftMargin = 4;
inline constexpr float kLargestDrift = 8;
/// Smaller movements of a camera are not followed, nor those after which contours still do not fit
/// [pixels, share of the shift that remains].
inline constexpr float kNudge_px = 0.25f;
inline constexpr float kMuchLess = 0.8f;

// Coarse pass: suspicious tiles.

/// Limits [variances]. A tile is suspicious if it is brighter or tinted by more than these; if its
/// pixels differ by this factor more than those of most tiles; or if it is nearly too dark for a
/// shadow. The last two factors scale distance and shift, which are part of the variance.
inline constexpr float kHarmlessGlare = 1.5f;
inline constexpr float kHarmlessTint = 1.5f;
inline constexpr float kHarmlessChiSquare = 6;
inline constexpr float kLeastChiSquare = 0.05f;
inline constexpr float kDarkMargin = 0.02f;
inline constexpr float kDistanceMargin = 2;
inline constexpr float kContourMargin = 2;
/// Fewer adjacent tiles are noise.
inline constexpr int kFewestTiles = 4;

// Windows.

/// Factors by which learned thresholds must be exceeded. They allow for effects that an empty
/// studio does not show: tinted shadows, and noise that a codec passes only where something moves.
/// Measured on takes with true masks; a change by a tenth has little effect.
inline constexpr std::array<float, kernels::kWindows> kWindowMargins = {1.1f, 1.35f};
/// A single pixel must differ more, because there are many of them.
inline constexpr float kPixelMargin = 1.6f;

// Unknown pixels.

/// Half the width of parts that are too thin to be more than a rim, and of gaps in what encloses
/// others [pixels]. A codec's colours have half the resolution, so halos are up to four wide.
inline constexpr int kRim_px = 2;

// Clean-up.

/// Smaller holes are noise [pixels]: first in the evidence, then in the refined outline.
inline constexpr int kSmallestGap_px = 12;
inline constexpr int kSmallestHole_px = 20;
/// A blob belongs to the person if its distance is within this share of the person's size, or if
/// its area is this share of the largest blob's.
inline constexpr double kReach = 0.5;
inline constexpr double kLarge = 0.5;

}  // namespace mocap::segmentation
