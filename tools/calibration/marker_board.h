// Detection of boards with markers: ChArUco boards and Kalibr's grids of AprilTags.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/calibration/board.h"
#include "tools/calibration/marker_grid.h"

namespace mocap {

/// How a kind of board prints its markers.
enum class MarkerStyle {
  kCharuco,   ///< A border of one bit, apart from the black squares.
  kAprilGrid  ///< A border of two bits; black squares touch the corners.
};

/// Finds markers of a dictionary. Corners of a grid of tags are found with subpixel accuracy, as
/// the squares that touch them make them crossings of edges; those of ChArUco to a pixel.
std::vector<Marker> FindMarkers(const cv::Mat& gray, const std::string& dictionary,
                                MarkerStyle style);

/// Measures the side of a marker over the distance of squares or tags.
double MeasureMarkerShare(const cv::Mat& gray, const MarkerGrid& grid,
                          const std::vector<Marker>& markers, MarkerStyle style);

/// Whether a measured share of a marker may be that of the board.
bool IsMarkerShare(double measured, const Board& board);

/// Number of markers on a board.
int MarkersOf(const Board& board);

/// Finds corners with subpixel accuracy, and the layout of the board. Empty if fewer than six are
/// seen, all are in one row, or the markers lie as on another board.
std::optional<BoardCorners> DetectMarkerBoard(const cv::Mat& gray, const Board& board);

}  // namespace mocap
