// GenICam description of a served camera.
#pragma once

#include <cstdint>
#include <string>

namespace mocap {

/// Registers that clients write and Aravis's server does not read. In its own registers, trigger
/// and period determine when the server sends; here the studio determines that.
namespace gige_register {
inline constexpr std::uint32_t kTriggerMode = 0x340;
inline constexpr std::uint32_t kTriggerSource = 0x344;
inline constexpr std::uint32_t kTriggerActivation = 0x348;
inline constexpr std::uint32_t kTriggerSoftware = 0x34c;
inline constexpr std::uint32_t kFramePeriod_us = 0x390;
inline constexpr std::uint32_t kPtpEnable = 0x3a0;
inline constexpr std::uint32_t kPtpStatus = 0x3a4;
inline constexpr std::uint32_t kLineSelector = 0x3b0;
/// One register per line, four bytes apart.
inline constexpr std::uint32_t kLineMode = 0x3c0;
inline constexpr std::uint32_t kLineSource = 0x3d0;
inline constexpr std::uint32_t kActionSelector = 0x3e0;
inline constexpr std::uint32_t kActionDeviceKey = 0x3e4;
inline constexpr std::uint32_t kActionGroupKey = 0x3e8;
inline constexpr std::uint32_t kActionGroupMask = 0x3ec;
}  // namespace gige_register

enum class GigeTrigger : std::uint32_t { kLine0 = 0, kSoftware = 1, kAction1 = 2 };
enum class GigeLine : std::uint32_t { kInput = 0, kOutput = 1 };
enum class GigeLineSource : std::uint32_t { kOff = 0, kExposureActive = 1 };
enum class GigePtp : std::uint32_t { kDisabled = 2, kListening = 3, kSlave = 8 };

/// Returns the GenICam XML of Aravis's fake camera. Adds pixel formats, our own triggers, lines for
/// input and output, and, if requested, PTP with actions.
std::string DescribeGigeCamera(bool has_ptp);

}  // namespace mocap
