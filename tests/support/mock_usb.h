// USB cameras on heads that the system takes for real: umockdev answers for the kernel.
#pragma once

#include <umockdev.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "drivers/aravis/gobject.h"

namespace mocap::testing {

/// How a camera on a head answers USB's requests. Angles in seconds of arc; thread-safe.
class MockHead {
 public:
  struct Angles {
    std::int32_t pan = 0, tilt = 0;
    friend bool operator==(const Angles&, const Angles&) = default;
  };
  Angles least{-360'000, -108'000}, most{360'000, 108'000};

  Angles angles() const;
  void Point(const Angles& angles);
  /// From now on it stalls every request.
  void FallSilent();
  /// Whether uvcvideo is bound.
  bool kernel_has_it() const;

 private:
  friend class MockUsb;

  void Unplug();
  int Submit(UMockdevIoctlData* urb);
  int Answer(std::uint8_t* setup);
  void Handle(UMockdevIoctlClient* client);
  static gboolean OnIoctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);

  mutable std::mutex mutex_;
  Angles angles_;
  bool is_silent_ = false;
  bool is_gone_ = false;
  bool kernel_has_it_ = true;
  bool is_claimed_ = false;
  GPtr<UMockdevIoctlData> answered_;
  GPtr<UMockdevIoctlBase> ioctls_;
};

/// A computer with one USB controller; what is plugged in before libusb starts is there from the
/// beginning.
class MockUsb {
 public:
  MockUsb();

  /// Plugs a camera in. @param pans  whether its terminal has a head.
  void Plug(int port, const std::string& serial, MockHead& head, bool pans = true);
  void Unplug(int port, MockHead& head);

 private:
  void Add(const std::string& description);

  GPtr<UMockdevTestbed> testbed_;
};

}  // namespace mocap::testing
