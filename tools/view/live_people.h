// The people tracked now, with the colour and body of each on the page.
#pragma once

#include <mocap/people_t.hpp>
#include <mocap/person_body_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/results/set_details.h"
#include "tools/view/drawn_body.h"
#include "tools/view/wire.h"

namespace mocap {

/// Makes a pose for drawing, with capsules if the body is known.
DrawnPose DrawnPoseOf(const pose_t& pose, const PoseRow& row, const DrawnBody* body);

/// Keeps track of MOCAP_PEOPLE and MOCAP_BODIES. A new person gets the first free colour and keeps
/// it.
class LivePeople {
 public:
  struct Person {
    int id = 0;
    int color = 0;  ///< From 0.
    std::string name = {};
    double since_ms = 0;    ///< When first heard of, since the Unix epoch.
    bool has_come = false;  ///< The person arrived then; otherwise was there before.
    std::optional<DrawnBody> body = {};
  };

  /// Updates the people from a set.
  /// @param details  of the same set, as far as they came.
  /// @return  their poses in its order, without invalid ones.
  std::vector<DrawnPose> Take(const people_t& set, const SetDetails& details);
  /// Sets the body of a present person.
  void TakeBody(const person_body_t& message);

  /// Null if not present.
  const Person* Find(int id) const;
  /// JSON of all people for the page.
  std::string Json() const;

 private:
  Person& Welcome(const people_t& set, const person_t& person);

  std::vector<Person> people_;
  std::optional<double> heard_us_;  ///< Publication time of the last set.
};

}  // namespace mocap
