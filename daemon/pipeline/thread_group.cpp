#include "daemon/pipeline/thread_group.h"

#include <pthread.h>

#include <utility>

#include "daemon/pipeline/realtime.h"

namespace mocap {
namespace {

constexpr std::size_t kLongestThreadName = 15;

}  // namespace

void ThreadGroup::Launch(const std::string& name, std::function<void()> body) {
  LaunchAt(options_.priority, name, std::move(body));
}

void ThreadGroup::LaunchBelow(const std::string& name, std::function<void()> body) {
  const int priority = options_.priority;
  LaunchAt(priority > 1 ? priority - 1 : priority, name, std::move(body));
}

void ThreadGroup::LaunchAt(int priority, const std::string& name, std::function<void()> body) {
  threads_.emplace_back([this, priority, name, body = std::move(body)] {
    pthread_setname_np(pthread_self(), name.substr(0, kLongestThreadName).c_str());
    // Permission was tested at the start. Without it, frames are only late more often.
    if (priority > 0) {
      TakePriority(priority);
    } else if (options_.in_long_turns) {
      WorkInLongTurns();
    }
    KeepToProcessors(options_.processors);
    body();
  });
}

void ThreadGroup::Guard(const std::function<void()>& body) {
  try {
    body();
  } catch (...) {
    if (!has_failed_.exchange(true)) failure_ = std::current_exception();
    RequestStop();
  }
}

void ThreadGroup::Join() {
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ThreadGroup::End() {
  RequestStop();
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
  threads_.clear();
}

}  // namespace mocap
