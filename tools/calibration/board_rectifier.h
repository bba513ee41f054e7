// Chessboards that detectors miss because they lie flat and far away.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace mocap {

/// Looks for bright sheets with four corners, turns each into a rectangle as seen from straight
/// above and finds the board there.
/// @param size  inner corners across and down.
/// @return  the corners in the picture, row after row; none when there is no board.
std::vector<cv::Point2f> FindRectifiedChessboard(const cv::Mat& gray, const cv::Size& size);

}  // namespace mocap
