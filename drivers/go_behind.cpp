#include "drivers/go_behind.h"

#include <pthread.h>
#include <sched.h>

namespace mocap {
namespace {

constexpr std::size_t kLongestThreadName = 15;

void LetOthersFirst(pthread_t thread) {
  const sched_param parameter{};
  pthread_setschedparam(thread, SCHED_IDLE, &parameter);
}

}  // namespace

void GoBehind(const std::string& name) {
  pthread_setname_np(pthread_self(), name.substr(0, kLongestThreadName).c_str());
  LetOthersFirst(pthread_self());
}

bool MayComeForward() {
  bool may = false;
  std::thread([&may] {
    const sched_param parameter{};
    LetOthersFirst(pthread_self());
    may = pthread_setschedparam(pthread_self(), SCHED_OTHER, &parameter) == 0;
  }).join();
  return may;
}

bool BringForward(std::thread& thread) {
  int policy = SCHED_OTHER;
  sched_param parameter{};
  return pthread_getschedparam(pthread_self(), &policy, &parameter) == 0 &&
         pthread_setschedparam(thread.native_handle(), policy, &parameter) == 0;
}

void SendBehind(std::thread& thread) { LetOthersFirst(thread.native_handle()); }

}  // namespace mocap
