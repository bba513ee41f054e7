#include "tools/export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "tests/support/moving_body.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tools/interchange/export_format.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;
using testing::ReadText;
using testing::SetupErrorOf;
using ::testing::StartsWith;
using testing::SwingingResult;
using testing::TemporaryFolder;

class Export : public ::testing::Test {
 protected:
  void Run(const std::string& result, const std::string& format, const std::string& out) {
    CLI::App app;
    AddExportCommand(app);
    app.parse("export " + Path(result) + " --format " + format + " --out " + Path(out));
  }
  std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::set<std::string> Files(const std::string& folder) const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(Path(folder))) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }

  TemporaryFolder folder_;
};

TEST_F(Export, EveryFormatWritesOverItsOwnFilesAndNoOthers) {
  WriteResult(Path("result"), SwingingResult(5));
  for (const ExportFormat& format : ExportFormats()) {
    const std::string name(format.name);
    Run("result", name, "walk." + name);
    EXPECT_THAT(ReadText(Path("walk." + name)), StartsWith(std::string(format.beginning)));
    Run("result", name, "walk." + name);
    testing::WriteText(Path("mine." + name), "of somebody else");
    EXPECT_THAT(SetupErrorOf([&] { Run("result", name, "mine." + name); }), HasSubstr("mine"));
    EXPECT_EQ(ReadText(Path("mine." + name)), "of somebody else");
  }
}

TEST_F(Export, AFileWithAnothersSuffixIsTold) {
  WriteResult(Path("result"), SwingingResult(2));
  EXPECT_THAT(SetupErrorOf([&] { Run("result", "c3d", "walk.bvh"); }),
              HasSubstr("walk.bvh: does not end in .c3d"));
  EXPECT_THAT(SetupErrorOf([&] { Run("result", "c3d", "walk"); }), HasSubstr("does not end in"));
  ::testing::internal::CaptureStdout();
  Run("result", "c3d", "WALK.C3D");
  EXPECT_THAT(::testing::internal::GetCapturedStdout(), HasSubstr("WALK.C3D\n"));
}

TEST_F(Export, SeveralPeopleHaveAFileEachAndOneOfAllWhereTheFormatHoldsThem) {
  Result late = SwingingResult(5);
  late.poses.erase(late.poses.begin(), late.poses.begin() + 2);
  std::filesystem::create_directory(Path("result"));
  WritePeople(Path("result"), {{1, SwingingResult(5)}, {2, late}});
  for (const ExportFormat& format : ExportFormats()) {
    const std::string name(format.name);
    std::filesystem::create_directory(Path(name));
    ::testing::internal::CaptureStdout();
    Run("result", name, name + "/walk." + name);
    const std::string said = ::testing::internal::GetCapturedStdout();
    std::set<std::string> wanted = {"walk-person-1." + name, "walk-person-2." + name};
    if (format.holds_everybody) wanted.insert("walk." + name);
    EXPECT_EQ(Files(name), wanted);
    for (const std::string& file : wanted) EXPECT_THAT(said, HasSubstr(file));
  }
}

TEST_F(Export, AnEarlierExportBesideTheNewOneIsRemovedOrTold) {
  WriteResult(Path("one"), SwingingResult(5));
  std::filesystem::create_directory(Path("many"));
  WritePeople(Path("many"), {{1, SwingingResult(5)}, {3, SwingingResult(5)}});
  std::filesystem::create_directory(Path("fewer"));
  WritePeople(Path("fewer"), {{1, SwingingResult(5)}});
  for (const ExportFormat& format : ExportFormats()) {
    const std::string name(format.name);
    const std::string out = name + "/walk." + name;
    std::filesystem::create_directory(Path(name));
    // Of others, whatever their names are.
    const std::set<std::string> kept = {"walk-person-2." + name, "walk-anna." + name,
                                        "run-person-1." + name, "walk-person-1.txt"};
    testing::WriteText(Path(name + "/walk-person-2." + name), "of somebody else");
    for (const char* file : {"/walk-anna.", "/run-person-1."}) {
      testing::WriteText(Path(name + file + name), std::string(format.beginning));
    }
    testing::WriteText(Path(name + "/walk-person-1.txt"), std::string(format.beginning));
    const auto expect_beside_kept = [&](std::set<std::string> wanted) {
      wanted.insert(kept.begin(), kept.end());
      EXPECT_EQ(Files(name), wanted);
    };
    ::testing::internal::CaptureStdout();
    Run("one", name, out);
    expect_beside_kept({"walk." + name});
    ::testing::internal::CaptureStderr();
    Run("many", name, out);
    std::set<std::string> of_many = {"walk-person-1." + name, "walk-person-3." + name};
    if (format.holds_everybody) of_many.insert("walk." + name);
    expect_beside_kept(of_many);
    Run("fewer", name, out);
    of_many.erase("walk-person-3." + name);
    expect_beside_kept(of_many);
    EXPECT_THAT(::testing::internal::GetCapturedStderr(),
                HasSubstr("walk-person-3." + name + ": removed, an earlier export"));
    ::testing::internal::CaptureStderr();
    Run("one", name, out);
    EXPECT_THAT(::testing::internal::GetCapturedStderr(),
                HasSubstr("walk-person-1." + name + ": was not written now"));
    expect_beside_kept({"walk." + name, "walk-person-1." + name});
    ::testing::internal::GetCapturedStdout();
  }
}

TEST_F(Export, OnlyBvhHasAChoiceOfSkeletons) {
  WriteResult(Path("result"), SwingingResult(5));
  const auto run = [&](const std::string& format, const std::string& skeleton) {
    CLI::App app;
    AddExportCommand(app);
    app.parse("export " + Path("result") + " --format " + format + " --skeleton " + skeleton +
              " --out " + Path("walk." + format));
  };
  run("bvh", "lafan1");
  EXPECT_THAT(ReadText(Path("walk.bvh")), HasSubstr("JOINT Spine2"));
  run("bvh", "mocapd");
  EXPECT_THAT(ReadText(Path("walk.bvh")), ::testing::Not(HasSubstr("Spine2")));
  EXPECT_THROW(run("bvh", "mixamo"), CLI::ValidationError);
  EXPECT_THAT(SetupErrorOf([&] { run("glb", "lafan1"); }),
              HasSubstr("--skeleton: glb has no choice of skeletons"));
}

TEST_F(Export, TheHelpTellsWhatEachFormatIsFor) {
  CLI::App app;
  AddExportCommand(app);
  const std::string help = app.get_subcommand("export")->help();
  for (const ExportFormat& format : ExportFormats()) {
    EXPECT_THAT(help, HasSubstr(std::string(format.purpose)));
  }
}

}  // namespace
}  // namespace mocap
