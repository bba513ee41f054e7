// Beyond the paper: everybody in the room. One capture a person, and evidence that is shared.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/motion_capture.h"
#include "core/people/recognition.h"
#include "core/people/side_work.h"
#include "core/reconstruction/carving/carving_view.h"

namespace mocap {

/// More people are not followed at once.
inline constexpr int kMostPeople = 8;

struct PeopleOptions {
  int most = 1;      ///< Followed at once, at the most.
  int fineness = 1;  ///< Outlines have so many times the rays that one person needs.
  /// Whoever comes while others are followed is looked for there; borrowed. Null: in Update, so
  /// that the result depends on the input alone.
  SideWork* side = nullptr;
};

/// Somebody who is followed, or was until a moment ago.
struct PersonView {
  int id = 0;  ///< From 1; nobody else ever gets it.
  const MotionCapture* capture = nullptr;
  std::string_view name = {};  ///< Empty: not known. Valid until the next call.
  double certainty = 1;        ///< That the name is his, 0 to 1; 1 where somebody told.
};

/// Follows up to so many people through voxel grids, each by a capture of his own. Without a side,
/// same input, same output, bit for bit. Thread-bound.
///
/// While there is one person, the capture gets the evidence as it is. Of several, each gets what
/// his body, as predicted, explains best. Flesh that nobody explains, large enough for a person and
/// shown by several cameras where nobody else is, is a newcomer. Whoever lacks two cameras that
/// show him alone is nobody: hulls of several people hold flesh that belongs to none.
class PeopleCapture {
 public:
  using MakeCapture = std::function<std::unique_ptr<MotionCapture>()>;

  /// @pre most >= 1, fineness >= 1.
  PeopleCapture(MakeCapture make, const PeopleOptions& options);
  PeopleCapture(PeopleCapture&&) noexcept;
  ~PeopleCapture();

  /// Takes the next frame set.
  /// @param room        as if there were one person in it. The box is where he would be: of
  ///                    somebody who is alone nothing else counts.
  /// @param eyes        of the cameras that are in.
  /// @param capture_ns  time of exposure; must not go back.
  /// @param observer    told of the stages, may be null; the result does not depend on it.
  void Update(const Sighting& room, std::span<const CameraEye> eyes, std::int64_t capture_ns,
              UpdateObserver* observer = nullptr);

  /// Who is followed, in the order of their appearance.
  const std::vector<PersonView>& people() const;
  /// Whoever has been followed the longest; whoever is looked for while nobody is.
  const MotionCapture& first() const;

  /// Forgets everybody: whoever is seen next is measured.
  void Forget();
  /// Takes the sizes of whoever is seen from now on as known, and forgets everybody.
  /// @param name  of the person, for people().
  void Expect(const BodySizes& sizes, std::string_view name = {});
  /// Takes people as known: whoever is measured and is one of them by his sizes has the name from
  /// then on, until he leaves; nobody has it while in doubt, or while another has it.
  void Know(std::vector<KnownPerson> people);
  /// Gives a name to whoever has a number, until he leaves.
  void Call(int id, std::string_view name);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap
