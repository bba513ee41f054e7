// Converts the daemon's messages to messages for pages.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <mocap/contrast_t.hpp>
#include <mocap/preview_t.hpp>
#include <mocap/studio_t.hpp>
#include <mocap/unknown_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "daemon/messages/silence.h"
#include "daemon/pipeline/carve_stage.h"
#include "daemon/status/service_report.h"
#include "tools/view/drawn_body.h"
#include "tools/view/live_board.h"
#include "tools/view/live_people.h"
#include "tools/view/shown_keypoints.h"

namespace mocap {

/// Receives LCM messages and puts updates on the board. Single-threaded.
class LiveFeed {
 public:
  /// Slots of the board. From kPictures on, each camera's picture has its own,
  /// and from kKeypoints on its keypoints.
  enum Slot : std::size_t {
    kStudio,
    kBody,
    kPeople,
    kStatus,
    kNotice,
    kPoses,  ///< Everyone's of one set; the person tracked longest is first.
    kVoxels,
    kPictures,
    kKeypoints = kPictures + kMaxCameras
  };
  using Put = std::function<void(std::size_t slot, LiveMessage message)>;

  /// @param lcm     must outlive the feed.
  /// @param prefix  of the channels' names.
  /// @param url     of LCM, for people.
  LiveFeed(lcm::LCM& lcm, const std::string& prefix, std::string url, Put put);

  /// Sets why requests to the daemon fail; empty: they work, or none was made.
  void NoteControl(const std::string& why);
  /// Checks whether the daemon has fallen silent. Call it several times a second.
  void Tick();

 private:
  struct SeenPicture {
    preview_t preview;
    std::vector<std::int32_t> unknown_run;  ///< As in unknown_t; empty: none came.
  };

  void OnPose(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnPeople(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnBody(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnPersonBody(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnDetails(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnVoxels(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnStatus(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnService(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnContrast(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnKeypointSenders(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnKeypoints(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnStudio(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnUnknown(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void OnPreview(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void PutPose(const pose_t& pose);
  void PutPoses(std::vector<DrawnPose> poses);
  void PutPeople();
  void PutStudio();
  void PutNotice();
  void MoveCamera(std::size_t camera, const preview_t& preview);
  void PutPicturesOf(std::int64_t utime);
  void PutPicture(std::size_t camera, const SeenPicture& seen);
  const std::vector<DrawnPose>* PosesAt(std::int64_t utime) const;
  std::vector<DrawnOutlines> OutlinesOf(const std::vector<DrawnPose>& poses,
                                        std::size_t camera) const;
  const DrawnBody* BodyOf(const DrawnPose& pose) const;

  const Silence nobody_heard_;
  const Put put_;
  std::int64_t heard_ns_;  ///< By the steady clock.
  std::string silence_, control_, notice_, told_people_;
  std::optional<DrawnBody> body_;  ///< From MOCAP_POSE.
  LivePeople people_;
  SetDetails details_;
  std::optional<std::int64_t> people_ns_;  ///< Time of the last MOCAP_PEOPLE, by the steady clock.
  std::optional<pose_t> first_;            ///< Drawn while MOCAP_PEOPLE has nobody.
  ServiceReport report_;                   ///< As far as messages tell it.
  contrast_t contrast_{};
  studio_t studio_{};
  std::vector<CameraCalibration> cameras_;
  std::vector<RigidTransform> X_CW_;  ///< Current pose of each camera.
  /// Latest poses, for later pictures, without capsules.
  std::deque<std::vector<DrawnPose>> poses_;
  /// Pictures whose pose has not come yet, by camera.
  std::map<std::size_t, SeenPicture> waiting_;
  std::map<std::size_t, ShownKeypoints> keypoints_;  ///< By camera.
  std::map<std::string, unknown_t> unknown_;         ///< The latest, by camera.
};

}  // namespace mocap
