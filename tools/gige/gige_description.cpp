#include "tools/gige/gige_description.h"

#include <arv.h>

#include <array>
#include <cstdio>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "core/errors.h"
#include "drivers/aravis/gobject.h"

namespace mocap {
namespace {

std::string Hex(std::uint32_t value) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "0x%x", value);
  return text.data();
}

void Replace(std::string& text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  MOCAP_CHECK(at != std::string::npos);
  text.replace(at, from.size(), to);
}

/// Moves a register to where Aravis's server does not read it.
void Move(std::string& xml, const std::string& name, std::uint32_t from, std::uint32_t to) {
  const std::string head = "<IntReg Name=\"" + name + "\" NameSpace=\"Custom\">\n\t\t<Address>";
  Replace(xml, head + Hex(from) + "<", head + Hex(to) + "<");
}

std::string Entry(std::string_view name, std::uint32_t value) {
  return "\t\t<EnumEntry Name=\"" + std::string(name) +
         "\" NameSpace=\"Standard\">\n\t\t\t<Value>" + std::to_string(value) +
         "</Value>\n\t\t</EnumEntry>\n";
}

/// @param index  register that advances the address in steps of four; empty: none.
std::string Register(std::string_view name, std::uint32_t address, std::string_view index = "") {
  return "\t<IntReg Name=\"" + std::string(name) + "\" NameSpace=\"Custom\">\n\t\t<Address>" +
         Hex(address) + "</Address>\n" +
         (index.empty() ? "" : "\t\t<pIndex Offset=\"4\">" + std::string(index) + "</pIndex>\n") +
         "\t\t<Length>4</Length>\n\t\t<AccessMode>RW</AccessMode>\n"
         "\t\t<pPort>Device</pPort>\n\t\t<Cachable>NoCache</Cachable>\n\t\t<Sign>Unsigned</Sign>\n"
         "\t\t<Endianess>BigEndian</Endianess>\n\t</IntReg>\n";
}

/// Describes an enumeration, numbered from 0, in the register `name`Register.
std::string Enumeration(const std::string& name, std::initializer_list<std::string_view> words) {
  std::string xml = "\t<Enumeration Name=\"" + name + "\" NameSpace=\"Standard\">\n";
  std::uint32_t value = 0;
  for (const std::string_view word : words) xml += Entry(word, value++);
  return xml + "\t\t<pValue>" + name + "Register</pValue>\n\t</Enumeration>\n";
}

std::string Ptp() {
  return "\t<Boolean Name=\"PtpEnable\" NameSpace=\"Standard\">\n"
         "\t\t<pValue>PtpEnableRegister</pValue>\n\t\t<OnValue>1</OnValue>\n"
         "\t\t<OffValue>0</OffValue>\n\t</Boolean>\n" +
         Enumeration("PtpStatus", {"Initializing", "Faulty", "Disabled", "Listening", "PreMaster",
                                   "Master", "Passive", "Uncalibrated", "Slave"}) +
         Register("PtpEnableRegister", gige_register::kPtpEnable) +
         Register("PtpStatusRegister", gige_register::kPtpStatus);
}

std::string Integer(const std::string& name, std::uint32_t address) {
  return "\t<Integer Name=\"" + name + "\" NameSpace=\"Standard\">\n\t\t<pValue>" + name +
         "Register</pValue>\n\t\t<Min>0</Min>\n\t\t<Max>4294967295</Max>\n\t</Integer>\n" +
         Register(name + "Register", address);
}

std::string Actions() {
  return Integer("ActionSelector", gige_register::kActionSelector) +
         Integer("ActionDeviceKey", gige_register::kActionDeviceKey) +
         Integer("ActionGroupKey", gige_register::kActionGroupKey) +
         Integer("ActionGroupMask", gige_register::kActionGroupMask);
}

std::string Lines() {
  return Enumeration("LineSelector", {"Line0", "Line1"}) +
         Enumeration("LineMode", {"Input", "Output"}) +
         Enumeration("LineSource", {"Off", "ExposureActive"}) +
         Register("LineSelectorRegister", gige_register::kLineSelector) +
         Register("LineModeRegister", gige_register::kLineMode, "LineSelectorRegister") +
         Register("LineSourceRegister", gige_register::kLineSource, "LineSelectorRegister");
}

}  // namespace

std::string DescribeGigeCamera(bool has_ptp) {
  const GPtr<ArvFakeCamera> camera(arv_fake_camera_new("description"));
  std::size_t size = 0;
  const char* text = arv_fake_camera_get_genicam_xml(camera.get(), &size);
  std::string xml(text, size);
  Move(xml, "TriggerModeRegister", ARV_FAKE_CAMERA_REGISTER_TRIGGER_MODE,
       gige_register::kTriggerMode);
  Move(xml, "TriggerSourceRegister", ARV_FAKE_CAMERA_REGISTER_TRIGGER_SOURCE,
       gige_register::kTriggerSource);
  Move(xml, "TriggerActivationRegister", ARV_FAKE_CAMERA_REGISTER_TRIGGER_ACTIVATION,
       gige_register::kTriggerActivation);
  Move(xml, "TriggerSoftwareCommandRegister", ARV_FAKE_CAMERA_REGISTER_TRIGGER_SOFTWARE,
       gige_register::kTriggerSoftware);
  Move(xml, "AcquisitionFramePeriodRegister", ARV_FAKE_CAMERA_REGISTER_ACQUISITION_FRAME_PERIOD_US,
       gige_register::kFramePeriod_us);
  const std::string formats = "\t\t<pValue>PixelFormatRegister</pValue>";
  Replace(xml, formats,
          Entry("BGR8", ARV_PIXEL_FORMAT_BGR_8_PACKED) +
              Entry("YUV422_8", ARV_PIXEL_FORMAT_YUV_422_YUYV_PACKED) +
              Entry("YUV422_8_UYVY", ARV_PIXEL_FORMAT_YUV_422_PACKED) + formats);
  if (has_ptp) {
    const std::string sources = "\t\t<pValue>TriggerSourceRegister</pValue>";
    Replace(xml, sources,
            Entry("Action1", static_cast<std::uint32_t>(GigeTrigger::kAction1)) + sources);
  }
  const std::string port = "\t<Port Name=";
  Replace(xml, port, Lines() + (has_ptp ? Ptp() + Actions() : "") + port);
  return xml;
}

}  // namespace mocap
