#include "daemon/realtime.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <string>

#include "core/errors.h"

namespace mocap {
namespace {

constexpr int kNicer = 10;
constexpr int kNicest = 19;
constexpr std::size_t kLongestThreadName = 15;

}  // namespace

void StepBehind(const std::string& name) {
  pthread_setname_np(pthread_self(), name.substr(0, kLongestThreadName).c_str());
  // Zero is the calling thread: on Linux each has its own.
  setpriority(PRIO_PROCESS, 0, std::min(getpriority(PRIO_PROCESS, 0) + kNicer, kNicest));
}

void PrepareRealtime(const RealtimeConfig& config) {
  if (config.priority > 0) {
    const sched_param wished{.sched_priority = config.priority};
    if (pthread_setschedparam(pthread_self(), SCHED_FIFO, &wished) != 0) {
      throw SetupError("realtime.priority is " + std::to_string(config.priority) +
                       ", which the limits do not allow; LimitRTPRIO= in the unit, or rtprio in "
                       "/etc/security/limits.conf, has to be as high");
    }
    // The threads of the frame path take it for themselves.
    const sched_param plain{};
    pthread_setschedparam(pthread_self(), SCHED_OTHER, &plain);
  }
  if (config.lock_memory && mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    throw SetupError(
        "realtime.lock_memory is true, which the limits do not allow; LimitMEMLOCK=infinity in the "
        "unit, or memlock in /etc/security/limits.conf, is wanted");
  }
}

}  // namespace mocap
