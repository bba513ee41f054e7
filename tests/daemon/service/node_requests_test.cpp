#include "daemon/service/node_requests.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/errors.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::chrono::seconds kPatience{20};

/// A node that answers so, and names what it was asked.
StudioNode NodeThatSays(const std::string& name, const std::string& outcome) {
  return {
      name, {}, {"/bin/sh", "-c", "read -r words; printf '" + outcome + "\\n%s\\n' \"$words\""}};
}

NodeRequests::Answers Ask(const std::vector<StudioNode>& nodes) {
  return NodeRequests(nodes).Ask("record start walk", kPatience).Wait();
}

TEST(NodeRequests, AskEveryNodeAndTellWhatEachSaid) {
  const NodeRequests::Answers answers =
      Ask({NodeThatSays("left", "done"), NodeThatSays("right", "done")});
  EXPECT_THAT(answers.Problem(), IsEmpty());
  EXPECT_EQ(answers.Text(), "node left: record start walk\nnode right: record start walk\n");
}

TEST(NodeRequests, OneThatFailsIsNamedWithItsWords) {
  const NodeRequests::Answers answers =
      Ask({NodeThatSays("left", "done"), NodeThatSays("right", "failed")});
  EXPECT_EQ(answers.Problem(), "node right: record start walk");
}

TEST(NodeRequests, OneThatCannotBeReachedIsNamed) {
  EXPECT_THAT(Ask({{"left", {}, {"/bin/false"}}}).Problem(), HasSubstr("node left: "));
  EXPECT_THAT(Ask({NodeThatSays("left", "done"), {"right", {}, {}}}).Problem(),
              AllOf(HasSubstr("node right: "), HasSubstr("no control command")));
}

/// What is said of a failure.
std::string FailureOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST(NodeRequests, EachComputerThatDidItHasALineAndThoseThatFailedAreNamedInTheLast) {
  const auto stop = [](const std::vector<StudioNode>& nodes,
                       const std::function<std::string()>& here) {
    return DoEverywhere(NodeRequests(nodes).Ask("record stop", kPatience), here);
  };
  const auto done = [] { return std::string("takes/walk: 4 s\n"); };
  const auto fail = []() -> std::string { throw std::runtime_error("disk full"); };
  EXPECT_EQ(stop({NodeThatSays("left", "done")}, done),
            "takes/walk: 4 s\nnode left: record stop\n");
  const std::vector<StudioNode> three = {
      NodeThatSays("left", "done"), NodeThatSays("right", "failed"), NodeThatSays("top", "wrong")};
  EXPECT_EQ(
      FailureOf([&] { stop(three, done); }),
      "takes/walk: 4 s\nnode left: record stop\nnode right: record stop; node top: record stop");
  EXPECT_EQ(
      FailureOf([&] { stop(three, fail); }),
      "node left: record stop\nstudio: disk full; node right: record stop; node top: record stop");
  EXPECT_EQ(FailureOf([&] { stop({}, fail); }), "disk full");
}

TEST(NodeRequests, AWrongFileAtTheStudioIsStillWrongInput) {
  EXPECT_THROW(DoEverywhere(NodeRequests({NodeThatSays("left", "done")}).Ask("reload", kPatience),
                            []() -> std::string { throw SetupError("wrong file"); }),
               SetupError);
}

TEST(NodeRequests, OnlyThoseThatDidItAreAskedToUndoIt) {
  const NodeRequests nodes({NodeThatSays("left", "done"), NodeThatSays("right", "failed")});
  const NodeRequests::Answers before = nodes.Ask("record start walk", kPatience).Wait();
  EXPECT_EQ(nodes.AskWhoDid(before, "record cancel walk", kPatience).Wait().Text(),
            "node left: record cancel walk\n");
}

TEST(NodeRequests, NothingIsRecordedOnlyWhereAllHaveCanceled) {
  const auto cancel = [](const std::string& right, const std::function<void()>& here) {
    return CancelTake(NodeRequests({NodeThatSays("left", "done"), NodeThatSays("right", right)})
                          .Ask("record cancel walk", kPatience),
                      here);
  };
  EXPECT_EQ(cancel("done", [] {}), "nothing is recorded");
  EXPECT_EQ(cancel("wrong", [] {}),
            "a part of the take may be left, as not all could cancel it; node right: record cancel "
            "walk");
  const auto ended = [] { throw std::runtime_error("no take walk is being recorded"); };
  EXPECT_EQ(cancel("failed", ended),
            "a part of the take may be left, as not all could cancel it; studio: no take walk is "
            "being recorded; node right: record cancel walk");
}

TEST(NodeRequests, WithoutNodesAllHaveDoneIt) {
  EXPECT_TRUE(NodeRequests({}).empty());
  EXPECT_THAT(Ask({}).Problem(), IsEmpty());
  EXPECT_THAT(Ask({}).Text(), IsEmpty());
}

}  // namespace
}  // namespace mocap
