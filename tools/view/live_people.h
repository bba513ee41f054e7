// Who is followed now, with the colour and the body in which the page draws each.
#pragma once

#include <mocap/people_t.hpp>
#include <mocap/person_body_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/view/drawn_body.h"
#include "tools/view/wire.h"

namespace mocap {

/// A pose with the flesh of the body, where that is known.
DrawnPose DrawnPoseOf(const pose_t& pose, const PoseRow& row, const DrawnBody* body);

/// Follows MOCAP_PEOPLE and MOCAP_BODIES. Whoever comes takes the first colour that is free and
/// keeps it.
class LivePeople {
 public:
  struct Person {
    int id = 0;
    int color = 0;  ///< From 0.
    std::string name = {};
    double since_ms = 0;    ///< When he was first heard of, since the Unix epoch.
    bool has_come = false;  ///< He came then; otherwise he was there already.
    std::optional<DrawnBody> body = {};
  };

  /// Takes who is there in a set.
  /// @return  their poses in its order, without those that are no numbers.
  std::vector<DrawnPose> Take(const people_t& set);
  /// Takes the body of somebody who is there.
  void TakeBody(const person_body_t& message);

  /// Null: he is not there.
  const Person* Find(int id) const;
  /// JSON of everybody for the page.
  std::string Json() const;

 private:
  Person& Welcome(const people_t& set, const person_t& person);

  std::vector<Person> people_;
  std::optional<double> heard_us_;  ///< When the last set was published.
};

}  // namespace mocap
