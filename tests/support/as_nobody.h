// Files as somebody without rights finds them, for tests that root runs.
#pragma once

#include <sys/fsuid.h>
#include <unistd.h>

namespace mocap::testing {

/// While it lives, this thread opens files as nobody does. Only root can be somebody else, and in a
/// user namespace only if nobody is mapped there.
class AsNobody {
 public:
  static bool IsPossible() {
    if (geteuid() != 0) return false;
    const AsNobody nobody;
    // Whatever is asked for, setfsuid tells who it was before.
    return setfsuid(static_cast<uid_t>(-1)) == kNobody;
  }
  AsNobody() { setfsuid(kNobody); }
  ~AsNobody() { setfsuid(0); }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;

 private:
  static constexpr int kNobody = 65534;
};

}  // namespace mocap::testing
