#include "daemon/pipeline/realtime.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <string>

#include "core/errors.h"

namespace mocap {
namespace {

/// The kernel's struct sched_attr. Its header conflicts with glibc's.
struct SchedulingAttributes {
  std::uint32_t size = sizeof(SchedulingAttributes);
  std::uint32_t policy = SCHED_OTHER;
  std::uint64_t flags = 0;
  std::int32_t nice = 0;
  std::uint32_t priority = 0;
  std::uint64_t runtime_ns = 0;  ///< For SCHED_OTHER and SCHED_BATCH: the time slice.
  std::uint64_t deadline_ns = 0;
  std::uint64_t period_ns = 0;
};

}  // namespace

bool KeepToProcessors(const std::vector<int>& processors) {
  if (processors.empty()) return true;
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int processor : processors) CPU_SET(processor, &set);
  cpu_set_t kept;
  // The kernel silently ignores some processors that do not exist.
  return pthread_setaffinity_np(pthread_self(), sizeof set, &set) == 0 &&
         pthread_getaffinity_np(pthread_self(), sizeof kept, &kept) == 0 && CPU_EQUAL(&set, &kept);
}

bool TakePriority(int priority) {
  const sched_param parameter{.sched_priority = priority};
  return pthread_setschedparam(pthread_self(), priority > 0 ? SCHED_FIFO : SCHED_OTHER,
                               &parameter) == 0;
}

bool MayTakePriority(int priority) {
  const bool may = TakePriority(priority);
  if (may) TakePriority(0);
  return may;
}

void WorkInLongTurns() {
  constexpr std::uint64_t kLongestTurnNs = 100'000'000;  // The kernel's maximum.
  constexpr pid_t kThisThread = 0;
  SchedulingAttributes attributes;  // Keeps the thread's nice value.
  if (syscall(SYS_sched_getattr, kThisThread, &attributes, sizeof attributes, 0U) != 0) return;
  attributes.policy = SCHED_BATCH;
  attributes.runtime_ns = kLongestTurnNs;
  syscall(SYS_sched_setattr, kThisThread, &attributes, 0U);
}

int FramePathPriority(const RealtimeConfig& config) {
  if (config.priority) return *config.priority;
  return MayTakePriority(kUsualPriority) ? kUsualPriority : 0;
}

// Only tests the limits. The threads of the frame path apply these settings themselves.
void PrepareRealtime(const RealtimeConfig& config) {
  if (config.priority && !MayTakePriority(*config.priority)) {
    throw SetupError("realtime.priority is " + std::to_string(*config.priority) +
                     ", which is above the limit; raise LimitRTPRIO= in the unit, or rtprio in "
                     "/etc/security/limits.conf");
  }
  cpu_set_t before;
  pthread_getaffinity_np(pthread_self(), sizeof before, &before);
  if (!KeepToProcessors(config.processors)) {
    throw SetupError(
        "realtime.processors has processors that this process may not use; expected some of those "
        "that `nproc` counts, from 0 on");
  }
  pthread_setaffinity_np(pthread_self(), sizeof before, &before);
  if (config.lock_memory && mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    throw SetupError(
        "realtime.lock_memory is true, which the limits do not allow; set LimitMEMLOCK=infinity in "
        "the unit, or memlock in /etc/security/limits.conf");
  }
}

}  // namespace mocap
