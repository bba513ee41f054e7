// A network of the test program's own, so that tests that run side by side do not meet.
#pragma once

#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "core/errors.h"
#include "tools/gige/loopback.h"

namespace mocap::testing {

/// Moves the program into a network namespace with nothing but a loopback interface, once; as an
/// ordinary user with a user namespace around it. To be called before any thread is started.
/// @return  why it could not be done; empty when it was.
inline const std::string& EnterPrivateNetwork() {
  static const std::string reason = [] {
    const auto map = [](const char* file, unsigned id) {
      std::ofstream(file) << "0 " << id << " 1";
    };
    const unsigned user = getuid(), group = getgid();
    if (unshare(CLONE_NEWNET) != 0) {
      if (unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) {
        return std::string("this machine allows no network namespaces");
      }
      std::ofstream("/proc/self/setgroups") << "deny";
      map("/proc/self/uid_map", user);
      map("/proc/self/gid_map", group);
    }
    return std::string(EnsureLoopbackAddress("127.0.0.1") ? "" : "the loopback cannot be set up");
  }();
  return reason;
}

/// Cuts the links of the private network for as long as it lives.
class LinkCut {
 public:
  LinkCut() { Switch(false); }
  ~LinkCut() { Switch(true); }
  LinkCut(const LinkCut&) = delete;
  LinkCut& operator=(const LinkCut&) = delete;

 private:
  static void Switch(bool is_up) {
    ifreq request{"lo", {}};
    const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    MOCAP_CHECK(ioctl(fd, SIOCGIFFLAGS, &request) == 0);
    request.ifr_flags =
        static_cast<short>(is_up ? request.ifr_flags | IFF_UP : request.ifr_flags & ~IFF_UP);
    MOCAP_CHECK(ioctl(fd, SIOCSIFFLAGS, &request) == 0);
    close(fd);
  }
};

}  // namespace mocap::testing
