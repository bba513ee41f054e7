#include "daemon/service/service_manager.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "daemon/control/control_socket.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// systemd's end of the protocol.
class ServiceManagerTest : public ::testing::Test {
 protected:
  ServiceManagerTest() : socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    const std::string path = folder_.path() / "notify";
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    EXPECT_EQ(bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    setenv("NOTIFY_SOCKET", path.c_str(), 1);
  }
  ~ServiceManagerTest() override { unsetenv("NOTIFY_SOCKET"); }

  /// What came since the last call.
  std::vector<std::string> Heard() const {
    std::vector<std::string> all;
    std::string message(256, '\0');
    for (ssize_t size; (size = recv(socket_.get(), message.data(), 256, MSG_DONTWAIT)) > 0;) {
      all.push_back(message.substr(0, static_cast<std::size_t>(size)));
    }
    return all;
  }

  testing::TemporaryFolder folder_;
  FileDescriptor socket_;
  ServiceManager manager_;
};

TEST_F(ServiceManagerTest, AReloadBeforePosesFlowDoesNotMakeReady) {
  manager_.BeginReload();
  manager_.EndReload();
  EXPECT_THAT(Heard(), IsEmpty());
  manager_.Ready();
  manager_.BeginReload();
  manager_.EndReload();
  EXPECT_THAT(Heard(), ElementsAre("READY=1", StartsWith("RELOADING=1"), "READY=1"));
}

TEST_F(ServiceManagerTest, AnEndSaysHowLongItMayTake) {
  manager_.Stopping(std::chrono::seconds(20));
  EXPECT_THAT(Heard(), ElementsAre("STOPPING=1\nEXTEND_TIMEOUT_USEC=20000000"));
}

}  // namespace
}  // namespace mocap
