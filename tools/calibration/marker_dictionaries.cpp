#include "tools/calibration/marker_dictionaries.h"

#include <algorithm>
#include <cctype>
#include <opencv2/core.hpp>

#include "core/errors.h"

namespace mocap {
namespace {

struct NamedDictionary {
  const char* name;
  cv::aruco::PREDEFINED_DICTIONARY_NAME id;
};

// Those of one kind by size: the larger ones begin with the smaller.
constexpr NamedDictionary kDictionaries[] = {
    {"DICT_4X4_50", cv::aruco::DICT_4X4_50},
    {"DICT_4X4_100", cv::aruco::DICT_4X4_100},
    {"DICT_4X4_250", cv::aruco::DICT_4X4_250},
    {"DICT_4X4_1000", cv::aruco::DICT_4X4_1000},
    {"DICT_5X5_50", cv::aruco::DICT_5X5_50},
    {"DICT_5X5_100", cv::aruco::DICT_5X5_100},
    {"DICT_5X5_250", cv::aruco::DICT_5X5_250},
    {"DICT_5X5_1000", cv::aruco::DICT_5X5_1000},
    {"DICT_6X6_50", cv::aruco::DICT_6X6_50},
    {"DICT_6X6_100", cv::aruco::DICT_6X6_100},
    {"DICT_6X6_250", cv::aruco::DICT_6X6_250},
    {"DICT_6X6_1000", cv::aruco::DICT_6X6_1000},
    {"DICT_7X7_50", cv::aruco::DICT_7X7_50},
    {"DICT_7X7_100", cv::aruco::DICT_7X7_100},
    {"DICT_7X7_250", cv::aruco::DICT_7X7_250},
    {"DICT_7X7_1000", cv::aruco::DICT_7X7_1000},
    {"DICT_ARUCO_ORIGINAL", cv::aruco::DICT_ARUCO_ORIGINAL},
    {"DICT_APRILTAG_16h5", cv::aruco::DICT_APRILTAG_16h5},
    {"DICT_APRILTAG_25h9", cv::aruco::DICT_APRILTAG_25h9},
    {"DICT_APRILTAG_36h10", cv::aruco::DICT_APRILTAG_36h10},
    {"DICT_APRILTAG_36h11", cv::aruco::DICT_APRILTAG_36h11}};

constexpr const char* kLargest[] = {
    "DICT_4X4_1000",      "DICT_5X5_1000",       "DICT_6X6_1000",
    "DICT_7X7_1000",      "DICT_ARUCO_ORIGINAL", "DICT_APRILTAG_16h5",
    "DICT_APRILTAG_25h9", "DICT_APRILTAG_36h10", "DICT_APRILTAG_36h11"};

bool SameLetters(const std::string& a, const std::string& b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::toupper(x) == std::toupper(y); });
}

}  // namespace

std::string DictionaryName(const std::string& text) {
  for (const NamedDictionary& one : kDictionaries) {
    if (SameLetters(one.name, text)) return one.name;
  }
  return "";
}

std::vector<std::string> DictionaryNames() {
  std::vector<std::string> names;
  for (const NamedDictionary& one : kDictionaries) names.emplace_back(one.name);
  return names;
}

cv::Ptr<cv::aruco::Dictionary> DictionaryOf(const std::string& name) {
  const auto* one = std::ranges::find(kDictionaries, name, &NamedDictionary::name);
  MOCAP_CHECK(one != std::end(kDictionaries));
  return cv::aruco::getPredefinedDictionary(one->id);
}

std::vector<std::string> LargestDictionaries() {
  return {std::begin(kLargest), std::end(kLargest)};
}

bool ShareMarker(const std::string& a, const std::string& b, int id) {
  const cv::Mat in_a = DictionaryOf(a)->bytesList, in_b = DictionaryOf(b)->bytesList;
  return id < in_a.rows && id < in_b.rows && in_a.cols == in_b.cols &&
         DictionaryOf(a)->markerSize == DictionaryOf(b)->markerSize &&
         cv::norm(in_a.row(id), in_b.row(id), cv::NORM_INF) == 0;
}

std::string SmallestDictionary(const std::string& with, int id) {
  for (const NamedDictionary& one : kDictionaries) {
    if (ShareMarker(one.name, with, id)) return one.name;
  }
  return with;
}

}  // namespace mocap
