// Which board a picture shows, whatever --board says.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "tools/calibration/board.h"

namespace mocap {

/// Finds the ChArUco board, of any dictionary, or grid of tags that a picture shows. Its rows are
/// those that are seen. What a picture does not show, such as lengths, and what agrees is as
/// expected. Empty if none is recognized.
std::optional<Board> FindShownMarkerBoard(const cv::Mat& gray, const Board& expected);

/// The same for a chessboard without markers.
std::optional<Board> FindShownChessboard(const cv::Mat& gray, const Board& expected);

/// Whether a board that was seen, perhaps in part, may be the expected one.
bool MayBe(const Board& shown, const Board& expected);

/// Names both: "looks like charuco:6x7:60:DICT_4X4_50:0.75, not charuco:7x6:60:DICT_4X4_50:0.75".
std::string LooksLikeText(const Board& shown, const Board& expected);

}  // namespace mocap
