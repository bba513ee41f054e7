// A take served over the network by processes of their own, one of which dies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "config/load_config.h"
#include "core/errors.h"
#include "drivers/aravis/aravis_driver.h"
#include "tests/support/images.h"
#include "tests/support/private_network.h"
#include "tests/support/run_command.h"
#include "tests/support/setup_error.h"
#include "tests/support/small_take.h"
#include "tests/support/temporary_folder.h"
#include "tools/gige_studio.h"

extern char** environ;

namespace mocap {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using ::testing::HasSubstr;
using testing::SmallTake;

constexpr std::chrono::seconds kPatience{20};

[[maybe_unused]] const bool kNetworkIsEntered = testing::EnterPrivateNetwork().empty();

/// A run of `mocap gige-studio` whose lines can be read.
class ServedStudio {
 public:
  explicit ServedStudio(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "gige-studio");
    arguments.insert(arguments.begin(), MOCAP_BIN_DIR "/mocap");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    std::array<int, 2> ends{};
    MOCAP_CHECK(pipe(ends.data()) == 0);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addclose(&actions, ends[0]);
    MOCAP_CHECK(posix_spawn(&process_, argv[0], &actions, nullptr, argv.data(), environ) == 0);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    lines_ = fdopen(ends[0], "r");
  }
  ~ServedStudio() {
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
    std::fclose(lines_);
  }
  ServedStudio(const ServedStudio&) = delete;
  ServedStudio& operator=(const ServedStudio&) = delete;

  std::string Line() {
    std::array<char, 256> text{};
    return std::fgets(text.data(), text.size(), lines_) ? text.data() : "";
  }

 private:
  pid_t process_ = 0;
  FILE* lines_ = nullptr;
};

struct Serving {
  std::string name;
  pid_t process = 0;
};

/// Reads on to the next camera that serves.
Serving NextServing(ServedStudio& studio) {
  for (std::string line = studio.Line(); !line.empty(); line = studio.Line()) {
    const std::size_t at = line.find("process ");
    if (at == std::string::npos) continue;
    return {line.substr(0, line.find(' ')), std::stoi(line.substr(at + 8))};
  }
  ADD_FAILURE() << "no camera is served";
  return {};
}

bool GrabUntil(AravisDriver& driver, GrabStatus wanted, Frame& frame) {
  const auto deadline = steady_clock::now() + kPatience;
  while (steady_clock::now() < deadline) {
    if (driver.Grab(frame, milliseconds(50)) == wanted) return true;
  }
  return false;
}

/// Which frame of the take a picture is; -1: none.
int FrameOf(const SmallTake& take, int camera, ImageView<const Bgr> picture) {
  for (int i = 0; i < take.frames; ++i) {
    if (testing::SamePixels<Bgr>(picture, testing::SmallPicture(take, camera, i).view())) return i;
  }
  return -1;
}

TEST(GigeStudio, ServesATakeToTheBitAndCamerasThatDieReturn) {
  const std::string reason = testing::EnterPrivateNetwork();
  if (!reason.empty()) GTEST_SKIP() << reason;
  const testing::TemporaryFolder folder;
  const SmallTake take;
  testing::WriteSmallTake(folder.path() / "take", take);
  const std::string config_file = folder.path() / "mocapd.toml";
  ServedStudio studio({folder.path() / "take", "--config", config_file, "--return-after", "0.2"});
  std::vector<pid_t> processes(take.cameras);
  for (int i = 0; i < take.cameras; ++i) {
    const Serving serving = NextServing(studio);
    ASSERT_THAT(serving.name, HasSubstr("cam"));
    processes[serving.name.back() - '1'] = serving.process;
  }

  EXPECT_THAT(testing::SetupErrorOf([&] {
                testing::RunCommand(AddGigeStudioCommand,
                                    "gige-studio " + (folder.path() / "take").string());
              }),
              HasSubstr("127.0.0.11: a camera is served there already"));

  const Config config = LoadConfig(config_file);
  std::vector<std::unique_ptr<AravisDriver>> drivers;
  for (const CameraConfig& camera : config.cameras) {
    drivers.push_back(std::make_unique<AravisDriver>(
        CameraRequest{camera.device, take.width_px, take.height_px, 25}, camera.aravis));
    drivers.back()->Start();
  }
  Frame frame;
  for (int i = 0; i < take.cameras; ++i) {
    int seen = -1;
    const auto deadline = steady_clock::now() + kPatience;
    while (seen < 0 && steady_clock::now() < deadline) {
      if (drivers[i]->Grab(frame, milliseconds(50)) == GrabStatus::kFrame) {
        seen = FrameOf(take, i, frame.image);
      }
    }
    EXPECT_GE(seen, 0) << i;
  }

  ASSERT_EQ(kill(processes[1], SIGKILL), 0);
  EXPECT_TRUE(GrabUntil(*drivers[1], GrabStatus::kLost, frame));
  EXPECT_TRUE(GrabUntil(*drivers[0], GrabStatus::kFrame, frame));
  EXPECT_TRUE(GrabUntil(*drivers[1], GrabStatus::kFrame, frame));
  EXPECT_GE(FrameOf(take, 1, frame.image), 0);
  EXPECT_EQ(NextServing(studio).name, "cam2");
}

}  // namespace
}  // namespace mocap
