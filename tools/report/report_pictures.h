// The report's camera pictures, overlaid with trimap and body.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tools/report/hull_overlap.h"
#include "tools/report/report_page.h"
#include "tools/results/result.h"
#include "tools/take_samples.h"

namespace mocap {

/// A person at the moment of a picture. Not owned.
struct ViewedBody {
  const PoseRow& row;  ///< Drawn if tracked.
  const BodySizes& sizes;
  int figure = kOfSides;  ///< Colour; kOfSides: one for each side of the body.

  static constexpr int kOfSides = -1;
};

/// Everybody at a time; empty if no frame of a result has it.
using BodiesAt = std::function<std::vector<ViewedBody>(std::int64_t time_ns)>;

/// The pictures of the sampled moments, cropped to the people, with the lines that
/// picture_lines.js draws over them.
/// @param overlaps  of all cameras. @param start_ns  from which seconds are counted.
Json PictureSection(const TakeSamples& samples, std::span<const CameraOverlap> overlaps,
                    std::int64_t start_ns, const BodiesAt& bodies_at);

}  // namespace mocap
