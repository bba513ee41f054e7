// The unit that gives a host without network a multicast route, run in a network of its own.
#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>
#include <string>

#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

std::string CommandOf(const std::string& key) {
  const std::string unit =
      testing::ReadText(std::filesystem::path(MOCAP_SOURCE_DIR) / "systemd/mocapd-route.service");
  std::smatch match;
  const bool is_there =
      std::regex_search(unit, match, std::regex("\n" + key + "=-?(/bin/sh -c '[^\n]*')\n"));
  return is_there ? match[1].str() : "false";
}

/// What a shell in a network with nothing but a loopback interface gives for a script.
int RunInNetwork(const testing::TemporaryFolder& folder, const std::string& script) {
  const std::filesystem::path file = folder.path() / "script";
  testing::WriteText(file, "set -e\nip link set lo up\n" + script);
  return std::system(("unshare --map-root-user --net sh " + file.string()).c_str());
}

TEST(RouteUnit, GivesWayToANetworkAndHoldsWithoutOne) {
  const testing::TemporaryFolder folder;
  if (RunInNetwork(folder, "ip rule list > /dev/null\n") != 0) {
    GTEST_SKIP() << "this machine allows no network namespaces";
  }
  const std::string get = "ip route get 239.255.76.67";
  // A route of the main table stands for a network that has come.
  const std::string script =
      "! " + get + " 2> /dev/null\n" + CommandOf("ExecStart") + "\n" + CommandOf("ExecStart") +
      "\n" + get + " | grep -q 'table 7667'\n" + "test $(ip rule list | grep -c 7667) = 1\n" +
      "ip route add 239.0.0.0/8 dev lo\n" + "! " + get + " | grep -q 'table 7667'\n" +
      "ip route del 239.0.0.0/8 dev lo\n" + get + " | grep -q 'table 7667'\n" +
      CommandOf("ExecStop") + "\n" + "! " + get + " 2> /dev/null\n";
  EXPECT_EQ(RunInNetwork(folder, script), 0) << script;
}

}  // namespace
}  // namespace mocap
