#include "daemon/pipeline/side_thread.h"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <utility>

#include "daemon/pipeline/capture_beside.h"
#include "daemon/pipeline/realtime.h"

namespace mocap {
namespace {

// If all processors are busy, a third of what a thread of the frame path gets.
constexpr int kNiceness = 5;
constexpr std::size_t kMostWaiting = 32;

}  // namespace

SideThread::SideThread(const std::string& name, const ThreadOptions& frame_path, Guard guard)
    : guard_(std::move(guard)), queue_(kMostWaiting, Overflow::kWait, bell_) {
  thread_ = std::thread([this, name, frame_path] {
    pthread_setname_np(pthread_self(), name.c_str());
    // A frame path with real-time priority goes first anyway.
    if (frame_path.priority == 0) setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNiceness);
    KeepToProcessors(frame_path.processors);
    Run();
  });
}

SideThread::~SideThread() {
  stop_.store(true, std::memory_order_relaxed);
  queue_.Close();
  thread_.join();
}

std::unique_ptr<SideSearch> SideThread::Begin(std::shared_ptr<MotionCapture> capture) {
  return std::make_unique<CaptureBeside>(
      std::move(capture), [this](std::function<void()> work) { return Do(std::move(work)); });
}

bool SideThread::Do(std::function<void()> work) {
  if (waiting_.load() == kMostWaiting) return false;
  ++waiting_;
  queue_.back() = std::move(work);
  queue_.Push();
  return true;
}

void SideThread::Run() {
  for (;;) {
    const int seen = bell_.count();
    const bool is_closed = queue_.closed();
    if (stop_.load(std::memory_order_relaxed)) return;
    if (queue_.TryPop()) {
      --waiting_;
      guard_(queue_.front());
      queue_.front() = nullptr;
    } else if (is_closed) {
      return;
    } else {
      bell_.WaitPast(seen);
    }
  }
}

}  // namespace mocap
