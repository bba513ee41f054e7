#include "daemon/pipeline/side_thread.h"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <utility>

#include "daemon/pipeline/realtime.h"

namespace mocap {
namespace {

// A tenth of a processor if all are busy.
constexpr int kNiceness = 10;
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

bool SideThread::Begin(std::function<void()> work) {
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
