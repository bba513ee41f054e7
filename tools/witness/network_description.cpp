#include "tools/witness/network_description.h"

#include <algorithm>
#include <span>
#include <string_view>

#include "config/toml_section.h"
#include "drivers/quoted.h"

namespace mocap {
namespace {

/// For points that are not used.
constexpr std::string_view kNoLandmark = "-";
constexpr int kLargestInput_px = 4096;

using Names = std::span<const std::string_view>;

constexpr std::array<std::string_view, 17> kCoco = {
    "nose",           "left_eye",   "right_eye",   "left_ear",   "right_ear",   "left_shoulder",
    "right_shoulder", "left_elbow", "right_elbow", "left_wrist", "right_wrist", "left_hip",
    "right_hip",      "left_knee",  "right_knee",  "left_ankle", "right_ankle"};
constexpr std::array<std::string_view, 9> kHalpeFurther = {
    "head_top",        "neck",      "hip_middle", "left_big_toe", "right_big_toe", "left_small_toe",
    "right_small_toe", "left_heel", "right_heel"};
constexpr std::array<std::string_view, 6> kWholeBodyFeet = {"left_big_toe",    "left_small_toe",
                                                            "left_heel",       "right_big_toe",
                                                            "right_small_toe", "right_heel"};
constexpr std::size_t kWholeBodyPoints = 133;
constexpr std::array<std::string_view, 33> kBlazePose = {"nose",
                                                         "-",
                                                         "left_eye",
                                                         "-",
                                                         "-",
                                                         "right_eye",
                                                         "-",
                                                         "left_ear",
                                                         "right_ear",
                                                         "mouth_left",
                                                         "mouth_right",
                                                         "left_shoulder",
                                                         "right_shoulder",
                                                         "left_elbow",
                                                         "right_elbow",
                                                         "left_wrist",
                                                         "right_wrist",
                                                         "left_pinky",
                                                         "right_pinky",
                                                         "left_index",
                                                         "right_index",
                                                         "-",
                                                         "-",
                                                         "left_hip",
                                                         "right_hip",
                                                         "left_knee",
                                                         "right_knee",
                                                         "left_ankle",
                                                         "right_ankle",
                                                         "left_heel",
                                                         "right_heel",
                                                         "left_foot_index",
                                                         "right_foot_index"};
/// Points that follow the body's and serve to place the next crop.
constexpr std::size_t kBlazePoseFurther = 6;

void AddLandmarks(Names names, std::vector<std::optional<Landmark>>& landmarks) {
  for (const std::string_view name : names) landmarks.push_back(LandmarkNamed(name));
}

/// Knuckles among the 133 points; the rest of face and hands is not used.
void AddWholeBody(std::vector<std::optional<Landmark>>& landmarks) {
  AddLandmarks(kWholeBodyFeet, landmarks);
  landmarks.resize(kWholeBodyPoints);
  constexpr std::size_t kLeftHand = 91, kRightHand = 112, kIndex = 5, kPinky = 17;
  landmarks[kLeftHand + kIndex] = Landmark::kIndexL;
  landmarks[kLeftHand + kPinky] = Landmark::kPinkyL;
  landmarks[kRightHand + kIndex] = Landmark::kIndexR;
  landmarks[kRightHand + kPinky] = Landmark::kPinkyR;
}

std::vector<std::optional<Landmark>> LandmarksIn(TomlSection& section) {
  std::vector<std::optional<Landmark>> landmarks;
  for (const std::string& name : section.Texts("landmarks")) {
    landmarks.push_back(LandmarkNamed(name));
    if (!landmarks.back() && name != kNoLandmark)
      section.Fail("landmarks", "has " + Quoted(name) +
                                    "; expected a landmark such as left_shoulder, or \"-\" for a "
                                    "point that is not used");
  }
  std::vector<Landmark> used;
  for (const auto& landmark : landmarks)
    if (landmark) used.push_back(*landmark);
  std::ranges::sort(used);
  if (const auto twice = std::ranges::adjacent_find(used); twice != used.end())
    section.Fail("landmarks", "has " + NameOf(*twice) + " a second time");
  if (used.empty()) section.Fail("landmarks", "names no landmark");
  return landmarks;
}

std::vector<AnswerColumn> ColumnsIn(TomlSection& section) {
  const std::vector<std::string> names = section.Texts("columns");
  std::vector<AnswerColumn> columns;
  for (const std::string& name : names) {
    if (name != "x" && name != "y" && name != "score" && name != "-")
      section.Fail("columns", "has " + Quoted(name) + "; expected x, y, score or -");
    columns.push_back(name == "x"       ? AnswerColumn::kX
                      : name == "y"     ? AnswerColumn::kY
                      : name == "score" ? AnswerColumn::kScore
                                        : AnswerColumn::kUnused);
  }
  if (std::ranges::count(names, "x") != 1 || std::ranges::count(names, "y") != 1)
    section.Fail("columns", "has not one x and one y");
  return columns;
}

std::array<double, 3> ColorsIn(TomlSection& section, const std::string& key) {
  const std::vector<double> numbers = section.Numbers(key, 3);
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

std::filesystem::path DescriptionBeside(const std::filesystem::path& model) {
  return std::filesystem::path(model).replace_extension(".toml");
}

NetworkDescription ReadNetworkDescription(const std::filesystem::path& file) {
  TomlSection section = TomlSection::ReadFile(file);
  NetworkDescription network;
  network.width_px = static_cast<int>(section.IntegerWithin("width_px", 16, kLargestInput_px));
  network.height_px = static_cast<int>(section.IntegerWithin("height_px", 16, kLargestInput_px));
  network.takes_rgb = section.Choice("colors", {"bgr", "rgb"}) == 1;
  network.mean = ColorsIn(section, "mean");
  network.std = ColorsIn(section, "std");
  if (std::ranges::any_of(network.std, [](double std) { return std <= 0; }))
    section.Fail("std", "is not positive");
  network.kind =
      static_cast<AnswerKind>(section.Choice("kind", {"heatmaps", "simcc", "coordinates"}));
  network.outputs = section.Texts("outputs");
  const std::size_t wanted = network.kind == AnswerKind::kSimcc ? 2 : 1;
  if (network.outputs.size() != wanted)
    section.Fail("outputs", wanted == 2 ? "is not the names of two outputs, along x and along y"
                                        : "is not the name of one output");
  network.presence = section.Text("presence", "");
  network.landmarks = LandmarksIn(section);
  section.Reserve({"columns"}, "kind = \"coordinates\"");
  if (network.kind == AnswerKind::kCoordinates) network.columns = ColumnsIn(section);
  network.scores_are_logits = section.Choice("score", {"probability", "logit"}) == 1;
  section.RejectUnknownKeys();
  return network;
}

NetworkDescription BlazePoseDescription(const std::string& output, const std::string& presence) {
  NetworkDescription network{.width_px = 256,
                             .height_px = 256,
                             .kind = AnswerKind::kCoordinates,
                             .outputs = {output},
                             .presence = presence,
                             .landmarks = {}};
  AddLandmarks(kBlazePose, network.landmarks);
  network.landmarks.resize(kBlazePose.size() + kBlazePoseFurther);
  // Its scores are that a point is visible, and that it is in the picture.
  network.columns = {AnswerColumn::kX, AnswerColumn::kY, AnswerColumn::kUnused,
                     AnswerColumn::kScore, AnswerColumn::kScore};
  network.scores_are_logits = true;
  return network;
}

NetworkDescription RtmPoseDescription(int points, int width_px, int height_px) {
  NetworkDescription network{.width_px = width_px,
                             .height_px = height_px,
                             .mean = {123.675, 116.28, 103.53},
                             .std = {58.395, 57.12, 57.375},
                             .kind = AnswerKind::kSimcc,
                             .outputs = {"simcc_x", "simcc_y"},
                             .landmarks = {}};
  AddLandmarks(kCoco, network.landmarks);
  constexpr int kHalpePoints = 26;
  if (points == kHalpePoints) AddLandmarks(kHalpeFurther, network.landmarks);
  if (points == static_cast<int>(kWholeBodyPoints)) AddWholeBody(network.landmarks);
  return network;
}

}  // namespace mocap
