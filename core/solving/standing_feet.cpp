#include "core/solving/standing_feet.h"

#include <algorithm>

namespace mocap {
namespace {

// Speeds are measured over at least this time on either side: at 100 Hz, noise from frame to frame
// would pass for motion. As live.
constexpr double kSpeedTime_s = 0.02;
// A point this far from where it came down has slid there, as live.
constexpr double kSlid_mm = 35;

class FeetOfPoses {
 public:
  FeetOfPoses(const BodyModel& body, std::span<const PoseState> poses, std::span<const double> dt_s)
      : dt_s_(dt_s), standing_(poses.size()) {
    for (const PoseState& pose : poses)
      places_W_.push_back(FootPlacesOf(body.FurtherPointsAt(body.PostureAt(pose))));
  }

  std::vector<Standing> Find() {
    if (places_W_.size() < 2 || !places_W_.front().allFinite()) return standing_;
    for (std::size_t i = 0; i < places_W_.size(); ++i)
      standing_[i].contacts = ContactsOf(MotionsOf(places_W_[i], VelocityAt(i)));
    for (int contact = 0; contact < kContactCount; ++contact) Hold(contact);
    return standing_;
  }

 private:
  FootPlaces VelocityAt(std::size_t i) const {
    std::size_t before = i, after = i;
    double before_s = 0, after_s = 0;
    while (before > 0 && before_s < kSpeedTime_s) before_s += dt_s_[before--];
    while (after + 1 < places_W_.size() && after_s < kSpeedTime_s) after_s += dt_s_[++after];
    const double apart_s = before_s + after_s;
    if (apart_s <= 0) return FootPlaces::Zero();
    return (places_W_[after] - places_W_[before]) / apart_s;
  }

  // Gives each stance of a heel or toe its place.
  void Hold(int contact) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= places_W_.size(); ++i) {
      const bool goes_on = i < places_W_.size() && Touches(contact, i) &&
                           (i == begin || !HasSlid(contact, begin, i));
      if (goes_on) continue;
      StandFrom(contact, begin, i);
      begin = i < places_W_.size() && Touches(contact, i) ? i : i + 1;
    }
  }

  bool Touches(int contact, std::size_t i) const {
    return standing_[i].contacts[contact] > kContactLimit;
  }
  bool HasSlid(int contact, std::size_t from, std::size_t to) const {
    return (places_W_[to].col(contact) - places_W_[from].col(contact)).norm() > kSlid_mm;
  }

  void StandFrom(int contact, std::size_t begin, std::size_t end) {
    if (begin >= end) return;
    Vector3 sum_W = Vector3::Zero();
    for (std::size_t i = begin; i < end; ++i) sum_W += places_W_[i].col(contact);
    for (std::size_t i = begin; i < end; ++i)
      standing_[i].places_W[contact] = sum_W / static_cast<double>(end - begin);
  }

  std::span<const double> dt_s_;
  std::vector<FootPlaces> places_W_;
  std::vector<Standing> standing_;
};

}  // namespace

std::vector<Standing> StandingFeetOf(const BodyModel& body, std::span<const PoseState> poses,
                                     std::span<const double> dt_s) {
  return FeetOfPoses(body, poses, dt_s).Find();
}

}  // namespace mocap
