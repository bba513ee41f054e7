#include "drivers/aravis/gige_action.h"

#include <arpa/inet.h>

#include <array>
#include <cstring>

namespace mocap {
namespace {

constexpr std::uint16_t kActionCommand = 0x0100;
constexpr std::uint16_t kHasTime = 0x80;
// Answers: status codes.
constexpr std::uint16_t kSuccess = 0x0000, kNoReferenceTime = 0x8013, kOverflow = 0x8015,
                        kActionLate = 0x8016;

void Append(std::uint32_t number, std::vector<std::byte>& bytes) {
  for (const int shift : {24, 16, 8, 0}) bytes.push_back(static_cast<std::byte>(number >> shift));
}

}  // namespace

std::vector<std::byte> GigeActionCommand(std::uint16_t request, const GigeActionKeys& keys,
                                         std::int64_t time_ns) {
  constexpr std::uint32_t kPayloadBytes = 20;
  constexpr std::uint32_t kFirst = kGvcpKey | kGvcpAnswerWanted | kHasTime;
  std::vector<std::byte> bytes;
  for (const std::uint32_t number :
       {kFirst << 16 | kActionCommand, kPayloadBytes << 16 | request, keys.device, keys.group,
        keys.mask, static_cast<std::uint32_t>(time_ns >> 32),
        static_cast<std::uint32_t>(time_ns)}) {
    Append(number, bytes);
  }
  return bytes;
}

std::string Describe(GigeActionAnswer answer) {
  switch (answer) {
    case GigeActionAnswer::kScheduled:
      return "";
    case GigeActionAnswer::kLate:
      return "receives scheduled exposures too late: this machine or the network is too slow";
    case GigeActionAnswer::kNoTime:
      return "accepts no scheduled exposures: it follows no PTP master";
    case GigeActionAnswer::kFull:
      return "cannot queue so many scheduled exposures: lower fps";
    case GigeActionAnswer::kRefused:
      return "rejects scheduled exposures: check whether it supports scheduled action commands";
    case GigeActionAnswer::kNoAnswer:
      return "does not acknowledge scheduled exposures";
  }
  return "";
}

GigeActionAnswer GigeActionSender::Schedule(std::int64_t time_ns,
                                            std::chrono::milliseconds patience) {
  if (++request_ == 0) ++request_;
  GvcpHead answer;
  const auto bytes = socket_.Ask(GigeActionCommand(request_, {}, time_ns),
                                 std::as_writable_bytes(std::span(&answer, 1)), patience);
  if (!bytes) return GigeActionAnswer::kNoAnswer;
  switch (ntohs(answer.first)) {
    case kSuccess:
      return GigeActionAnswer::kScheduled;
    case kActionLate:
      return GigeActionAnswer::kLate;
    case kNoReferenceTime:
      return GigeActionAnswer::kNoTime;
    case kOverflow:
      return GigeActionAnswer::kFull;
    default:
      return GigeActionAnswer::kRefused;
  }
}

}  // namespace mocap
