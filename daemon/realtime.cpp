#include "daemon/realtime.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <string>

#include "core/errors.h"

namespace mocap {

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
