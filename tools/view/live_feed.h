// From the daemon's messages to what pages are told.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <mocap/preview_t.hpp>
#include <mocap/service_t.hpp>
#include <mocap/studio_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "tools/view/drawn_body.h"
#include "tools/view/live_board.h"
#include "tools/view/live_people.h"

namespace mocap {

/// Hears LCM and puts what is new on the board. One thread.
class LiveFeed {
 public:
  /// Slots of the board; each camera's picture has one from kPictures on.
  enum Slot : std::size_t {
    kStudio,
    kBody,
    kPeople,
    kStatus,
    kService,
    kNotice,
    kPoses,  ///< Everybody's of one set, whoever has been followed the longest first.
    kVoxels,
    kPictures
  };
  using Put = std::function<void(std::size_t slot, LiveMessage message)>;

  /// @param lcm     borrowed for the feed's life.
  /// @param prefix  before the channels' names.
  /// @param url     of LCM, for people.
  LiveFeed(lcm::LCM& lcm, const std::string& prefix, std::string url, Put put);

  /// Why the daemon cannot be asked, for pictures or anything else; empty: it can, or nobody has.
  void NoteControl(const std::string& why);
  /// Looks whether the daemon has fallen silent. Some times a second.
  void Tick();

 private:
  void OnPose(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnPeople(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnBody(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnPersonBody(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnVoxels(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnStatus(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnService(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnStudio(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnPreview(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void PutPose(const pose_t& pose);
  void PutPoses(std::vector<DrawnPose> poses);
  void PutPeople();
  void PutStudio();
  void PutNotice();
  void MoveCamera(std::size_t camera, const preview_t& preview);
  void PutPicturesOf(std::int64_t utime);
  void PutPicture(std::size_t camera, const preview_t& preview);
  const std::vector<DrawnPose>* PosesAt(std::int64_t utime) const;
  std::vector<DrawnOutlines> OutlinesOf(const std::vector<DrawnPose>& poses,
                                        std::size_t camera) const;
  const DrawnBody* BodyOf(const DrawnPose& pose) const;

  const std::string url_;
  const Put put_;
  std::int64_t heard_ns_;  ///< By the steady clock.
  std::string silence_, control_, notice_, told_people_;
  std::optional<DrawnBody> body_;  ///< Of MOCAP_POSE.
  LivePeople people_;
  std::optional<std::int64_t> people_ns_;  ///< When they were heard of last, by the steady clock.
  std::optional<pose_t> first_;            ///< Drawn where MOCAP_PEOPLE has nobody yet.
  std::optional<service_t> service_;
  studio_t studio_;
  std::vector<CameraCalibration> cameras_;
  std::vector<RigidTransform> X_CW_;  ///< Where each camera stands now.
  /// The latest, for pictures that come later, without flesh,
  std::deque<std::vector<DrawnPose>> poses_;
  /// and pictures whose pose is still to come, by camera.
  std::map<std::size_t, preview_t> waiting_;
};

}  // namespace mocap
