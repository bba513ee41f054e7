#include "tools/commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <new>
#include <string>
#include <vector>

#include "daemon/base/number_option.h"
#include "daemon/run_program.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// What a command line that is wrong is answered with.
std::string Refusal(const std::string& arguments) {
  CLI::App app("", "mocap");
  AddCommands(app);
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Commands, HelpWritesBoundsInOneWay) {
  CLI::App app("", "mocap");
  AddCommands(app);
  const std::string help = app.help("", CLI::AppFormatMode::All);
  EXPECT_THAT(help, AllOf(HasSubstr("from 1 to "), Not(HasSubstr(" in ["))));
}

TEST(Commands, NumbersThatCannotBeAreToldShortAndPlain) {
  const char* wrong[] = {"0", "-1", "-0", "1e300", "-1e300", "nan", "inf", "abc", "1.5.5"};
  const char* options[] = {"simulate --out x --seconds",
                           "simulate --out x --fps",
                           "simulate --out x --stature",
                           "simulate --out x --width",
                           "simulate --out x --cameras",
                           "simulate --out x --people",
                           "track x --out y --voxel-size",
                           "benchmark --seconds",
                           "benchmark --seeds",
                           "benchmark --statures",
                           "cameras --seconds",
                           "watch --seconds",
                           "stream json --rate",
                           "stream osc --person",
                           "background learn --config x --seconds"};
  for (const char* option : options) {
    for (const char* number : wrong) {
      const std::string said = Refusal(std::string(option) + " " + number);
      EXPECT_THAT(said, Not(HasSubstr("accepted"))) << option << ' ' << number;
      EXPECT_LT(said.size(), 140u) << said;
    }
  }
  EXPECT_EQ(Refusal("watch --seconds 0"),
            "--seconds: 0 is out of range; expected a number from 0.001 to 100000000");
}

/// What the whole program says of a command line, on standard error.
std::string SaidOf(const std::vector<const char*>& words) {
  CLI::App app("", "mocap");
  app.require_subcommand(1);
  AddCommands(app);
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(RunProgram(app, static_cast<int>(words.size()), const_cast<char**>(words.data())), 2);
  return ::testing::internal::GetCapturedStderr();
}

TEST(Commands, AMisspeltWordIsToldWithTheOneThatItResembles) {
  EXPECT_THAT(SaidOf({"mocap", "evalute", "take", "result"}),
              AllOf(StartsWith("mocap: there is no command \"evalute\"; did you mean evaluate? "
                               "Expected one of simulate, take"),
                    EndsWith("see mocap --help\n")));
  EXPECT_THAT(SaidOf({"mocap", "take", "jion"}),
              StartsWith("mocap: there is no command \"jion\"; did you mean join? Expected one of "
                         "join, import; see"));
  EXPECT_EQ(
      SaidOf({"mocap", "track", "--voxle", "3"}),
      "mocap: there is no option --voxle; did you mean --voxel-size? See mocap track --help\n");
  EXPECT_THAT(SaidOf({"mocap", "record", "start", "--coment=x"}), HasSubstr("--coment"));
  EXPECT_THAT(SaidOf({"mocap", "export", "r", "--format", "bhv", "--out", "x"}),
              HasSubstr("--format: \"bhv\" is unknown; did you mean bvh? Expected one of bvh"));
  EXPECT_THAT(SaidOf({"mocap", "track", "t", "--out", "r", "--tracker", "mikic"}),
              HasSubstr("did you mean mikic2003?"));
  EXPECT_THAT(SaidOf({"mocap", "simulate", "--out", "x", "--board", "dsek"}),
              HasSubstr("did you mean desk?"));
}

TEST(Commands, AMissingCommandIsToldWithThoseThatThereAre) {
  EXPECT_THAT(SaidOf({"mocap"}),
              StartsWith("mocap: a command is missing; expected one of simulate, take"));
  EXPECT_THAT(SaidOf({"mocap", "subject"}),
              AllOf(HasSubstr("a command is missing"), EndsWith("see mocap subject --help\n")));
  EXPECT_EQ(SaidOf({"mocap", "track", "take", "other", "--out", "r"}),
            "mocap: \"other\" was not expected; see mocap track --help\n");
}

/// Runs a program that fails and gives what it says on standard error.
template <typename Body>
std::pair<int, std::string> Ended(Body body) {
  CLI::App app("", "mocap");
  app.callback(body);
  const char* arguments[] = {"mocap"};
  ::testing::internal::CaptureStderr();
  const int status = RunProgram(app, 1, const_cast<char**>(arguments));
  return {status, ::testing::internal::GetCapturedStderr()};
}

TEST(RunProgram, WantOfMemoryIsTold) {
  const auto [status, said] = Ended([] { throw std::bad_alloc(); });
  EXPECT_EQ(status, 1);
  EXPECT_THAT(said,
              AllOf(StartsWith("mocap: there is not enough memory"), HasSubstr("use smaller")));
}

TEST(RunProgram, AnErrorIsOneLineWhateverItQuotes) {
  const auto [status, said] =
      Ended([] { throw std::runtime_error("x\x1b[2J\r\nmocap: error: forged"); });
  EXPECT_EQ(status, 1);
  EXPECT_THAT(said, AllOf(EndsWith("forged\n"), Not(HasSubstr("\x1b")), Not(HasSubstr("\nmocap"))));
}

}  // namespace
}  // namespace mocap
