// Files as somebody without rights finds them, for tests that root runs.
#pragma once

#include <sys/fsuid.h>
#include <unistd.h>

namespace mocap::testing {

/// While it lives, this thread opens files as nobody does. Only root can be somebody else.
class AsNobody {
 public:
  static bool IsPossible() { return geteuid() == 0; }
  AsNobody() { setfsuid(kNobody); }
  ~AsNobody() { setfsuid(0); }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;

 private:
  static constexpr uid_t kNobody = 65534;
};

}  // namespace mocap::testing
