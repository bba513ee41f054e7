#include "drivers/aravis/aravis_directory.h"

#include <arv.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <mutex>
#include <optional>

#include "core/errors.h"
#include "drivers/aravis/gige_probe.h"
#include "drivers/aravis/gobject.h"
#include "drivers/nearest_name.h"
#include "drivers/quoted.h"
#include "drivers/usb/usb_bus.h"

namespace mocap {
namespace {

struct FoundCamera {
  std::string id, vendor, model, serial, physical_id, address, protocol;
};

std::string Text(const char* text) { return text ? text : ""; }

std::vector<FoundCamera> LookAround() {
  // Cameras that start together share one search, which takes a second.
  static std::optional<std::chrono::steady_clock::time_point> looked;
  constexpr std::chrono::seconds kFresh{2};
  const std::lock_guard lock(AravisMutex());
  if (!looked || std::chrono::steady_clock::now() - *looked > kFresh) {
    arv_update_device_list();
    looked = std::chrono::steady_clock::now();
  }
  std::vector<FoundCamera> cameras;
  for (unsigned i = 0; i < arv_get_n_devices(); ++i) {
    cameras.push_back({Text(arv_get_device_id(i)), Text(arv_get_device_vendor(i)),
                       Text(arv_get_device_model(i)), Text(arv_get_device_serial_nbr(i)),
                       Text(arv_get_device_physical_id(i)), Text(arv_get_device_address(i)),
                       Text(arv_get_device_protocol(i))});
  }
  return cameras;
}

bool IsGige(const FoundCamera& camera) { return camera.protocol == "GigEVision"; }

AravisTarget TargetFor(const std::string& device, const FoundCamera& camera) {
  return {device, camera.id, IsGige(camera) ? camera.address : "", camera.serial};
}

/// Only Aravis knows the names that users gave to cameras.
std::optional<AravisTarget> OpenByUserName(const std::string& device) {
  const std::lock_guard lock(AravisMutex());
  GFailure failure;
  const GPtr<ArvDevice> opened(arv_open_device(device.c_str(), failure));
  if (!opened) return std::nullopt;
  AravisTarget target{device, device, "", ""};
  if (!ARV_IS_GV_DEVICE(opened.get())) return target;
  GSocketAddress* address = arv_gv_device_get_device_address(ARV_GV_DEVICE(opened.get()));
  const std::unique_ptr<char, GFree> ip(
      g_inet_address_to_string(g_inet_socket_address_get_address(G_INET_SOCKET_ADDRESS(address))));
  target.ip = ip.get();
  return target;
}

std::string NamesOf(const std::vector<FoundCamera>& cameras) {
  std::vector<std::string> names;
  for (const FoundCamera& camera : cameras) {
    names.push_back(Quoted(camera.id) + " at " + camera.address);
  }
  return names.empty() ? "no camera was found" : "found: " + ListedNames(names);
}

}  // namespace

std::mutex& AravisMutex() {
  static std::mutex mutex;
  return mutex;
}

std::vector<ListedCamera> ListAravisCameras() {
  std::vector<ListedCamera> listed;
  for (const FoundCamera& camera : LookAround()) {
    ListedCamera entry;
    entry.driver = "aravis";
    entry.device = camera.id;
    entry.model = camera.vendor + " " + camera.model;
    entry.serial = camera.serial;
    entry.bus = camera.protocol + " " + camera.address;
    if (IsGige(camera)) {
      if (const auto route = RouteTo(camera.address)) {
        entry.bus += " on " + route->interface;
        entry.link_mbit_s = route->link_mbit_s;
      }
      constexpr std::chrono::milliseconds kPatience{200};
      if (ProbeGigeCamera(camera.address, kPatience) == GigePresence::kHeld) {
        entry.remarks.push_back("is controlled by another program");
      }
    } else if (const auto usb = FindUsbDevice(camera.serial)) {
      entry.bus = camera.protocol + " on " + usb->bus;
      entry.link_mbit_s = usb->link_mbit_s;
    }
    listed.push_back(std::move(entry));
  }
  return listed;
}

AravisTarget FindAravisCamera(const std::string& device) {
  if (IsIpv4(device)) return {device, device, device, ""};
  const std::vector<FoundCamera> cameras = LookAround();
  std::vector<FoundCamera> meant;
  std::ranges::copy_if(cameras, std::back_inserter(meant), [&device](const FoundCamera& camera) {
    const std::array names{&camera.id, &camera.serial, &camera.physical_id, &camera.address};
    return std::ranges::any_of(names, [&](const std::string* name) { return *name == device; });
  });
  if (meant.size() > 1) {
    throw SetupError(device + ": matches more than one camera; " + NamesOf(meant));
  }
  if (meant.size() == 1) return TargetFor(device, meant.front());
  if (const auto named = OpenByUserName(device)) return *named;
  throw SetupError(device + ": Aravis finds no such camera; " + NamesOf(cameras));
}

}  // namespace mocap
