// Finds chessboards that detectors miss because they lie flat and far away.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace mocap {

/// Finds bright quadrilaterals, rectifies each to a view from above, and searches it for the board.
/// @param size  inner corners across and down.
/// @return  the corners in the picture, row after row; empty when there is no board.
std::vector<cv::Point2f> FindRectifiedChessboard(const cv::Mat& gray, const cv::Size& size);

}  // namespace mocap
