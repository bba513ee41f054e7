// From devices of the kernel to a tracked pose. tools/check_vm runs this in a machine that has
// them.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "config/load_config.h"
#include "config/open_studio.h"
#include "daemon/pipeline/pipeline.h"
#include "drivers/v4l2/v4l2_devices.h"
#include "drivers/v4l2/video_kernel.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

constexpr std::chrono::seconds kPatience{60};

/// Nodes that show what is written to them.
std::vector<std::string> LoopbackNodes() {
  std::vector<std::string> nodes;
  if (!std::getenv("MOCAP_IN_VM")) return nodes;
  for (const auto& entry : std::filesystem::directory_iterator("/sys/class/video4linux")) {
    const std::string node = "/dev/" + entry.path().filename().string();
    v4l2_capability capability{};
    const int handle = open(node.c_str(), O_RDWR);
    if (handle >= 0 && ioctl(handle, VIDIOC_QUERYCAP, &capability) == 0 &&
        std::string(reinterpret_cast<const char*>(capability.driver)) == "v4l2 loopback") {
      nodes.push_back(node);
    }
    if (handle >= 0) close(handle);
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// Writes pictures to a node, as a capture card's driver would.
class Feed {
 public:
  Feed(const std::string& node, int width, int height) : handle_(open(node.c_str(), O_RDWR)) {
    v4l2_format format{};
    format.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
    format.fmt.pix.width = static_cast<std::uint32_t>(width);
    format.fmt.pix.height = static_cast<std::uint32_t>(height);
    format.fmt.pix.pixelformat = V4L2_PIX_FMT_BGR24;
    format.fmt.pix.sizeimage = static_cast<std::uint32_t>(3 * width * height);
    format.fmt.pix.field = V4L2_FIELD_NONE;
    is_open_ = handle_ >= 0 && ioctl(handle_, VIDIOC_S_FMT, &format) == 0;
  }
  ~Feed() { close(handle_); }
  Feed(const Feed&) = delete;

  bool is_open() const { return is_open_; }
  bool Write(ImageView<const Bgr> image) {
    const auto bytes = static_cast<std::size_t>(3 * image.width() * image.height());
    return write(handle_, image.row(0), bytes) == static_cast<ssize_t>(bytes);
  }

 private:
  int handle_;
  bool is_open_ = false;
};

class StateLog : public PoseSink {
 public:
  void OnSet(const TrackedSet& set) override {
    const std::lock_guard lock(mutex_);
    ++sets_;
    if (set.result.state == CaptureState::kTracking) ++tracked_;
    changed_.notify_all();
  }

  /// Gives up after a while: a set may be lost.
  void WaitFor(int sets) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kPatience, [&] { return sets_ >= sets; });
  }

  int sets() {
    const std::lock_guard lock(mutex_);
    return sets_;
  }
  int tracked() const { return tracked_; }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int sets_ = 0, tracked_ = 0;
};

TEST(Loopback, PersonInFrontOfKernelDevicesIsTracked) {
  const std::vector<std::string> nodes = LoopbackNodes();
  const char* folder = std::getenv("MOCAP_VM_TAKE");
  if (nodes.size() < 6 || !folder) GTEST_SKIP() << "needs v4l2loopback; tools/check --vm has it";
  const std::filesystem::path take = folder;
  Studio played = OpenTake(take, {});
  testing::TemporaryFolder work;
  std::string text = "calibration = \"" + (take / "calibration.toml").string() +
                     "\"\nbackground = \"" + (take / "background").string() +
                     "\"\n[source]\ndriver = \"v4l2\"\nfps = 1\n";
  std::vector<std::unique_ptr<Feed>> feeds;
  for (std::size_t i = 0; i < played.cameras.size(); ++i) {
    const CameraCalibration& camera = played.cameras[i].calibration;
    text += "[[cameras]]\nname = \"" + camera.name + "\"\ndevice = \"" + nodes[i] + "\"\n";
    feeds.push_back(std::make_unique<Feed>(nodes[i], camera.width_px, camera.height_px));
    ASSERT_TRUE(feeds.back()->is_open()) << nodes[i];
    played.cameras[i].driver->Start();
  }
  testing::WriteText(work.path() / "mocapd.toml", text);

  StateLog log;
  Pipeline pipeline(OpenStudio(LoadConfig(work.path() / "mocapd.toml")),
                    {.overflow = Overflow::kDropOldest}, LoadBodyTable("full"), log);
  // The machine is emulated and slow: each set is written when the one before has come through.
  int frames = 0;
  std::vector<Frame> pictures(feeds.size());
  for (bool goes_on = true; goes_on; ++frames) {
    for (std::size_t i = 0; i < feeds.size() && goes_on; ++i)
      goes_on = played.cameras[i].driver->Grab(pictures[i], kPatience) == GrabStatus::kFrame;
    // One further set: a lost one is waited for once, and not again before each of the others,
    // whose gaps would make the person be forgotten.
    const int before = log.sets();
    // One after the other, close enough in time for one set.
    for (std::size_t i = 0; i < feeds.size() && goes_on; ++i)
      ASSERT_TRUE(feeds[i]->Write(pictures[i].image));
    // Devices have a format only once there is a picture.
    if (frames == 0) pipeline.Start();
    if (goes_on && frames > 0) log.WaitFor(before + 1);
  }
  pipeline.RequestStop();
  pipeline.Join();
  std::printf("%d sets written, %d came through, %d tracked\n", frames, log.sets(), log.tracked());
  EXPECT_GT(log.tracked(), frames / 2);
}

}  // namespace
}  // namespace mocap
