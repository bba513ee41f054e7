#include "drivers/aravis/gige_action.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <future>

#include "drivers/aravis/exposure_schedule.h"
#include "tests/support/private_network.h"
#include "tools/gige/loopback.h"

namespace mocap {
namespace {

using std::chrono::milliseconds;

constexpr std::int64_t kTime_ns = 0x17b1'2233'4455'6677;

std::vector<std::byte> Bytes(std::initializer_list<int> values) {
  std::vector<std::byte> bytes;
  for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
  return bytes;
}

TEST(GigeActionCommand, IsLaidOutAsTheStandardSays) {
  const auto packet = GigeActionCommand(0x0102, {0x11121314, 0x21222324, 0x31323334}, kTime_ns);
  EXPECT_EQ(packet, Bytes({0x42, 0x81,              // Key; scheduled, answer wanted.
                           0x01, 0x00,              // ACTION_CMD.
                           0x00, 0x14,              // Bytes that follow the head.
                           0x01, 0x02,              // Request.
                           0x11, 0x12, 0x13, 0x14,  // Device key.
                           0x21, 0x22, 0x23, 0x24,  // Group key.
                           0x31, 0x32, 0x33, 0x34,  // Group mask.
                           0x17, 0xb1, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77}));
}

/// Plays the camera at an address of the loopback: hears one packet and answers with a status.
class Listener {
 public:
  explicit Listener(const std::string& ip) : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    EXPECT_TRUE(EnsureLoopbackAddress(ip));
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(kGvcpPort);
    at.sin_addr.s_addr = inet_addr(ip.c_str());
    EXPECT_EQ(bind(fd_, reinterpret_cast<const sockaddr*>(&at), sizeof(at)), 0);
  }
  ~Listener() { close(fd_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  std::vector<std::byte> HearAndAnswer(std::uint16_t status) const {
    std::vector<std::byte> packet(600);
    sockaddr_in from{};
    socklen_t size = sizeof(from);
    const ssize_t bytes =
        recvfrom(fd_, packet.data(), packet.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
    packet.resize(bytes > 0 ? static_cast<std::size_t>(bytes) : 0);
    GvcpHead head;
    std::memcpy(&head, packet.data(), sizeof(head));
    // An answer to another request is none.
    for (const int wrong : {1, 0}) {
      const GvcpHead answer{htons(status), htons(0x0101), 0,
                            static_cast<std::uint16_t>(head.request + wrong)};
      sendto(fd_, &answer, sizeof(answer), 0, reinterpret_cast<const sockaddr*>(&from), size);
    }
    return packet;
  }

 private:
  int fd_;
};

TEST(GigeActionSender, SendsTheCommandAndUnderstandsTheAnswer) {
  if (const std::string reason = testing::EnterPrivateNetwork(); !reason.empty()) {
    GTEST_SKIP() << reason;
  }
  const std::string ip = "127.0.0.201";
  GigeActionSender sender(ip);
  EXPECT_EQ(sender.Schedule(kTime_ns, milliseconds(50)), GigeActionAnswer::kNoAnswer);
  const Listener camera(ip);
  std::uint16_t request = 1;
  for (const auto& [status, answer] :
       {std::pair(0x0000, GigeActionAnswer::kScheduled), std::pair(0x8016, GigeActionAnswer::kLate),
        std::pair(0x8013, GigeActionAnswer::kNoTime), std::pair(0x8015, GigeActionAnswer::kFull),
        std::pair(0x8006, GigeActionAnswer::kRefused)}) {
    auto heard = std::async(std::launch::async, [&camera, status = status] {
      return camera.HearAndAnswer(static_cast<std::uint16_t>(status));
    });
    EXPECT_EQ(sender.Schedule(kTime_ns, milliseconds(2000)), answer) << std::hex << status;
    EXPECT_EQ(heard.get(), GigeActionCommand(++request, {}, kTime_ns));
    EXPECT_EQ(Describe(answer).empty(), answer == GigeActionAnswer::kScheduled);
  }
}

constexpr std::int64_t kHost_ns = 1'700'000'000'123'456'789, kTai_ns = 37'000'000'000;
constexpr std::int64_t kPeriod_ns = 20'000'000;

TEST(ExposureSchedule, ExposesAtMultiplesOfThePeriodByTheCamerasClock) {
  for (const std::int64_t offset_ns : {kTai_ns, std::int64_t{0}, -kHost_ns + 5'000'000'003}) {
    ExposureSchedule schedule(50);
    EXPECT_FALSE(schedule.knows_time());
    schedule.SetOffset(offset_ns);
    std::int64_t now_ns = kHost_ns;
    std::int64_t before_ns = 0;
    for (int i = 0; i < 10; ++i) {
      const std::int64_t exposure_ns = schedule.Next(now_ns);
      EXPECT_EQ(exposure_ns % kPeriod_ns, 0);
      if (i > 0) {
        EXPECT_EQ(exposure_ns, before_ns + kPeriod_ns);
      }
      EXPECT_GE(exposure_ns - offset_ns - now_ns, ExposureSchedule::kLeastAhead_ns);
      EXPECT_EQ(schedule.AskAt(), exposure_ns - offset_ns - ExposureSchedule::kAhead_ns);
      now_ns = std::max(now_ns, schedule.AskAt());
      before_ns = exposure_ns;
    }
  }
}

TEST(ExposureSchedule, HostsWhoseClocksDifferChooseTheSameInstants) {
  constexpr std::int64_t kLate_ns = 7'000'000;
  ExposureSchedule here(30), there(30);
  here.SetOffset(kTai_ns);
  there.SetOffset(kTai_ns - kLate_ns);
  EXPECT_EQ(here.Next(kHost_ns), there.Next(kHost_ns + kLate_ns));
}

TEST(ExposureSchedule, LeavesOutWhatAHeldUpHostWouldAskForTooLate) {
  ExposureSchedule schedule(50);
  schedule.SetOffset(0);
  const std::int64_t first_ns = schedule.Next(kHost_ns);
  const std::int64_t next_ns = schedule.Next(first_ns + 5 * kPeriod_ns);
  EXPECT_EQ(next_ns, first_ns + 6 * kPeriod_ns);
}

TEST(ExposureSchedule, FollowsAClockThatWasSet) {
  ExposureSchedule schedule(50);
  schedule.SetOffset(kTai_ns);
  schedule.Next(kHost_ns);
  schedule.SetOffset(0);
  EXPECT_LT(schedule.Next(kHost_ns), kHost_ns + 2 * kPeriod_ns);
}

}  // namespace
}  // namespace mocap
