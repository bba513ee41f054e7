// From the numbers that pose networks give to points in the pictures they were asked about.
#pragma once

#include <span>
#include <vector>

#include "core/geometry.h"

namespace mocap {

/// A point as a network gives it.
struct FoundPoint {
  Vector2 crop_px = Vector2::Zero();  ///< In the network's input; pixel centres lie at integers.
  double score = 0;                   ///< As the network gives it; finite.
};

/// A picture of scores for each point: the point is at the highest one, a quarter of a cell towards
/// its higher neighbour.
/// @param values  points × height × width. @pre  their number is right; width and height > 1.
/// @param width_px  of the network's input, and height_px.
std::vector<FoundPoint> DecodeHeatmaps(std::span<const float> values, int height, int width,
                                       int width_px, int height_px);

/// A row of scores along x and another along y for each point (SimCC, Li et al. 2022): the point is
/// at the highest of each, and its score is the smaller of the two.
/// @param x  points × bins, likewise y. @pre  their numbers are right.
std::vector<FoundPoint> DecodeSimcc(std::span<const float> x, std::span<const float> y, int points,
                                    int width_px, int height_px);

/// What a number of a point is.
enum class AnswerColumn { kX, kY, kScore, kUnused };

/// Coordinates in pixels of the input, from its left and upper edge, and scores of which the
/// product counts.
/// @param values  points × columns. @param are_logits  of the scores.
std::vector<FoundPoint> DecodeCoordinates(std::span<const float> values,
                                          std::span<const AnswerColumn> columns, bool are_logits);

/// The probability of a logit.
double Sigmoid(double logit);

}  // namespace mocap
