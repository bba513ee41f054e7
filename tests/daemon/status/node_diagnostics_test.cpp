#include "daemon/status/node_diagnostics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t kMs = 1'000'000;
const std::string kUrl = "udpm://239.255.76.67:7667?ttl=1";

NodeReport GoodNode() {
  NodeReport node;
  node.name = "left";
  node.was_heard = true;
  node.silent_ns = 30 * kMs;
  node.version = MOCAP_VERSION;
  node.clock_apart_ns = kMs / 2;
  node.clock_keeper = "phc2sys";
  node.clock_is_kept = true;
  node.clock_error_ms = 0.02;
  node.received = 1000;
  return node;
}

std::vector<std::string> Told(const NodeReport& node, const std::string& url = kUrl) {
  return NodeDiagnostics({{node}, ""}, url);
}

TEST(NodeDiagnostics, HaveNothingToSayOfAGoodNode) { EXPECT_THAT(Told(GoodNode()), IsEmpty()); }

TEST(NodeDiagnostics, NameANodeThatIsSilent) {
  NodeReport node = GoodNode();
  node.silent_ns = 3'000 * kMs;
  EXPECT_THAT(Told(node),
              ElementsAre(HasSubstr("nothing has been received from node left for 3 s")));
  node.was_heard = false;
  EXPECT_THAT(Told(node), ElementsAre(HasSubstr("since the start")));
  EXPECT_THAT(Told(node, "udpm://239.255.76.67:7667?ttl=0"), ElementsAre(HasSubstr("ttl=0")));
  EXPECT_TRUE(IsOfLostNode({{node}, ""}, "left"));
}

TEST(NodeDiagnostics, NameAClockThatIsOff) {
  NodeReport node = GoodNode();
  node.clock_agrees = false;
  node.clock_apart_ns = 50 * kMs;
  EXPECT_THAT(Told(node),
              ElementsAre(HasSubstr("clock of node left is 50 ms behind the clock of this")));
  node.clock_apart_ns = -3'600'000 * kMs;
  EXPECT_THAT(Told(node), ElementsAre(HasSubstr("3600000 ms ahead of the clock of this")));
  EXPECT_TRUE(IsOfLostNode({{node}, ""}, "left"));
}

TEST(NodeDiagnostics, NameAClockThatNobodyKeeps) {
  NodeReport node = GoodNode();
  node.clock_is_kept = false;
  EXPECT_THAT(Told(node), ElementsAre(HasSubstr("nothing synchronizes the clock of node left")));
  node.has_this_clock = true;
  EXPECT_THAT(Told(node), IsEmpty()) << "it is the one here";
  node = GoodNode();
  node.clock_keeper = "systemd-timesyn";
  node.clock_error_ms = 80;
  EXPECT_THAT(Told(node), ElementsAre(HasSubstr("may be off by 80 ms")));
}

TEST(NodeDiagnostics, NameWhatDoesNotMatch) {
  NodeReport node = GoodNode();
  node.version = "0.0.1";
  node.is_of_this_version = false;
  node.miscalibrated = {"cam1", "cam2"};
  node.missing = {"cam3"};
  EXPECT_THAT(Told(node), ElementsAre(HasSubstr("node left runs mocapd 0.0.1"),
                                      HasSubstr("does not have cam3"), HasSubstr("cam1, cam2")));
}

TEST(NodeDiagnostics, NameWhatIsLostOnTheWay) {
  NodeReport node = GoodNode();
  node.lost_share = 0.02;
  EXPECT_THAT(Told(node), ElementsAre(HasSubstr("2.0 % of the silhouettes of node left are lost")));
}

TEST(NodeDiagnostics, PassOnWhatANodeSays) {
  NodeReport node = GoodNode();
  node.complaints = {"cam1 is lost: check its cable and power"};
  EXPECT_THAT(Told(node), ElementsAre("node left: cam1 is lost: check its cable and power"));
  EXPECT_FALSE(IsOfLostNode({{node}, ""}, "left"));
}

TEST(NodeDiagnostics, NameATakeThatTheStudioDoesNotRecord) {
  RecordingStatus recording;
  recording.state = RecordingStatus::State::kRunning;
  recording.folder = "/takes/walk.partial";
  recording.duration_ns = 60'000 * kMs;
  StudioLink link;
  link.unrecorded_ns = 20'000 * kMs;
  const std::string told =
      "the take walk is being recorded without the studio: end it with mocap record stop";
  EXPECT_THAT(LinkDiagnostics(link, {}, recording, kUrl), ElementsAre(told));
  link.silent_ns = 20'000 * kMs;
  EXPECT_THAT(LinkDiagnostics(link, {}, recording, kUrl),
              ElementsAre(HasSubstr("no studio has been heard"), told));
  link = {.unrecorded_ns = 1'000 * kMs};
  EXPECT_THAT(LinkDiagnostics(link, {}, recording, kUrl), IsEmpty()) << "the studio records it";
  link.unrecorded_ns = 20'000 * kMs;
  recording.duration_ns = 1'000 * kMs;
  EXPECT_THAT(LinkDiagnostics(link, {}, recording, kUrl), IsEmpty()) << "it has just begun";
  recording = {};
  EXPECT_THAT(LinkDiagnostics(link, {}, recording, kUrl), IsEmpty());
}

TEST(NodeDiagnostics, NameAStranger) {
  EXPECT_THAT(NodeDiagnostics({{}, "cam1 of node right"}, kUrl),
              ElementsAre(HasSubstr("cam1 of node right also sends to")));
}

}  // namespace
}  // namespace mocap
