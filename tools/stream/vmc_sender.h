// The Virtual Motion Capture protocol: an avatar's bones as OSC over UDP.
#pragma once

#include <memory>
#include <string>

#include "core/motion_capture.h"
#include "tools/stream/humanoid.h"

namespace mocap {

/// Takes the studio's axes (x forward, y left, z up) to Unity's (x right, y up, z forward). Those
/// are left-handed: the matrix is a reflection, and who raises the left arm there does so here.
Matrix3 UnityFromStudio();

/// Sends to one receiver, in bundles that fit into a packet of an Ethernet: metres, quaternions x y
/// z w, each bone from its parent.
class VmcSender {
 public:
  /// Says hello, of nobody yet.
  /// @param place  "HOST:PORT"; an IPv6 address in brackets.
  /// @throws SetupError  when it is none, or nothing can be sent there.
  explicit VmcSender(const std::string& place);

  /// Says why there are no bones now.
  /// @param time_s  since the stream began.
  void SendState(CaptureState state, double time_s);
  /// Sends the bones of somebody who is tracked.
  void SendPose(const HumanoidPose& pose, double time_s);
  /// Why something could not be sent since the last state or pose; empty: all was.
  const std::string& trouble() const { return trouble_; }

 private:
  using Handle = std::unique_ptr<void, void (*)(void*)>;

  void Begin(CaptureState state, double time_s);
  /// Takes the message. Where it does not fit any more, the bundle goes out first.
  void Add(const char* path, void* message);
  void Flush();

  Handle address_, bundle_;
  std::string trouble_;
};

}  // namespace mocap
