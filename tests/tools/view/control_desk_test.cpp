#include "tools/view/control_desk.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "daemon/control/control_socket.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::mocap::testing::TemporaryFolder;

/// A daemon that keeps what it was asked, and a desk before it.
class ControlDeskTest : public ::testing::Test {
 protected:
  ViewReply Post(const std::string& body, const std::string& authorization = "Bearer secret") {
    return desk_.Answer({.method = "POST",
                         .path = "/control",
                         .query = {},
                         .authorization = authorization,
                         .body = body});
  }
  static std::string Outcome(const ViewReply& reply) {
    return nlohmann::json::parse(reply.body)["outcome"];
  }

  TemporaryFolder folder_;
  const std::filesystem::path socket_ = folder_.path() / "control";
  std::vector<std::string> names_;
  int looks_ = 0;
  ControlServer server_{socket_, [this](const ControlRequest& request) {
                          if (const auto* start = std::get_if<RecordStartRequest>(&request)) {
                            names_.push_back(start->name);
                          }
                          looks_ += std::holds_alternative<LookRequest>(request) ? 1 : 0;
                          return ControlReply{ControlOutcome::kDone, "recording\n"};
                        }};
  ControlDesk desk_{socket_, "secret"};
};

TEST_F(ControlDeskTest, WhoHoldsTheTokenReachesTheDaemon) {
  const ViewReply reply = Post(R"({"request": "record start walk-01"})");
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(Outcome(reply), "done");
  EXPECT_EQ(names_, std::vector<std::string>{"walk-01"});
}

TEST_F(ControlDeskTest, WithoutTheTokenNothingIsPassedOn) {
  for (const char* authorization : {"", "secret", "Bearer secre", "Bearer wrong"}) {
    EXPECT_EQ(Post(R"({"request": "record start walk-01"})", authorization).status, 401);
  }
  EXPECT_TRUE(names_.empty());
}

TEST_F(ControlDeskTest, OnlyWhatAPersonDoesIsPassedOn) {
  for (const char* body :
       {R"({"request": "status json"})", R"({"request": "look"})", R"({"request": "dance"})",
        R"({"request": "record start ../../etc/passwd"})", R"({"request": 7})", R"(["reload"])",
        "{", ""}) {
    EXPECT_EQ(Post(body).status, 400) << body;
  }
  EXPECT_TRUE(names_.empty());
  EXPECT_EQ(looks_, 0);
}

TEST_F(ControlDeskTest, TellsWhetherATokenHolds) {
  const auto status = [this](const std::string& authorization) {
    return desk_
        .Answer({.method = "GET",
                 .path = "/control",
                 .query = {},
                 .authorization = authorization,
                 .body = {}})
        .status;
  };
  EXPECT_EQ(status("Bearer secret"), 204);
  EXPECT_EQ(status("Bearer other"), 401);
}

TEST_F(ControlDeskTest, AsksForPictures) {
  EXPECT_EQ(desk_.Look(), "");
  EXPECT_EQ(looks_, 1);
}

TEST(ControlDesk, WithoutADaemonThePageIsToldWhy) {
  const TemporaryFolder folder;
  const ControlDesk desk(folder.path() / "control", "secret");
  EXPECT_NE(desk.Look().find("nothing answers at " + folder.path().string()), std::string::npos);
}

}  // namespace
}  // namespace mocap
