// How a served camera describes itself to its clients.
#pragma once

#include <cstdint>
#include <string>

namespace mocap {

/// Registers of the served camera that clients write and Aravis's server does not look at. In
/// Aravis's own, the trigger and the period say when its server sends; here that is the studio's
/// to say.
namespace gige_register {
inline constexpr std::uint32_t kTriggerMode = 0x340;
inline constexpr std::uint32_t kTriggerSource = 0x344;
inline constexpr std::uint32_t kTriggerActivation = 0x348;
inline constexpr std::uint32_t kTriggerSoftware = 0x34c;
inline constexpr std::uint32_t kFramePeriod_us = 0x390;
inline constexpr std::uint32_t kPtpEnable = 0x3a0;
inline constexpr std::uint32_t kPtpStatus = 0x3a4;
}  // namespace gige_register

enum class GigePtp : std::uint32_t { kDisabled = 2, kListening = 3, kSlave = 8 };

/// Gives the description of Aravis's fake camera in GenICam's XML, with more pixel formats,
/// triggers of our own, and PTP if wanted.
std::string DescribeGigeCamera(bool has_ptp);

}  // namespace mocap
