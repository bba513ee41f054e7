// The driver on a camera that is pulled out of the kernel's own USB. tools/check_vm runs this in a
// machine that has it.
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "core/errors.h"
#include "drivers/v4l2/v4l2_driver.h"

namespace mocap::testing {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kGadgetTimeout{500};
constexpr std::chrono::seconds kGadgetPatience{60};
/// The kernel knows a camera by then, or will not.
constexpr std::chrono::seconds kPlugging{8};

/// A program that is a USB camera for as long as it runs.
class PluggedCamera {
 public:
  PluggedCamera(std::string program, std::string serial)
      : program_(std::move(program)), serial_(std::move(serial)) {
    Plug();
  }
  ~PluggedCamera() { PullOut(); }
  /// Plugs it in again when it ended by itself, or hangs, as it may while the kernel asks what it
  /// is and what it sends.
  void StayPlugged() {
    if (process_ != 0 && waitpid(process_, nullptr, WNOHANG) == process_) process_ = 0;
    if (process_ != 0 && Clock::now() < plugged_ + kPlugging) return;
    PullOut();
    Plug();
  }
  PluggedCamera(const PluggedCamera&) = delete;
  PluggedCamera& operator=(const PluggedCamera&) = delete;

 private:
  void PullOut() {
    if (process_ == 0) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
    process_ = 0;
  }
  void Plug() {
    plugged_ = Clock::now();
    char* const arguments[] = {program_.data(), serial_.data(), nullptr};
    if (posix_spawn(&process_, program_.c_str(), nullptr, nullptr, arguments, environ) != 0) {
      process_ = 0;
    }
  }

  std::string program_, serial_;
  pid_t process_ = 0;
  Clock::time_point plugged_;
};

class UsbGadget : public ::testing::Test {
 protected:
  void SetUp() override {
    program_ = std::getenv("MOCAP_VM_GADGET");
    if (!program_) GTEST_SKIP() << "needs a USB camera made of software; tools/check --vm has it";
  }

  /// The kernel takes a moment to know a camera.
  static ::testing::AssertionResult Starts(V4l2Driver& driver, PluggedCamera& camera) {
    std::string reason;
    for (const auto end = Clock::now() + kGadgetPatience; Clock::now() < end;) {
      try {
        driver.Start();
        return ::testing::AssertionSuccess();
      } catch (const SetupError& error) {
        reason = error.what();
        std::this_thread::sleep_for(kGadgetTimeout);
        camera.StayPlugged();
      }
    }
    return ::testing::AssertionFailure() << reason;
  }
  static bool GrabUntil(V4l2Driver& driver, GrabStatus wanted, PluggedCamera* camera = nullptr) {
    Frame frame;
    for (const auto end = Clock::now() + kGadgetPatience; Clock::now() < end;) {
      if (driver.Grab(frame, kGadgetTimeout) == wanted) return true;
      if (camera) camera->StayPlugged();
    }
    return false;
  }

  const char* program_ = nullptr;
};

TEST_F(UsbGadget, PulledOutWhileItStreamsItReturnsByItsSerialNumber) {
  const std::string serial = "A-0042";
  std::optional<PluggedCamera> camera(std::in_place, program_, serial);
  V4l2Driver driver({serial, 640, 480, 30}, {.format = "YUYV"});
  ASSERT_TRUE(Starts(driver, *camera));
  ASSERT_TRUE(GrabUntil(driver, GrabStatus::kFrame, &*camera));
  camera.reset();
  EXPECT_TRUE(GrabUntil(driver, GrabStatus::kLost));
  camera.emplace(program_, serial);
  EXPECT_TRUE(GrabUntil(driver, GrabStatus::kFrame, &*camera));
}

}  // namespace
}  // namespace mocap::testing
