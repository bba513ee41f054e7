// Prints where the tracked person's hands are. Build: see CMakeLists.txt beside this file, or
//   g++ -std=c++17 follow_pose.cpp $(pkg-config --cflags --libs mocap-lcmtypes) -o follow_pose
#include <cstdio>
#include <cstdlib>
#include <lcm/lcm-cpp.hpp>
#include <mocap/body_t.hpp>
#include <mocap/pose_t.hpp>
#include <string>

class Follower {
 public:
  explicit Follower(lcm::LCM& lcm) {
    lcm.subscribe("MOCAP_BODY", &Follower::OnBody, this);
    lcm.subscribe("MOCAP_POSE", &Follower::OnPose, this);
  }

 private:
  void OnBody(const lcm::ReceiveBuffer*, const std::string&, const mocap::body_t* body) {
    for (int i = 0; i < 23; ++i) {
      if (body->point_name[i] == "fingertips_l") left_ = i;
      if (body->point_name[i] == "fingertips_r") right_ = i;
    }
  }

  void OnPose(const lcm::ReceiveBuffer*, const std::string&, const mocap::pose_t* pose) {
    if (pose->state != mocap::pose_t::TRACKING || left_ < 0 || right_ < 0) return;
    const double* left = pose->point_mm[left_];
    const double* right = pose->point_mm[right_];
    std::printf("left hand %6.0f %6.0f %6.0f mm   right hand %6.0f %6.0f %6.0f mm   %3.0f ms old\n",
                left[0], left[1], left[2], right[0], right[1], right[2],
                static_cast<double>(pose->publish_utime - pose->utime) / 1000);
  }

  int left_ = -1, right_ = -1;  // Where the body says that these points are.
};

// usage: follow_pose [SECONDS]      ends after so many seconds (10) without a message
int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 10;
  lcm::LCM lcm;
  if (!lcm.good()) {
    std::fputs("follow_pose: LCM cannot join its group; expected a multicast route: mocap doctor\n",
               stderr);
    return 1;
  }
  Follower follower(lcm);
  while (lcm.handleTimeout(static_cast<int>(seconds * 1000)) > 0) {
  }
  std::fprintf(stderr,
               "follow_pose: no message came for %g s; expected mocapd to run here, or to send to "
               "this network: mocap status\n",
               seconds);
  return 1;
}
