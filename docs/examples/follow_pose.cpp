// Prints where the tracked person's hands are. Build: see CMakeLists.txt beside this file, or
//   g++ -std=c++17 follow_pose.cpp $(pkg-config --cflags --libs mocap-lcmtypes) -o follow_pose
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <lcm/lcm-cpp.hpp>
#include <mocap/body_t.hpp>
#include <mocap/pose_t.hpp>
#include <string>

const char* const kUsage =
    "usage: follow_pose [URL [SECONDS [PREFIX]]]\n"
    "URL is LCM's; \"\" is its default, and file://LOG plays a log. Ends after so many seconds "
    "(10)\n"
    "without a pose. PREFIX stands before the channels' names: lcm.prefix of mocapd's "
    "configuration.\n";

const std::string kStatus = "MOCAP_STATUS";

class Follower {
 public:
  Follower(lcm::LCM& lcm, std::string prefix) : prefix_(std::move(prefix)) {
    lcm.subscribe(prefix_ + "MOCAP_BODY", &Follower::OnBody, this);
    lcm.subscribe(prefix_ + "MOCAP_POSE", &Follower::OnPose, this);
    lcm.subscribe(".*" + kStatus, &Follower::OnStatus, this);
  }

  double SilentSeconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - heard_).count();
  }

  std::string WhatCameInstead() const {
    if (other_.empty()) return "; is mocapd running? mocap doctor checks the network";
    const std::string other = other_.substr(0, other_.size() - kStatus.size());
    if (other == prefix_) return ", only mocapd's status: mocap status says why";
    return ", but mocapd sends there " +
           (other.empty() ? "without a prefix" : "with prefix \"" + other + '"');
  }

 private:
  void OnBody(const lcm::ReceiveBuffer*, const std::string&, const mocap::body_t* body) {
    for (int i = 0; i < 23; ++i) {
      if (body->point_name[i] == "fingertips_l") left_ = i;
      if (body->point_name[i] == "fingertips_r") right_ = i;
    }
  }

  void OnPose(const lcm::ReceiveBuffer*, const std::string&, const mocap::pose_t* pose) {
    heard_ = std::chrono::steady_clock::now();
    if (pose->state != mocap::pose_t::TRACKING || left_ < 0 || right_ < 0) return;
    const double* left = pose->point_mm[left_];
    const double* right = pose->point_mm[right_];
    std::printf("left hand %6.0f %6.0f %6.0f mm   right hand %6.0f %6.0f %6.0f mm   %3.0f ms old\n",
                left[0], left[1], left[2], right[0], right[1], right[2],
                static_cast<double>(pose->publish_utime - pose->utime) / 1000);
  }

  void OnStatus(const lcm::ReceiveBuffer*, const std::string& channel) { other_ = channel; }

  const std::string prefix_;
  int left_ = -1, right_ = -1;  // Where the body says that these points are.
  std::string other_;           // Channel of the last status, whoever sent it.
  std::chrono::steady_clock::time_point heard_ = std::chrono::steady_clock::now();
};

int main(int argc, char** argv) {
  const std::string url = argc > 1 ? argv[1] : "";
  char* end = nullptr;
  const double seconds = argc > 2 ? std::strtod(argv[2], &end) : 10;
  if (url == "--help") return std::fputs(kUsage, stdout) < 0;
  if (argc > 4 || (end && (*end != 0 || end == argv[2])) || url.rfind("--", 0) == 0) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  lcm::LCM lcm(url);
  if (!lcm.good()) {
    std::fputs("follow_pose: LCM cannot use this URL, or cannot join its group: mocap doctor\n",
               stderr);
    return 1;
  }
  Follower follower(lcm, argc > 3 ? argv[3] : "");
  while (follower.SilentSeconds() < seconds && lcm.handleTimeout(50) >= 0) {
  }
  if (url.rfind("file://", 0) == 0) return 0;
  std::fprintf(stderr, "follow_pose: no pose came for %g s%s\n", seconds,
               follower.WhatCameInstead().c_str());
  return 1;
}
