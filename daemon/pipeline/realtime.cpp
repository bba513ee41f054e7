#include "daemon/pipeline/realtime.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <string>

#include "core/errors.h"

namespace mocap {

bool KeepToProcessors(const std::vector<int>& processors) {
  if (processors.empty()) return true;
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int processor : processors) CPU_SET(processor, &set);
  cpu_set_t kept;
  // Of processors that are not there the kernel leaves out some without a word.
  return pthread_setaffinity_np(pthread_self(), sizeof set, &set) == 0 &&
         pthread_getaffinity_np(pthread_self(), sizeof kept, &kept) == 0 && CPU_EQUAL(&set, &kept);
}

bool TakePriority(int priority) {
  const sched_param parameter{.sched_priority = priority};
  return pthread_setschedparam(pthread_self(), priority > 0 ? SCHED_FIFO : SCHED_OTHER,
                               &parameter) == 0;
}

// The threads of the frame path take all of this for themselves; here it is only tried.
void PrepareRealtime(const RealtimeConfig& config) {
  if (config.priority > 0) {
    if (!TakePriority(config.priority)) {
      throw SetupError("realtime.priority is " + std::to_string(config.priority) +
                       ", which the limits do not allow; LimitRTPRIO= in the unit, or rtprio in "
                       "/etc/security/limits.conf, has to be as high");
    }
    TakePriority(0);
  }
  cpu_set_t before;
  pthread_getaffinity_np(pthread_self(), sizeof before, &before);
  if (!KeepToProcessors(config.processors)) {
    throw SetupError(
        "realtime.processors names processors that this process may not use; of those "
        "that `nproc` counts, from 0 on, some are wanted");
  }
  pthread_setaffinity_np(pthread_self(), sizeof before, &before);
  if (config.lock_memory && mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    throw SetupError(
        "realtime.lock_memory is true, which the limits do not allow; LimitMEMLOCK=infinity in the "
        "unit, or memlock in /etc/security/limits.conf, is wanted");
  }
}

}  // namespace mocap
