#include "daemon/status/followed_person.h"

#include <algorithm>

#include "core/errors.h"
#include "drivers/nearest_name.h"

namespace mocap {

std::vector<FollowedPerson> Tracked(std::vector<FollowedPerson> people) {
  std::erase_if(
      people, [](const FollowedPerson& person) { return person.state != CaptureState::kTracking; });
  return people;
}

const FollowedPerson& ChoosePerson(std::span<const FollowedPerson> people, std::optional<int> id) {
  MOCAP_CHECK(!people.empty());
  if (!id && people.size() == 1) return people.front();
  if (!id) {
    throw SetupError("several people are tracked: " + LabelsOf(people) +
                     "; choose one of them with --person NUMBER");
  }
  const auto found = std::ranges::find(people, *id, &FollowedPerson::id);
  if (found != people.end()) return *found;
  throw SetupError("person " + std::to_string(*id) +
                   " is not tracked; tracked are: " + LabelsOf(people));
}

std::string LabelOf(int id, const std::string& name) {
  const std::string label = "person " + std::to_string(id);
  return name.empty() ? label : label + " (" + name + ')';
}

std::string LabelsOf(std::span<const FollowedPerson> people) {
  std::vector<std::string> labels;
  for (const FollowedPerson& person : people) labels.push_back(LabelOf(person.id, person.name));
  return ListedNames(labels);
}

}  // namespace mocap
