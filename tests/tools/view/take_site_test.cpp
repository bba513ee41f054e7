#include "tools/view/take_site.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "tests/support/box_take.h"
#include "tests/support/temporary_folder.h"
#include "tests/tools/view/number_at.h"

namespace mocap {
namespace {

using ::mocap::testing::kFirstNs;
using ::mocap::testing::kFrames;
using ::mocap::testing::kPeriodNs;

/// Where the message of a picture ends that begins at `at`.
std::size_t EndOfPicture(const std::string& bytes, std::size_t at) {
  const std::size_t floats = testing::NumberAt<std::uint32_t>(bytes, at + 16) +
                             testing::NumberAt<std::uint32_t>(bytes, at + 20);
  return at + (32 + 4 * floats + testing::NumberAt<std::uint32_t>(bytes, at + 24) + 7) / 8 * 8;
}

/// Where each message of /pictures.bin begins, if there are only pictures.
std::vector<std::size_t> PicturesIn(const std::string& bytes) {
  std::vector<std::size_t> begins;
  for (std::size_t at = 0; at + 32 <= bytes.size() && bytes[at] == 3;) {
    begins.push_back(at);
    at = EndOfPicture(bytes, at);
  }
  return begins;
}

class TakeSiteTest : public ::testing::Test {
 protected:
  TakeSiteTest() {
    testing::WriteBoxTake(take_);
    testing::WriteBoxResult(result_);
  }
  static std::string Get(TakeSite& site, const std::string& path,
                         std::map<std::string, std::string> query = {}) {
    const ViewReply reply = site.Answer({.method = "GET",
                                         .path = path,
                                         .query = std::move(query),
                                         .authorization = {},
                                         .body = {}});
    EXPECT_EQ(reply.status, 200) << path;
    return reply.body;
  }

  const testing::TemporaryFolder folder_;
  const std::filesystem::path take_ = folder_.path() / "take", result_ = folder_.path() / "result";
};

TEST_F(TakeSiteTest, TellsFramesStatesAndErrors) {
  TakeSite site(take_, {result_});
  const auto json = nlohmann::json::parse(Get(site, "/take.json"));
  EXPECT_EQ(json["name"], "<box>");
  EXPECT_EQ(json["times_ms"].size(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(json["studio"]["cameras"].size(), 3u);
  const auto& result = json["results"][0];
  EXPECT_EQ(result["name"], "result");
  EXPECT_EQ(result["states"][1], 1);
  EXPECT_TRUE(result["error_mm"][1].is_null()) << "it was not tracked yet";
  EXPECT_NEAR(result["error_mm"][5], 12, 1e-6);
  EXPECT_NEAR(result["joint_error_mm"][3][5], 12, 1e-6);
  EXPECT_TRUE(result["events"].empty()) << "of a result without feet";
}

TEST_F(TakeSiteTest, TellsHowSureEachPoseIs) {
  Result written = ReadResult(result_);
  written.poses[5].probability = 0.6;
  WriteResult(result_, written);
  TakeSite site(take_, {result_});
  const auto json = nlohmann::json::parse(Get(site, "/take.json"));
  EXPECT_EQ(json["results"][0]["probability"][5], 0.6);
  EXPECT_TRUE(json["results"][0]["probability"][6].is_null());
  const std::string pose =
      Get(site, "/poses.bin", {{"result", "0"}, {"from", "5"}, {"count", "1"}});
  EXPECT_EQ(testing::NumberAt<float>(pose, 320), 0.6f);
}

TEST_F(TakeSiteTest, TellsStepsAtTheirTimes) {
  Result written = ReadResult(result_);
  const PoseRow last = written.poses.back();
  for (int i = 1; i <= kFrames; ++i) {
    PoseRow& row = written.poses.emplace_back(last);
    row.frame += i;
    row.timestamp_ns += i * kPeriodNs;
  }
  for (PoseRow& row : written.poses) {
    row.further_W.setZero();
    row.contacts.setZero();
    if (row.frame >= 30) row.contacts[1] = 1;
  }
  WriteResult(result_, written);
  TakeSite site(take_, {result_});
  const auto events = nlohmann::json::parse(Get(site, "/take.json"))["results"][0]["events"];
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0]["side"], "right");
  EXPECT_EQ(events[0]["event"], "Foot Strike");
  EXPECT_NEAR(events[0]["time_ms"], 1e-6 * (kFirstNs + 29.5 * kPeriodNs), 1e-3);
}

TEST_F(TakeSiteTest, GivesPosesOfResultAndTruth) {
  TakeSite site(take_, {result_});
  const std::string poses =
      Get(site, "/poses.bin", {{"result", "0"}, {"from", "4"}, {"count", "3"}});
  // A result without all sizes has no capsules.
  ASSERT_EQ(poses.size(), 3u * 392);
  EXPECT_EQ(testing::NumberAt<double>(poses, 392 + 24), 5);
  const std::string truth =
      Get(site, "/poses.bin", {{"truth", "0"}, {"from", "4"}, {"count", "1"}});
  ASSERT_EQ(truth.size(), 392u);
  const std::size_t head_z = 40 + 1 * 12 + 8;
  EXPECT_NEAR(testing::NumberAt<float>(poses, head_z) - testing::NumberAt<float>(truth, head_z), 12,
              1e-3);
}

TEST_F(TakeSiteTest, GivesThePictureOfEachCameraThatHasTheFrame) {
  TakeSite site(take_, {result_});
  const std::string all = Get(site, "/pictures.bin", {{"frame", "3"}, {"result", "0"}});
  ASSERT_EQ(PicturesIn(all).size(), 3u);
  EXPECT_EQ(testing::NumberAt<double>(all, 8), (testing::kFirstNs + 3 * testing::kPeriodNs) / 1e6);
  const std::string late = Get(site, "/pictures.bin", {{"frame", "15"}, {"result", "0"}});
  EXPECT_EQ(PicturesIn(late).size(), 2u) << "the camera in the west missed it";
  EXPECT_EQ(
      testing::NumberAt<double>(Get(site, "/pictures.bin", {{"frame", "3"}, {"result", "0"}}), 8),
      testing::NumberAt<double>(all, 8))
      << "going back";
}

TEST_F(TakeSiteTest, KeypointsFollowThePicturesOfTheirCamera) {
  const std::string camera = TakePictures(take_).cameras()[1].name;
  std::ofstream(take_ / "keypoints.csv")
      << "camera,timestamp_ns,person,name,x_px,y_px,score\n"
      << camera << ',' << kFirstNs + 5 * kPeriodNs << ",1,nose,10,20,0.5\n"
      << "elsewhere," << kFirstNs + 5 * kPeriodNs << ",1,nose,10,20,0.5\n";
  TakeSite site(take_, {});
  const auto views = [&site](const std::string& frame) {
    const std::string bytes = Get(site, "/pictures.bin", {{"frame", frame}});
    std::vector<std::size_t> cameras;
    for (std::size_t at = 0; at < bytes.size() && bytes[at] != 2;) {
      if (bytes[at] == 4) cameras.push_back(static_cast<std::size_t>(bytes[at + 1]));
      at = bytes[at] == 4 ? at + 32 : EndOfPicture(bytes, at);
    }
    return cameras;
  };
  EXPECT_TRUE(views("4").empty()) << "they are of a later moment";
  EXPECT_EQ(views("5"), std::vector<std::size_t>{1});
  EXPECT_EQ(views("14"), std::vector<std::size_t>{1}) << "they have not faded yet";
  EXPECT_TRUE(views("16").empty());
}

TEST_F(TakeSiteTest, KeypointsThatCannotBeReadAreRefused) {
  std::ofstream(take_ / "keypoints.csv") << "nose\n";
  EXPECT_THROW(TakeSite(take_, {}), SetupError);
}

TEST_F(TakeSiteTest, SilhouettesAndVoxelsComeOnceTheEmptyStudioIsLearned) {
  TakeSite site(take_, {});
  // It is learned in threads of their own, and no answer waits for them.
  const auto has_voxels = [](const std::string& bytes) {
    const std::size_t end = EndOfPicture(bytes, PicturesIn(bytes).back());
    return end < bytes.size() && bytes[end] == 2;
  };
  std::string bytes = Get(site, "/pictures.bin", {{"frame", "3"}, {"result", "0"}});
  while (!has_voxels(bytes)) bytes = Get(site, "/pictures.bin", {{"frame", "3"}, {"result", "0"}});
  EXPECT_GT(testing::NumberAt<std::uint32_t>(bytes, 16), 0u) << "the silhouette's line";
  EXPECT_GE(testing::NumberAt<float>(bytes, 28), 0) << "the share of unknown pixels";
}

TEST_F(TakeSiteTest, NumbersOfNothingAreRefused) {
  TakeSite site(take_, {result_});
  const auto status = [&site](const std::string& path, std::map<std::string, std::string> query) {
    return site
        .Answer({.method = "GET",
                 .path = path,
                 .query = std::move(query),
                 .authorization = {},
                 .body = {}})
        .status;
  };
  for (const char* frame : {"", "x", "-1", "3x", "20", "99999999999999999999"}) {
    EXPECT_EQ(status("/pictures.bin", {{"frame", frame}, {"result", "0"}}), 400) << frame;
  }
  EXPECT_EQ(status("/poses.bin", {{"from", "0"}, {"count", "1"}, {"result", "1"}}), 400);
  EXPECT_EQ(status("/poses.bin", {{"from", "0"}, {"count", "1"}, {"result", "../x"}}), 400);
  EXPECT_EQ(status("/poses.bin", {{"from", "0"}, {"result", "0"}}), 400);
}

TEST_F(TakeSiteTest, WithoutAResultTheTakeIsShown) {
  TakeSite site(take_, {});
  const auto json = nlohmann::json::parse(Get(site, "/take.json"));
  EXPECT_EQ(json["times_ms"].size(), static_cast<std::size_t>(kFrames));
  EXPECT_TRUE(json["results"].empty());
}

TEST_F(TakeSiteTest, PeopleOfOneResultCountOneByOne) {
  for (const char* person : {"person-1", "person-2"}) {
    testing::WriteBoxResult(folder_.path() / "many" / person);
  }
  TakeSite site(take_, {folder_.path() / "many"});
  const auto json = nlohmann::json::parse(Get(site, "/take.json"));
  ASSERT_EQ(json["results"].size(), 2u);
  EXPECT_EQ(json["results"][1]["name"], "many/person-2");
  EXPECT_EQ(json["results"][1]["person"], "person-2");
  EXPECT_EQ(json["results"][0]["group"], json["results"][1]["group"]);
}

TEST_F(TakeSiteTest, SeveralPeopleAreShownInTheTimesOfTheTake) {
  Result late = ReadResult(result_);
  late.poses.erase(late.poses.begin(), late.poses.begin() + 7);
  WritePeople(folder_.path() / "many", {{4, late}});
  TakeSite site(take_, {folder_.path() / "many"});
  const auto json = nlohmann::json::parse(Get(site, "/take.json"));
  EXPECT_EQ(json["times_ms"].size(), static_cast<std::size_t>(kFrames));
  EXPECT_TRUE(json["results"][0]["states"][6].is_null()) << "he was not there yet";
  EXPECT_EQ(json["results"][0]["states"][7], 2);
}

TEST_F(TakeSiteTest, EachTruePersonIsGivenAndWhoWasFollowedByWhom) {
  for (const char* file : {"truth.csv", "truth.toml"}) {
    for (const char* person : {"person-1", "person-2"}) {
      std::filesystem::create_directories(take_ / person);
      std::filesystem::copy(take_ / file, take_ / person / file);
    }
    std::filesystem::remove(take_ / file);
  }
  WritePeople(folder_.path() / "many", {{4, ReadResult(result_)}});
  TakeSite site(take_, {folder_.path() / "many"});
  const auto json = nlohmann::json::parse(Get(site, "/take.json"));
  EXPECT_EQ(json["truth"]["people"], (nlohmann::json{"person-1", "person-2"}));
  EXPECT_EQ(json["results"][0]["true_person"], 0);
  EXPECT_NEAR(json["results"][0]["error_mm"][5], 12, 1e-6);
  EXPECT_EQ(Get(site, "/poses.bin", {{"truth", "1"}, {"from", "4"}, {"count", "2"}}).size(),
            2u * 392);
  EXPECT_EQ(site.Answer({.method = "GET",
                         .path = "/poses.bin",
                         .query = {{"truth", "2"}, {"from", "0"}, {"count", "1"}},
                         .authorization = {},
                         .body = {}})
                .status,
            400);
}

TEST_F(TakeSiteTest, ATakeThatIsNotThereIsRefused) {
  EXPECT_THROW(TakeSite(folder_.path() / "absent", {}), SetupError);
  EXPECT_THROW(TakeSite(take_, {folder_.path() / "absent"}), SetupError);
}

}  // namespace
}  // namespace mocap
