// Sets of markers, by OpenCV's names.
#pragma once

#include <opencv2/aruco/dictionary.hpp>
#include <string>
#include <vector>

namespace mocap {

/// The markers of Kalibr's grids.
inline constexpr const char* kAprilGridDictionary = "DICT_APRILTAG_36h11";

/// Returns OpenCV's name of a dictionary whose name is spelt in upper or lower case; empty if there
/// is none.
std::string DictionaryName(const std::string& text);

/// All names, for messages.
std::vector<std::string> DictionaryNames();

/// Returns a dictionary by OpenCV's name.
cv::Ptr<cv::aruco::Dictionary> DictionaryOf(const std::string& name);

/// Returns the dictionaries that no other contains.
std::vector<std::string> LargestDictionaries();

/// Returns the smallest dictionary that has marker `id` of another one, as the same marker.
std::string SmallestDictionary(const std::string& with, int id);

/// Whether both have marker `id`, and it is the same.
bool ShareMarker(const std::string& a, const std::string& b, int id);

}  // namespace mocap
