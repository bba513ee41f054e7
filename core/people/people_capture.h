// Beyond the paper: tracks everybody in the room. There is one capture per person; evidence is
// divided.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/body/recognition.h"
#include "core/motion_capture.h"
#include "core/people/keypoint_division.h"
#include "core/people/member.h"
#include "core/reconstruction/carving/carving_view.h"

namespace mocap {

/// Upper limit for the number of people.
inline constexpr int kMostPeople = 8;

struct PeopleOptions {
  int most = 1;      ///< Limit for people who are tracked at once.
  int fineness = 1;  ///< Factor between the outlines' rays and those that one person needs.
  /// Searches for newcomers while others are tracked; borrowed. Null: Update does so, and the
  /// result depends on the input alone.
  SideSearches* side = nullptr;
};

/// A person who is tracked, or was until a moment ago.
struct PersonView {
  int id = 0;  ///< From 1; never reused.
  const MotionCapture* capture = nullptr;
  std::string_view name = {};  ///< Empty: unknown. Valid until the next call.
  double certainty = 1;        ///< Probability of the name, 0 to 1; 1 if it was given.
};

/// Tracks several people through voxel grids, with one capture for each. Without `side`, the same
/// input gives the same output, bit for bit. Thread-bound.
///
/// A single person's capture gets the evidence unchanged. Of several people, each gets what his
/// predicted body explains best. Flesh that nobody explains is a newcomer if it is large enough for
/// a person and several cameras show it where nobody else is. A person without two cameras that
/// show him alone is dropped: hulls of several people contain ghosts. After a gap of five
/// seconds, everybody is forgotten.
class PeopleCapture {
 public:
  using MakeCapture = std::function<std::unique_ptr<MotionCapture>()>;

  /// @pre most >= 1, fineness >= 1.
  PeopleCapture(MakeCapture make, const PeopleOptions& options);

  /// Processes the next frame set.
  /// @param room        as for one person. The box is where he would be: nothing else counts for a
  /// single person.
  /// @param eyes        of the cameras in the set.
  /// @param capture_ns  time of exposure; one before the last counts as the same time.
  /// @param observer    told of the stages, may be null; the result does not depend on it.
  void Update(const Observation& room, std::span<const CameraEye> eyes, std::int64_t capture_ns,
              UpdateObserver* observer = nullptr);

  /// Returns the tracked people, in the order of their appearance.
  const std::vector<PersonView>& people() const { return people_; }
  /// Returns the person tracked for longest, or the search while nobody is tracked.
  const MotionCapture& first() const;

  /// Forgets everybody: the next people are measured.
  void Forget() { StartOver({}, {}); }
  /// Sets the sizes of everybody seen from now on as known, and forgets everybody.
  /// @param name  of the person, for people().
  void Expect(const BodySizes& sizes, std::string_view name = {}) {
    StartOver(sizes, std::string(name));
  }
  /// Sets the known people. A measured person who is recognised by his sizes has the name from then
  /// on, until he leaves. Nobody has it while in doubt, or while another has it.
  void Know(std::vector<KnownPerson> people) { known_ = std::move(people); }
  /// Gives a name to the person with this number, until he leaves.
  void Call(int id, std::string_view name);

 private:
  void StartOver(std::optional<BodySizes> sizes, std::string name);
  Member& AddMember();
  void Equip(Member& member) const;
  void PassTime(std::int64_t capture_ns);
  void BringBack();
  void PoseMembers(std::int64_t capture_ns);
  bool IsAlone(const VoxelGrid& grid);
  void UpdateAlone(const Observation& room, std::int64_t capture_ns, UpdateObserver* observer);
  void Divide(const VoxelGrid& grid);
  void DivideKeypoints(std::span<const KeypointRays> views, std::int64_t capture_ns);
  void MeetStrangers(std::span<const CameraEye> eyes);
  Member* MemberFor(const Vector3& middle_W);
  void UpdateMembers(std::int64_t capture_ns, UpdateObserver* observer);
  void JudgeMembers();
  void Recognise();
  void ListPeople();

  MakeCapture make_;
  PeopleOptions options_;
  std::optional<BodySizes> expected_;  // For the next person.
  std::string expected_name_;
  std::vector<KnownPerson> known_;
  std::unique_ptr<MotionCapture> nobody_;
  std::vector<std::unique_ptr<Member>> members_;  // Never empty.
  int last_id_ = 0;
  std::optional<std::int64_t> last_ns_;     // Of the last set.
  double now_s_ = 0;                        // Counts time with sets only.
  std::optional<double> followed_since_s_;  // Since when anybody is tracked.
  std::vector<PosedPerson> posed_;          // For members whose pose is known.
  std::vector<Member*> posed_member_;       // Likewise.
  VoxelGrid believed_, flesh_of_one_;
  FleshDivision flesh_;
  OutlineDivision outlines_;
  KeypointDivision keypoints_;
  std::vector<Outline> thinned_;
  std::vector<PersonView> people_;
};

}  // namespace mocap
