#include "drivers/v4l2/video_kernel.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>

namespace mocap {
namespace {

class SystemKernel : public VideoKernel {
 public:
  int Open(const std::string& node) override {
    const int handle = open(node.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    return handle < 0 ? -errno : handle;
  }

  void Close(int handle) override { close(handle); }

  int Request(int handle, unsigned long request, void* argument) override {
    int result = 0;
    do {
      result = ioctl(handle, request, argument);
    } while (result < 0 && errno == EINTR);
    return result < 0 ? -errno : result;
  }

  void* Map(int handle, std::size_t length, std::int64_t offset) override {
    void* memory = mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, handle, offset);
    return memory == MAP_FAILED ? nullptr : memory;
  }

  void Unmap(void* memory, std::size_t length) override { munmap(memory, length); }

  int Wait(int handle, std::chrono::milliseconds timeout) override {
    pollfd waiting{handle, POLLIN, 0};
    const int result = poll(&waiting, 1, static_cast<int>(timeout.count()));
    if (result < 0) return errno == EINTR ? 0 : -errno;
    return result;
  }
};

}  // namespace

std::shared_ptr<VideoKernel> SystemVideoKernel() { return std::make_shared<SystemKernel>(); }

}  // namespace mocap
