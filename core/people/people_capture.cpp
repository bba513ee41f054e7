#include "core/people/people_capture.h"

#include <algorithm>
#include <cmath>

#include "core/counted_time.h"
#include "core/errors.h"
#include "core/evidence/evidence.h"
#include "core/reconstruction/carving/voxel_block.h"

namespace mocap {
namespace {

// When flesh is somebody's, and somebody is there; chosen on takes of several people.
struct PeopleLimits {
  // Flesh farther away may be somebody's own after a time without tracking, at the speed of a walk,
  // up to a stride.
  double walk_mm_s = 1000;
  // Cameras that must show a newcomer where nobody else is; with few cameras, all but one. A person
  // whom fewer than the least show is dropped.
  int least_cameras = 2, cameras = 4;
  // A person who is not seen for this long has left. One who is not seen completely is searched for
  // after this time.
  double brief_s = 0.3;
  // Somebody who was not seen entering counts as a person only after this time.
  double patience_s = 1;
  double longest_gap_s = 5;  // After it, everybody is forgotten.
  // Strange flesh that moved less than this since the last set is the same newcomer. This close to
  // the border of the covered area, somebody may just have entered.
  double stride_mm = 600;
};
constexpr PeopleLimits kLimits{};

int CamerasWanted(std::size_t cameras) {
  return std::clamp(static_cast<int>(cameras) - 1, kLimits.least_cameras, kLimits.cameras);
}

// Whether enough cameras have a whole person in their pictures, so that they do not show only a
// part, also after a move by `beside_mm`. Feet stand on the floor.
bool IsCovered(const Eigen::AlignedBox3d& flesh_W, double beside_mm,
               std::span<const CameraEye> eyes) {
  Eigen::AlignedBox3d box_W = DownToFloor(flesh_W, 0);
  const Vector3 beside(beside_mm, beside_mm, 0);
  box_W = {box_W.min() - beside, box_W.max() + beside};
  const auto seeing =
      std::ranges::count_if(eyes, [&](const CameraEye& eye) { return eye.SeesAllWithin(box_W); });
  return seeing >= CamerasWanted(eyes.size());
}

}  // namespace

PeopleCapture::PeopleCapture(MakeCapture make, const PeopleOptions& options)
    : make_(std::move(make)), options_(options), nobody_(make_()) {
  MOCAP_CHECK(options.most >= 1 && options.fineness >= 1);
  AddMember();
}

Member& PeopleCapture::AddMember() {
  Member& member = *members_.emplace_back(std::make_unique<Member>());
  Equip(member);
  return member;
}

// Gives a member a capture that has seen nobody yet.
void PeopleCapture::Equip(Member& member) const {
  member.beside.reset();
  member.capture = make_();
  member.is_expected = false;
  const auto is_expected = [](const auto& one) { return one->is_expected; };
  if (!expected_ || std::ranges::any_of(members_, is_expected)) return;
  member.capture->Expect(*expected_);
  member.is_expected = true;
  member.name = expected_name_;
}

const MotionCapture& PeopleCapture::first() const {
  if (!people_.empty()) return *people_.front().capture;
  const auto is_here = [](const auto& member) { return !member->beside; };
  const auto member = std::ranges::find_if(members_, is_here);
  return member == members_.end() ? *nobody_ : *(*member)->capture;
}

void PeopleCapture::StartOver(std::optional<BodySizes> sizes, std::string name) {
  expected_ = std::move(sizes);
  expected_name_ = std::move(name);
  followed_since_s_.reset();
  people_.clear();
  members_.clear();
  AddMember();
}

void PeopleCapture::Call(int id, std::string_view name) {
  for (const auto& member : members_)
    if (id > 0 && member->id == id) member->SetName(name, 1);
}

void PeopleCapture::Update(const Observation& room, std::span<const CameraEye> eyes,
                           std::int64_t capture_ns, UpdateObserver* observer) {
  PassTime(capture_ns);
  BringBack();
  PoseMembers(capture_ns);
  Observation believed(BelieveWithin(posed_, room, believed_), room.outlines, room.box_W);
  believed.keypoints = room.keypoints;
  const bool is_alone = IsAlone(believed.flesh);
  thinned_.resize(room.outlines.size());
  for (std::size_t i = 0; i < thinned_.size(); ++i)
    ThinOutline(room.outlines[i], is_alone ? options_.fineness : 1, thinned_[i]);
  if (is_alone) {
    UpdateAlone(believed, capture_ns, observer);
  } else {
    Divide(believed.flesh);
    DivideKeypoints(room.keypoints, capture_ns);
    MeetStrangers(eyes);
    if (observer) observer->OnStageEnd(UpdateStage::kLabel);
    UpdateMembers(capture_ns, observer);
  }
  JudgeMembers();
  Recognise();
  ListPeople();
}

// Time without sets tells nothing for or against anybody. But in a gap people may have moved or
// entered, and after a long one the people may be others.
void PeopleCapture::PassTime(std::int64_t capture_ns) {
  const std::int64_t passed_ns = last_ns_ ? std::max<std::int64_t>(0, capture_ns - *last_ns_) : 0;
  const double passed_s = static_cast<double>(passed_ns) * 1e-9;
  last_ns_ = capture_ns;
  now_s_ += CountedS(passed_s);
  for (const auto& member : members_)
    member->strayed_mm =
        std::min(member->strayed_mm + kLimits.walk_mm_s * passed_s, kLimits.stride_mm);
  if (passed_s > kLimits.patience_s) followed_since_s_.reset();
  if (passed_s > kLimits.longest_gap_s) StartOver(expected_, expected_name_);
}

// Takes over people who were located in the other thread, up to the last set. While nobody is
// followed, nobody waits for a search, and that thread may have no time for it: people who are
// still searched for there are searched for here from now on.
void PeopleCapture::BringBack() {
  for (const auto& member : members_) {
    if (!member->beside || !member->beside->HasCaughtUp()) continue;
    if (member->capture->result().state == CaptureState::kTracking) member->beside.reset();
  }
  if (std::ranges::any_of(members_, [](const auto& member) { return member->has_pose(); })) return;
  for (const auto& member : members_)
    if (member->beside) Equip(*member);
}

void PeopleCapture::PoseMembers(std::int64_t capture_ns) {
  posed_member_.clear();
  for (const auto& member : members_)
    if (member->has_pose()) posed_member_.push_back(member.get());
  if (posed_member_.empty()) followed_since_s_.reset();
  if (!posed_member_.empty() && !followed_since_s_) followed_since_s_ = now_s_;
  posed_.resize(posed_member_.size());
  for (std::size_t i = 0; i < posed_.size(); ++i) {
    const Member& member = *posed_member_[i];
    PosePerson(member.capture->body(), member.capture->PredictedPose(capture_ns),
               kReachMm + member.strayed_mm, posed_[i]);
    posed_[i].is_lost = member.is_lost();
  }
}

// Whether at most one person can be present, so that nothing must be divided.
bool PeopleCapture::IsAlone(const VoxelGrid& grid) {
  if (options_.most == 1) return true;
  if (members_.size() > 1 || members_.front()->beside) return false;
  if (posed_.size() == 1) {
    return LitresBeside(grid, CellsWithin(grid, posed_.front().box_W)) <
           FleshDivision::kPerson.litres;
  }
  flesh_.Divide(grid, posed_);
  return flesh_.strangers().size() <= 1;
}

// Flesh beside the box of a single person is nobody's, though the grid may contain it.
void PeopleCapture::UpdateAlone(const Observation& room, std::int64_t capture_ns,
                                UpdateObserver* observer) {
  const VoxelGrid& flesh = VoxelsWithin(room.flesh, room.box_W, flesh_of_one_);
  Member& member = *members_.front();
  Observation observation(flesh, thinned_, room.box_W);
  observation.keypoints = room.keypoints;
  member.capture->Update(observation, capture_ns, observer);
  member.seen_s = now_s_;
}

void PeopleCapture::Divide(const VoxelGrid& grid) {
  flesh_.Divide(grid, posed_);
  outlines_.Divide(thinned_, posed_, flesh_);
  for (const auto& member : members_) {
    member->flesh = nullptr;
    member->outlines = nullptr;
    member->keypoints = {};
  }
  for (std::size_t i = 0; i < posed_.size(); ++i) {
    Member& member = *posed_member_[i];
    member.flesh = &flesh_.shares()[i];
    member.outlines = &outlines_.shares()[i];
    member.box_W =
        DownToFloor(posed_[i].box_W, kAsideMm - posed_[i].reach_mm).merged(member.flesh->box_W);
  }
}

void PeopleCapture::DivideKeypoints(std::span<const KeypointRays> views, std::int64_t capture_ns) {
  if (views.empty()) return keypoints_.Clear();
  std::vector<PosedBody> bodies(posed_member_.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const MotionCapture& capture = *posed_member_[i]->capture;
    bodies[i].Set(capture.body(), capture.PredictedPose(capture_ns));
  }
  std::vector<Eigen::AlignedBox3d> strangers;
  for (const FleshShare& flesh : flesh_.strangers())
    strangers.push_back(AroundStranger(flesh.box_W));
  keypoints_.Divide(views, bodies, strangers);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    posed_member_[i]->keypoints = keypoints_.shares()[i];
}

// Assigns strange flesh to the newcomer it was before, or to a new one. When tracking begins,
// people may be present who were not seen entering.
void PeopleCapture::MeetStrangers(std::span<const CameraEye> eyes) {
  const bool is_beginning = !followed_since_s_ || now_s_ - *followed_since_s_ < kLimits.patience_s;
  for (std::size_t i = 0; i < flesh_.strangers().size(); ++i) {
    const FleshShare& flesh = flesh_.strangers()[i];
    const OutlineShare& share = outlines_.shares()[posed_.size() + i];
    if (share.cameras < CamerasWanted(eyes.size())) continue;
    Member* const member = MemberFor(flesh.box_W.center());
    if (!member) continue;
    member->last_W = flesh.box_W.center();
    member->seen_s = now_s_;
    if (!member->waits_since_s) {
      member->waits_since_s = now_s_;
      member->has_come = is_beginning || !IsCovered(flesh.box_W, kLimits.stride_mm, eyes);
    }
    const bool is_whole = IsCovered(flesh.box_W, 0, eyes) && !LacksLegs(flesh.box_W.min().z());
    const double wanted_s = !member->has_come ? kLimits.patience_s : is_whole ? 0 : kLimits.brief_s;
    if (now_s_ - *member->waits_since_s < wanted_s) continue;
    member->flesh = &flesh;
    member->outlines = &share;
    if (!keypoints_.shares().empty()) member->keypoints = keypoints_.shares()[posed_.size() + i];
    member->box_W = AroundStranger(flesh.box_W);
  }
}

// Null if no further person can be tracked.
Member* PeopleCapture::MemberFor(const Vector3& middle_W) {
  Member* nearest = nullptr;
  double least_mm = kLimits.stride_mm;
  for (const auto& member : members_) {
    if (member->has_pose() || member->flesh) continue;
    const double moved_mm =
        member->last_W ? (middle_W - *member->last_W).norm() : kLimits.stride_mm / 2;
    if (moved_mm >= least_mm) continue;
    least_mm = moved_mm;
    nearest = member.get();
  }
  const bool is_full = static_cast<int>(members_.size()) >= options_.most;
  return nearest || is_full ? nearest : &AddMember();
}

void PeopleCapture::UpdateMembers(std::int64_t capture_ns, UpdateObserver* observer) {
  for (const auto& member : members_) {
    if (!member->flesh) {
      if (!member->beside) member->capture->Update({VoxelGrid(), {}}, capture_ns, observer);
      continue;
    }
    Observation observation(member->flesh->flesh, member->outlines->own, member->box_W,
                            member->flesh->room, member->outlines->near);
    observation.keypoints = member->keypoints;
    if (options_.side && !posed_.empty() && !member->has_pose() && !member->beside)
      member->beside = options_.side->Begin(member->capture);
    if (member->beside) {
      member->beside->See(observation, capture_ns);
      continue;
    }
    member->capture->Update(observation, capture_ns, observer);
    // A lost person has a second to return, and may be hidden.
    if (member->is_lost() || member->outlines->cameras >= kLimits.least_cameras)
      member->seen_s = now_s_;
  }
}

void PeopleCapture::JudgeMembers() {
  const auto has_gone = [&](const std::unique_ptr<Member>& member) {
    const bool was_lost = member->id > 0 && !member->has_pose();
    return was_lost || now_s_ - member->seen_s > kLimits.brief_s;
  };
  if (members_.size() > 1) std::erase_if(members_, has_gone);
  if (members_.empty()) AddMember();
  const bool is_alone = members_.size() == 1;
  if (is_alone && !members_.front()->has_pose()) {
    Member& next = *members_.front();
    next.id = 0;
    next.SetName(next.is_expected ? expected_name_ : std::string(), 1);
    next.compared = {};
  }
  for (const auto& member : members_) {
    if (!member->is_lost()) member->strayed_mm = 0;
    if (member->id > 0 || !member->has_pose()) continue;
    // A phantom needs others; a single person is reported from the first fit on.
    const bool is_found = member->capture->result().state == CaptureState::kTracking;
    if (is_found || is_alone) member->id = ++last_id_;
  }
}

// Names people whose sizes have settled again.
void PeopleCapture::Recognise() {
  if (known_.empty()) return;
  for (const auto& member : members_) {
    if (member->id == 0 || !member->has_pose() || !member->name.empty()) continue;
    const BodySizes& sizes = member->capture->body().sizes();
    if (member->capture->acquisition_frames() == 0 || sizes == member->compared) continue;
    member->compared = sizes;
    std::vector<KnownPerson> absent = known_;
    std::erase_if(absent, [&](const KnownPerson& person) {
      return std::ranges::any_of(members_,
                                 [&](const auto& one) { return one->name == person.name; });
    });
    const Likeness likeness = WhoIs(sizes, absent);
    if (likeness.person && likeness.certainty >= kSureOfName)
      member->SetName(likeness.person->name, likeness.certainty);
  }
}

void PeopleCapture::ListPeople() {
  people_.clear();
  for (const auto& member : members_)
    if (member->id > 0)
      people_.push_back({member->id, member->capture.get(), member->name, member->certainty});
  std::ranges::sort(people_, {}, &PersonView::id);
}

}  // namespace mocap
