// Where and when another recording lies in ours: offset in time, rigid transform, and pairs of
// points.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/comparison/name_map.h"
#include "tools/comparison/paired_places.h"

namespace mocap {

/// Pairs points of two recordings. @return  those that both have.
std::vector<PointPair> PairsOf(const ResultMotion& own, const RecordedMotion& other,
                               std::span<const NamedPair> names);

/// Aligns by pairs of points that are known by their names.
///
/// The offset is found first, from the correlation of the points' speeds, which no frame of
/// reference changes; the strongest offsets are then tried with a robust rigid fit. See Refined.
/// @param names  a point may occur more than once, the likeliest first; if a marker occurs at
/// several points, the nearest one keeps it.
/// @return  empty for fewer than three pairs, or none that moves alike.
std::optional<Alignment> AlignByNames(const ResultMotion& own, const RecordedMotion& other,
                                      const std::vector<NamedPair>& names);

/// Aligns without names. Quantiles of all points' speeds give offsets; there, triples of points
/// that are as fast and as far apart as others give transforms, of which the one that brings most
/// points together is refined (random sample consensus, always with the same draws).
/// @return  empty if nothing fits.
std::optional<Alignment> AlignByMotion(const ResultMotion& own, const RecordedMotion& other);

/// Aligns by joint angles of the same names; those of the pelvis turn it about the vertical axis of
/// OpenSim's ground.
std::optional<Alignment> AlignByAngles(const ResultMotion& own, const RecordedMotion& other,
                                       const std::vector<AnglePair>& angles);

/// The time step of coarse searches: at most 30 a second, and no more than both recordings have.
double CoarseStep(const RecordedMotion& own, const RecordedMotion& other);
/// How many of such steps recordings must overlap by: a quarter of the shorter one, and a second if
/// it is that long.
std::size_t LeastOverlap(const RecordedMotion& own, const RecordedMotion& other, double step_s);

/// Refines offset and transform of pairs, the offset to a part of a frame. What is constant in the
/// axes of a pair's segment does not count for the offset: a marker on the skin is not at the
/// joint.
/// @param reach_s  within which the offset lies.
Alignment Refined(const ResultMotion& own, const RecordedMotion& other, Alignment alignment,
                  double reach_s);

}  // namespace mocap
