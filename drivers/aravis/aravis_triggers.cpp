#include "drivers/aravis/aravis_triggers.h"

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "drivers/aravis/gige_action.h"
#include "drivers/aravis/gobject.h"
#include "drivers/nearest_name.h"
#include "drivers/quoted.h"

namespace mocap {
namespace {

std::string Triggers(ArvCamera* camera) {
  guint count = 0;
  const char** names = arv_camera_dup_available_trigger_sources(camera, &count, nullptr);
  return JoinNames(names, count);
}

/// The allowed values of a feature.
std::string Choices(ArvCamera* camera, const char* feature) {
  guint count = 0;
  const char** names =
      arv_camera_dup_available_enumerations_as_strings(camera, feature, &count, nullptr);
  return JoinNames(names, count);
}

bool Has(ArvCamera* camera, const char* feature) {
  return arv_camera_is_feature_available(camera, feature, nullptr);
}

bool Has(ArvCamera* camera, const char* feature, const char* choice) {
  return Has(camera, feature) &&
         arv_camera_is_enumeration_entry_available(camera, feature, choice, nullptr);
}

bool Is(ArvCamera* camera, const char* feature, const std::string& choice) {
  const char* got = arv_camera_get_string(camera, feature, nullptr);
  return got && choice == got;
}

/// Sets a feature to the first available choice. @return whether it has that value now.
bool Choose(ArvCamera* camera, const char* feature, std::initializer_list<const char*> choices) {
  for (const char* choice : choices) {
    if (!Has(camera, feature, choice)) continue;
    // Lines with a fixed function must not be written.
    if (!Is(camera, feature, choice)) arv_camera_set_string(camera, feature, choice, nullptr);
    return Is(camera, feature, choice);
  }
  return false;
}

[[noreturn]] void FailTrigger(ArvCamera* camera, const std::string& device,
                              const std::string& trigger) {
  throw SetupError(device + ": trigger " + Quoted(trigger) + " cannot be set; it has " +
                   Triggers(camera));
}

void SetSource(ArvCamera* camera, const std::string& device, const std::string& trigger,
               const std::string& source) {
  GFailure failure;
  arv_camera_set_trigger(camera, source.c_str(), failure);
  const char* got = arv_camera_get_trigger_source(camera, nullptr);
  if (failure.failed() || !got || source != got) FailTrigger(camera, device, trigger);
}

/// Sets the camera's first action: some count from 0, others from 1.
void SetAction(ArvCamera* camera, const std::string& device, const std::string& trigger) {
  const int first = Has(camera, "TriggerSource", "Action0") ? 0 : 1;
  const std::string source = "Action" + std::to_string(first);
  if (!Has(camera, "TriggerSource", source.c_str())) FailTrigger(camera, device, trigger);
  constexpr GigeActionKeys kKeys;
  if (Has(camera, "ActionSelector")) {
    arv_camera_set_integer(camera, "ActionSelector", first, nullptr);
  }
  // The device key cannot be read.
  GFailure failure;
  arv_camera_set_integer(camera, "ActionDeviceKey", kKeys.device, failure);
  bool is_set = !failure.failed();
  for (const auto& [feature, value] :
       {std::pair("ActionGroupKey", kKeys.group), std::pair("ActionGroupMask", kKeys.mask)}) {
    arv_camera_set_integer(camera, feature, value, failure);
    is_set = is_set && arv_camera_get_integer(camera, feature, nullptr) == value;
  }
  if (!is_set) {
    throw SetupError(device + ": trigger " + Quoted(trigger) + " cannot be set: it has no " +
                     "ActionDeviceKey, ActionGroupKey and ActionGroupMask");
  }
  SetSource(camera, device, trigger, source);
}

[[noreturn]] void FailStrobe(const std::string& device, const std::string& line,
                             const std::string& why) {
  throw SetupError(device + ": strobe " + Quoted(line) + " cannot be set: " + why);
}

}  // namespace

std::string JoinNames(const char** names, guint count) {
  const std::unique_ptr<const char*, GFree> owner(names);
  return ListedNames(names ? std::vector<std::string>(names, names + count)
                           : std::vector<std::string>());
}

void SetTrigger(ArvCamera* camera, const std::string& device, const std::string& trigger) {
  if (trigger.empty()) {
    arv_camera_clear_triggers(camera, nullptr);
    return;
  }
  if (trigger == "software") return SetSource(camera, device, trigger, "Software");
  if (trigger == "ptp") return SetAction(camera, device, trigger);
  // A line for both directions may be an output.
  if (Choose(camera, "LineSelector", {trigger.c_str()})) Choose(camera, "LineMode", {"Input"});
  SetSource(camera, device, trigger, trigger);
}

void SetStrobe(ArvCamera* camera, const std::string& device, const std::string& line) {
  if (line.empty()) return;
  if (!Choose(camera, "LineSelector", {line.c_str()})) {
    const std::string lines = Choices(camera, "LineSelector");
    FailStrobe(device, line, lines.empty() ? "it has no lines" : "it has " + lines);
  }
  if (Has(camera, "LineMode") && !Choose(camera, "LineMode", {"Output", "Strobe"})) {
    FailStrobe(device, line, "it is not an output");
  }
  // Names by the standard and by Hikrobot. Point Grey's strobes have no source.
  if (Has(camera, "LineSource") &&
      !Choose(camera, "LineSource", {"ExposureActive", "ExposureStartActive"})) {
    FailStrobe(device, line, "it cannot signal exposures, only " + Choices(camera, "LineSource"));
  }
  if (!Has(camera, "StrobeEnable")) return;
  arv_camera_set_boolean(camera, "StrobeEnable", TRUE, nullptr);
  if (!arv_camera_get_boolean(camera, "StrobeEnable", nullptr)) {
    FailStrobe(device, line, "its StrobeEnable stays off");
  }
}

}  // namespace mocap
