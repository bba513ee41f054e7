#include "core/people/people_capture.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "core/counted_time.h"
#include "core/errors.h"
#include "core/evidence/evidence.h"
#include "core/people/flesh_division.h"
#include "core/people/member.h"
#include "core/people/outline_division.h"
#include "core/people/posed_person.h"
#include "core/people/witnesses.h"
#include "core/reconstruction/carving/voxel_block.h"

namespace mocap {
namespace {

// People walk this fast.
constexpr double kWayMm_s = 1000;
// A carved-away limb may be this far from its prediction or from the flesh.
constexpr double kAsideMm = 100;
// A person without this many witnesses, for longer than one set can count, is none.
constexpr int kFewestWitnesses = 2;
// A newcomer who is not seen for this long has left.
constexpr double kUnseenS = 0.3;
// After this time, a person who is not shown completely is searched for anyway.
constexpr double kWholeWithinS = 0.3;
// Somebody who was not seen entering counts as a person only after this time.
constexpr double kPatienceS = 1.0;
// This close to the border of the covered area, somebody may just have entered.
constexpr double kBorderMm = 600;
// After a gap of this time, everybody is forgotten.
constexpr double kLongestGapS = 5.0;
// Strange flesh that moved less than this since the last frame is the same newcomer.
constexpr double kSameMm = 600;

double SecondsBetween(std::int64_t before_ns, std::int64_t after_ns) {
  return static_cast<double>(after_ns - before_ns) * 1e-9;
}

}  // namespace

class PeopleCapture::Impl {
 public:
  Impl(MakeCapture make, const PeopleOptions& options);

  void Update(const Sighting& room, std::span<const CameraEye> eyes, std::int64_t capture_ns,
              UpdateObserver* observer);
  const std::vector<PersonView>& people() const { return people_; }
  const MotionCapture& first() const;
  void StartOver(const std::optional<BodySizes>& sizes, std::string_view name);
  void Know(std::vector<KnownPerson> people) { known_ = std::move(people); }
  void Call(int id, std::string_view name);

 private:
  void Equip(Member& member) const;
  void NoteGap(std::int64_t capture_ns);
  void BringBack();
  void Thin(std::span<const Outline> outlines, int step);
  void UpdateAlone(const Sighting& room, std::int64_t capture_ns, UpdateObserver* observer);
  bool IsAlone(const VoxelGrid& grid);
  void PoseMembers(std::int64_t capture_ns);
  void Divide(const VoxelGrid& grid);
  void MeetStrangers(std::span<const CameraEye> eyes);
  bool IsBeginning() const;
  Member* MemberFor(const Vector3& middle_W);
  void UpdateMembers(std::int64_t capture_ns, UpdateObserver* observer);
  void JudgeMembers();
  void Recognise();
  bool IsHere(std::string_view name) const;
  void ListPeople();
  Member& AddMember();

  const MakeCapture make_;
  const PeopleOptions options_;
  std::optional<BodySizes> expected_;  // For the next person.
  std::string expected_name_;
  std::vector<KnownPerson> known_;
  const std::unique_ptr<MotionCapture> nobody_;
  int witnesses_wanted_ = 0;
  std::vector<std::unique_ptr<Member>> members_;  // Never empty.
  int last_id_ = 0;
  std::optional<std::int64_t> last_ns_;            // Of the last set.
  std::int64_t clock_ns_ = 0;                      // Counts time with sets only.
  std::optional<std::int64_t> followed_since_ns_;  // Since when anybody is tracked.
  std::vector<PosedPerson> posed_;                 // For members whose pose is known.
  std::vector<Member*> posed_member_;              // Likewise.
  VoxelGrid believed_;
  VoxelGrid flesh_of_one_;
  FleshDivision flesh_;
  OutlineDivision outlines_;
  std::vector<Outline> thinned_;
  std::vector<PersonView> people_;
};

PeopleCapture::Impl::Impl(MakeCapture make, const PeopleOptions& options)
    : make_(std::move(make)), options_(options), nobody_(make_()) {
  MOCAP_CHECK(options.most >= 1 && options.fineness >= 1);
  AddMember();
}

Member& PeopleCapture::Impl::AddMember() {
  Member& member = *members_.emplace_back(std::make_unique<Member>());
  Equip(member);
  return member;
}

// Gives a member a capture that has seen nobody yet.
void PeopleCapture::Impl::Equip(Member& member) const {
  member.beside.reset();
  member.capture = make_();
  member.is_expected = false;
  const auto is_expected = [](const auto& one) { return one->is_expected; };
  if (!expected_ || std::ranges::any_of(members_, is_expected)) return;
  member.capture->Expect(*expected_);
  member.is_expected = true;
  member.name = expected_name_;
}

const MotionCapture& PeopleCapture::Impl::first() const {
  if (!people_.empty()) return *people_.front().capture;
  const auto is_here = [](const auto& member) { return !member->beside; };
  const auto member = std::ranges::find_if(members_, is_here);
  return member == members_.end() ? *nobody_ : *(*member)->capture;
}

void PeopleCapture::Impl::StartOver(const std::optional<BodySizes>& sizes, std::string_view name) {
  expected_ = sizes;
  expected_name_ = name;
  followed_since_ns_.reset();
  people_.clear();
  members_.clear();
  AddMember();
}

void PeopleCapture::Impl::Call(int id, std::string_view name) {
  for (const auto& member : members_)
    if (id > 0 && member->id == id) member->SetName(name, 1);
}

void PeopleCapture::Impl::Update(const Sighting& room, std::span<const CameraEye> eyes,
                                 std::int64_t capture_ns, UpdateObserver* observer) {
  witnesses_wanted_ = WitnessesWanted(eyes.size());
  NoteGap(capture_ns);
  BringBack();
  PoseMembers(capture_ns);
  const Sighting believed(BelieveWithin(posed_, room, believed_), room.outlines, room.box_W);
  if (IsAlone(believed.flesh)) {
    Thin(room.outlines, options_.fineness);
    UpdateAlone(believed, capture_ns, observer);
  } else {
    Thin(room.outlines, 1);
    Divide(believed.flesh);
    MeetStrangers(eyes);
    if (observer) observer->OnStageEnd(UpdateStage::kLabel);
    UpdateMembers(capture_ns, observer);
  }
  JudgeMembers();
  Recognise();
  ListPeople();
}

// Time without sets tells nothing for or against anybody. But in a gap people may have entered, and
// after a long one whoever is seen may be somebody else.
void PeopleCapture::Impl::NoteGap(std::int64_t capture_ns) {
  const double passed_s = last_ns_ ? SecondsBetween(*last_ns_, capture_ns) : 0;
  last_ns_ = capture_ns;
  clock_ns_ += std::llround(1e9 * std::max(0.0, CountedS(passed_s)));
  const double way_mm = kWayMm_s * std::max(0.0, passed_s);
  for (const auto& member : members_)
    member->reach_mm = std::min(member->reach_mm + way_mm, kReachMm + kSameMm);
  if (passed_s > kPatienceS) followed_since_ns_.reset();
  if (passed_s > kLongestGapS) StartOver(expected_, std::string(expected_name_));
}

// Takes over people who were located in the other thread, up to the last set. While nobody is
// followed, nobody waits for a search, and that thread may have no time for it: people who are
// still searched for there are searched for here from now on.
void PeopleCapture::Impl::BringBack() {
  for (const auto& member : members_) {
    if (!member->beside || !member->beside->HasCaughtUp()) continue;
    if (member->capture->result().state == CaptureState::kTracking) member->beside.reset();
  }
  if (std::ranges::any_of(members_, [](const auto& member) { return member->has_pose(); })) return;
  for (const auto& member : members_) {
    if (member->beside) Equip(*member);
  }
}

// Flesh beside the box of a single person is nobody's, though the grid may contain it.
void PeopleCapture::Impl::UpdateAlone(const Sighting& room, std::int64_t capture_ns,
                                      UpdateObserver* observer) {
  const Eigen::AlignedBox3i cells = CellsWithin(room.flesh, room.box_W);
  const bool is_all =
      !cells.isEmpty() && cells.sizes() + Eigen::Vector3i::Ones() == room.flesh.size();
  if (!is_all) CopyBlock(room.flesh, cells, flesh_of_one_);
  Member& member = *members_.front();
  member.capture->Update({is_all ? room.flesh : flesh_of_one_, thinned_, room.box_W}, capture_ns,
                         observer);
  member.seen_ns = member.vouched_ns = clock_ns_;
}

void PeopleCapture::Impl::Thin(std::span<const Outline> outlines, int step) {
  thinned_.resize(outlines.size());
  for (std::size_t i = 0; i < outlines.size(); ++i) ThinOutline(outlines[i], step, thinned_[i]);
}

void PeopleCapture::Impl::PoseMembers(std::int64_t capture_ns) {
  posed_member_.clear();
  for (const auto& member : members_)
    if (member->has_pose()) posed_member_.push_back(member.get());
  if (posed_member_.empty()) followed_since_ns_.reset();
  if (!posed_member_.empty() && !followed_since_ns_) followed_since_ns_ = clock_ns_;
  posed_.resize(posed_member_.size());
  for (std::size_t i = 0; i < posed_.size(); ++i) {
    const MotionCapture& capture = *posed_member_[i]->capture;
    PosePerson(capture.body(), capture.PredictedPose(capture_ns), posed_member_[i]->reach_mm,
               posed_[i]);
    posed_[i].is_lost = capture.result().state == CaptureState::kLost;
  }
}

// Whether at most one person can be present, so that nothing must be divided.
bool PeopleCapture::Impl::IsAlone(const VoxelGrid& grid) {
  if (options_.most == 1) return true;
  if (members_.size() > 1 || members_.front()->beside) return false;
  if (posed_.size() == 1) {
    return LitresBeside(grid, CellsWithin(grid, posed_.front().box_W)) <
           FleshDivision::kPerson.litres;
  }
  flesh_.Divide(grid, posed_);
  return flesh_.strangers().size() <= 1;
}

void PeopleCapture::Impl::Divide(const VoxelGrid& grid) {
  flesh_.Divide(grid, posed_);
  outlines_.Divide(thinned_, posed_, flesh_);
  for (const auto& member : members_) member->flesh = nullptr, member->outlines = nullptr;
  for (std::size_t i = 0; i < posed_.size(); ++i) {
    Member& member = *posed_member_[i];
    member.flesh = &flesh_.shares()[i];
    member.outlines = &outlines_.shares()[i];
    member.box_W =
        DownToFloor(posed_[i].box_W, kAsideMm - posed_[i].reach_mm).merged(member.flesh->box_W);
  }
}

// Assigns strange flesh to the newcomer it was before, or to a new one.
void PeopleCapture::Impl::MeetStrangers(std::span<const CameraEye> eyes) {
  for (std::size_t i = 0; i < flesh_.strangers().size(); ++i) {
    const FleshShare& flesh = flesh_.strangers()[i];
    const OutlineShare& share = outlines_.shares()[posed_.size() + i];
    if (share.witnesses < witnesses_wanted_) continue;
    Member* const member = MemberFor(flesh.box_W.center());
    if (!member) continue;
    member->last_W = flesh.box_W.center();
    member->seen_ns = clock_ns_;
    if (!member->waits_since_ns) {
      member->waits_since_ns = clock_ns_;
      member->has_come = IsBeginning() || !IsCovered(flesh.box_W, kBorderMm, eyes);
    }
    const bool is_whole = IsCovered(flesh.box_W, 0, eyes) && !LacksLegs(flesh.box_W.min().z());
    const double wanted_s = !member->has_come ? kPatienceS : is_whole ? 0 : kWholeWithinS;
    if (SecondsBetween(*member->waits_since_ns, clock_ns_) < wanted_s) continue;
    member->flesh = &flesh;
    member->outlines = &share;
    member->box_W = AroundStranger(flesh.box_W);
  }
}

// Whether people may be present who were not seen entering.
bool PeopleCapture::Impl::IsBeginning() const {
  return !followed_since_ns_ || SecondsBetween(*followed_since_ns_, clock_ns_) < kPatienceS;
}

// Null if no further person can be tracked.
Member* PeopleCapture::Impl::MemberFor(const Vector3& middle_W) {
  Member* nearest = nullptr;
  double least_mm = kSameMm;
  for (const auto& member : members_) {
    if (member->has_pose() || member->flesh) continue;
    const double moved_mm = member->last_W ? (middle_W - *member->last_W).norm() : kSameMm / 2;
    if (moved_mm >= least_mm) continue;
    least_mm = moved_mm;
    nearest = member.get();
  }
  if (!nearest && static_cast<int>(members_.size()) < options_.most) nearest = &AddMember();
  return nearest;
}

void PeopleCapture::Impl::UpdateMembers(std::int64_t capture_ns, UpdateObserver* observer) {
  const VoxelGrid nothing;
  const bool is_anybody_followed = !posed_.empty();
  for (const auto& member : members_) {
    if (!member->flesh) {
      if (!member->beside) member->capture->Update({nothing, {}}, capture_ns, observer);
      continue;
    }
    member->seen_ns = clock_ns_;
    const Sighting sighting(member->flesh->flesh, member->outlines->own, member->box_W,
                            member->flesh->room, member->outlines->near);
    if (options_.side && is_anybody_followed && !member->has_pose() && !member->beside)
      member->beside = options_.side->Begin(member->capture);
    if (member->beside) {
      member->beside->See(sighting, capture_ns);
      member->vouched_ns = clock_ns_;
      continue;
    }
    member->capture->Update(sighting, capture_ns, observer);
    // A lost person has a second to return, and may be hidden.
    const bool is_lost = member->capture->result().state == CaptureState::kLost;
    if (is_lost || member->outlines->witnesses >= std::min(kFewestWitnesses, witnesses_wanted_))
      member->vouched_ns = clock_ns_;
  }
}

void PeopleCapture::Impl::JudgeMembers() {
  const auto has_gone = [&](const std::unique_ptr<Member>& member) {
    const auto since_s = [&](std::int64_t then_ns) { return SecondsBetween(then_ns, clock_ns_); };
    if (member->has_pose() && since_s(member->vouched_ns) > kMostCountedS) return true;
    return !member->has_pose() && (member->id > 0 || since_s(member->seen_ns) > kUnseenS);
  };
  if (members_.size() > 1) std::erase_if(members_, has_gone);
  if (members_.empty()) AddMember();
  for (const auto& member : members_)
    if (!member->is_lost()) member->reach_mm = kReachMm;
  const bool is_alone = members_.size() == 1;
  if (is_alone && !members_.front()->has_pose()) {
    Member& next = *members_.front();
    next.id = 0;
    next.SetName(next.is_expected ? expected_name_ : std::string(), 1);
    next.compared = {};
  }
  for (const auto& member : members_) {
    if (member->id > 0 || !member->has_pose()) continue;
    // A phantom needs others; a single person is reported from the first fit on.
    const bool is_found = member->capture->result().state == CaptureState::kTracking;
    if (is_found || is_alone) member->id = ++last_id_;
  }
}

// Names people whose sizes have settled again.
void PeopleCapture::Impl::Recognise() {
  if (known_.empty()) return;
  for (const auto& member : members_) {
    const MotionCapture& capture = *member->capture;
    const bool is_measured =
        member->id > 0 && member->has_pose() && capture.acquisition_frames() > 0;
    if (!is_measured || !member->name.empty()) continue;
    const BodySizes& sizes = capture.body().sizes();
    if (sizes == member->compared) continue;
    member->compared = sizes;
    std::vector<KnownPerson> absent;
    std::ranges::copy_if(known_, std::back_inserter(absent),
                         [this](const KnownPerson& person) { return !IsHere(person.name); });
    const Likeness likeness = WhoIs(sizes, absent);
    if (!likeness.person || likeness.certainty < kSureOfName) continue;
    member->SetName(likeness.person->name, likeness.certainty);
  }
}

bool PeopleCapture::Impl::IsHere(std::string_view name) const {
  return std::ranges::any_of(members_, [&](const auto& member) { return member->name == name; });
}

void PeopleCapture::Impl::ListPeople() {
  people_.clear();
  for (const auto& member : members_)
    if (member->id > 0)
      people_.push_back({member->id, member->capture.get(), member->name, member->certainty});
  std::ranges::sort(people_, {}, &PersonView::id);
}

PeopleCapture::PeopleCapture(MakeCapture make, const PeopleOptions& options)
    : impl_(std::make_unique<Impl>(std::move(make), options)) {}
PeopleCapture::PeopleCapture(PeopleCapture&&) noexcept = default;
PeopleCapture::~PeopleCapture() = default;
void PeopleCapture::Update(const Sighting& room, std::span<const CameraEye> eyes,
                           std::int64_t capture_ns, UpdateObserver* observer) {
  impl_->Update(room, eyes, capture_ns, observer);
}
const std::vector<PersonView>& PeopleCapture::people() const { return impl_->people(); }
const MotionCapture& PeopleCapture::first() const { return impl_->first(); }
void PeopleCapture::Forget() { impl_->StartOver({}, {}); }
void PeopleCapture::Expect(const BodySizes& sizes, std::string_view name) {
  impl_->StartOver(sizes, name);
}
void PeopleCapture::Know(std::vector<KnownPerson> people) { impl_->Know(std::move(people)); }
void PeopleCapture::Call(int id, std::string_view name) { impl_->Call(id, name); }

}  // namespace mocap
