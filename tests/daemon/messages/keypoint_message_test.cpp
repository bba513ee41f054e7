#include "daemon/messages/keypoint_message.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

CameraCalibration SmallPicture() {
  CameraCalibration camera;
  camera.name = "cam1";
  camera.width_px = 640;
  camera.height_px = 480;
  return camera;
}

keypoints_t MessageOf(std::vector<keypoint_t> points) {
  keypoints_t message{};
  message.version = keypoints_t::VERSION;
  message.sender = "witness";
  message.camera = "cam1";
  message.capture_ns = 1'700'000'000'000'000'000;
  message.points = std::move(points);
  message.num_points = static_cast<std::int32_t>(message.points.size());
  return message;
}

TEST(KeypointMessage, ComesBackAsItWas) {
  const KeypointView view{
      .camera = "cam1",
      .capture_ns = 123,
      .person = 2,
      .points = {{Landmark::kNose, {12.5f, 7}, 0.25f}, {Landmark::kHeelR, {-0.5f, 479.5f}, 1}}};
  keypoints_t message{};
  message.sender = "witness";
  FillKeypoints(view, message);
  ASSERT_TRUE(IsSound(message));
  const UsableKeypoints usable = UsableOf(message, SmallPicture());
  EXPECT_EQ(usable.dropped, 0);
  EXPECT_EQ(usable.view.camera, "cam1");
  EXPECT_EQ(usable.view.capture_ns, 123);
  EXPECT_EQ(usable.view.person, 2);
  ASSERT_EQ(usable.view.points.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(usable.view.points[i].landmark, view.points[i].landmark);
    EXPECT_EQ(usable.view.points[i].px, view.points[i].px);
    EXPECT_EQ(usable.view.points[i].score, view.points[i].score);
  }
}

TEST(KeypointMessage, UnderstandsNamesOfOthers) {
  const auto usable =
      UsableOf(MessageOf({{"left_hip", 1, 1, 1}, {"RAnkle", 2, 2, 1}}), SmallPicture());
  ASSERT_EQ(usable.view.points.size(), 2u);
  EXPECT_EQ(usable.view.points[0].landmark, Landmark::kHipL);
  EXPECT_EQ(usable.view.points[1].landmark, Landmark::kAnkleR);
}

/// All that stands in backquotes.
std::vector<std::string> NamesIn(const std::string& text) {
  static const std::regex kName("`([^`]+)`");
  std::vector<std::string> names;
  for (std::sregex_iterator each(text.begin(), text.end(), kName), end; each != end; ++each)
    names.push_back((*each)[1]);
  return names;
}

TEST(KeypointMessage, ClientsAreToldTheNamesOfEachLandmark) {
  std::istringstream lines(
      testing::ReadText(std::filesystem::path(MOCAP_SOURCE_DIR) / "docs/clients.md"));
  std::string line;
  while (std::getline(lines, line) && !line.starts_with("| name | where | COCO-17")) continue;
  std::getline(lines, line);
  int landmarks = 0, others = 0;
  while (std::getline(lines, line) && line.starts_with("| `")) {
    const std::size_t end = line.find(" | ");
    const std::vector<std::string> ours = NamesIn(line.substr(0, end));
    for (const std::string& name : ours)
      EXPECT_EQ(NameOf(static_cast<Landmark>(landmarks++)), name);
    const std::vector<std::string> theirs = NamesIn(line.substr(end));
    for (std::size_t i = 0; i < theirs.size(); ++i, ++others)
      EXPECT_EQ(LandmarkNamed(theirs[i]), LandmarkNamed(ours[i % ours.size()])) << theirs[i];
  }
  EXPECT_EQ(landmarks, kLandmarkCount);
  EXPECT_EQ(others, 17 + 26 + 33 - 6) << "BlazePose has six without a place";
}

TEST(KeypointMessage, HostilePointsAreDroppedAndCounted) {
  const std::vector<keypoint_t> hostile = {
      {"tail", 1, 1, 1},          {"", 1, 1, 1},
      {"nose", kNan, 1, 1},       {"nose", 1, kInfinity, 1},
      {"nose", 1, 1, kNan},       {"nose", 1, 1, 1.01},
      {"nose", 1, 1, -0.01},      {"nose", 640, 1, 1},
      {"nose", 1, -1, 1},         {"nose", 1e300, 1, 1},
      {"neck", -kInfinity, 1, 1}, {std::string(1000, 'n'), 1, 1, 1}};
  for (const keypoint_t& point : hostile) {
    const auto usable = UsableOf(MessageOf({point, {"hip_l", 3, 3, 0}}), SmallPicture());
    EXPECT_EQ(usable.dropped, 1) << point.name << point.x_px;
    EXPECT_EQ(usable.view.points.size(), 1u);
  }
}

TEST(KeypointMessage, OfTwoOfTheSameNameTheFirstIsTaken) {
  const auto usable = UsableOf(MessageOf({{"nose", 1, 1, 0.1}, {"Nose", 2, 2, 1}}), SmallPicture());
  EXPECT_EQ(usable.dropped, 1);
  ASSERT_EQ(usable.view.points.size(), 1u);
  EXPECT_EQ(usable.view.points[0].px.x(), 1);
}

TEST(KeypointMessage, ImplausibleOnesAreNotSound) {
  EXPECT_TRUE(IsSound(MessageOf({})));
  EXPECT_FALSE(IsSound(MessageOf(std::vector<keypoint_t>(kMostKeypoints + 1))));
  const auto with = [](auto change) {
    keypoints_t message = MessageOf({});
    change(message);
    return message;
  };
  EXPECT_FALSE(IsSound(with([](auto& message) { message.version = 2; })));
  EXPECT_FALSE(IsSound(with([](auto& message) { message.sender.clear(); })));
  EXPECT_FALSE(IsSound(with([](auto& message) { message.person = -1; })));
  EXPECT_FALSE(IsSound(with([](auto& message) { message.capture_ns = -1; })));
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  EXPECT_FALSE(IsSound(with([](auto& message) { message.capture_ns = kLast; })));
}

}  // namespace
}  // namespace mocap
