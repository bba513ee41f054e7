// The Virtual Motion Capture protocol: an avatar's bones as OSC over UDP.
#pragma once

#include <memory>
#include <string>

#include "core/motion_capture.h"
#include "tools/stream/humanoid.h"
#include "tools/stream/udp_sender.h"

namespace mocap {

/// Converts the studio's axes (x forward, y left, z up) to Unity's (x right, y up, z forward),
/// which are left-handed. The matrix is a reflection; a raised left arm stays a left arm.
Matrix3 UnityFromStudio();

/// Sends to one receiver, in bundles that fit into an Ethernet packet: metres, quaternions x y z w,
/// each bone relative to its parent.
class VmcSender {
 public:
  /// Sends the first state, without a person.
  /// @param place  "HOST:PORT"; an IPv6 address in brackets.
  /// @throws SetupError  for an invalid place, or when nothing can be sent there.
  explicit VmcSender(const std::string& place);

  /// Reports why there are no bones now.
  /// @param time_s  since the stream began.
  void SendState(CaptureState state, double time_s);
  /// Sends the bones of a tracked person.
  void SendPose(const HumanoidPose& pose, double time_s);
  /// Why sending failed since the last state or pose; empty: it did not.
  const std::string& trouble() const { return trouble_; }

 private:
  using Handle = std::unique_ptr<void, void (*)(void*)>;

  void Begin(CaptureState state, double time_s);
  /// Adds a message. If it does not fit any more, sends the bundle first.
  void Add(const char* path, void* message);
  void Flush();

  UdpSender receiver_;
  Handle bundle_;
  std::string trouble_;
};

}  // namespace mocap
