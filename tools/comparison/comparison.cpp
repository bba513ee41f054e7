#include "tools/comparison/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "drivers/printable_text.h"
#include "drivers/quoted.h"
#include "tools/comparison/ground_pelvis.h"
#include "tools/comparison/text_motion.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

/// Paired points that are farther apart are hardly of the same motion [mm]: as far as a marker on
/// the skin can be from the joint below it.
constexpr double kAlike_mm = 150;
/// Skin moves over the bone by up to this (Leardini et al. 2005), also without bias [mm].
constexpr double kSkin_mm = 30;

struct Person {
  std::string name;
  Result result;
  ResultMotion motion;
};

/// Times that are wrong by orders of magnitude would need memory for all that they span.
void RequireADay(const RecordedMotion& motion, const std::filesystem::path& file) {
  constexpr double kDay_s = 86'400;
  if (motion.Seconds() <= kDay_s) return;
  throw SetupError(fmt::format("{}: spans {:.0f} s; expected at most a day",
                               Printable(file.string()), motion.Seconds()));
}

std::vector<Person> ReadPersons(const ComparisonRequest& request,
                                std::vector<std::string>& remarks) {
  PeopleResults people;
  if (IsOfPeople(request.result)) {
    people = ReadPeople(request.result, request.prefix);
  } else {
    people.emplace_back("", ReadResult(request.result, request.prefix));
  }
  std::vector<Person> persons;
  for (auto& [name, result] : people) {
    remarks.insert(remarks.end(), result.remarks.begin(), result.remarks.end());
    if (request.person && name != *request.person) continue;
    if (std::ranges::none_of(result.poses, IsTracked)) continue;
    ResultMotion motion = MotionOf(result);
    RequireADay(motion.motion, request.result);
    persons.push_back({name, std::move(result), std::move(motion)});
  }
  if (!persons.empty()) return persons;
  throw SetupError(Printable(request.result.string()) +
                   (request.person ? ": has no tracked " + Printable(*request.person)
                                   : ": has no tracked frame; expected at least one"));
}

std::vector<RecordedMotion> ChosenSubjects(const ComparisonRequest& request, MotionFile& file) {
  if (!request.subject) return std::move(file.subjects);
  std::vector<std::string> names;
  for (RecordedMotion& subject : file.subjects) {
    if (subject.subject == *request.subject) return {std::move(subject)};
    names.push_back(Printable(subject.subject));
  }
  throw SetupError(Printable(request.other.string()) + ": has no subject " +
                   Quoted(*request.subject) + "; " + ExpectedNames(*request.subject, names));
}

/// Pairs of the map, and those of conventions for points and markers that it does not name.
std::vector<NamedPair> NamesFor(const NameMap& map, const RecordedMotion& other) {
  std::vector<NamedPair> names = map.points;
  std::set<std::string> points, markers;
  for (const NamedPair& pair : map.points) {
    points.insert(pair.point);
    markers.insert(pair.others.begin(), pair.others.end());
  }
  for (NamedPair& pair : PairsByName(other)) {
    const bool is_named =
        points.contains(pair.point) ||
        std::ranges::any_of(pair.others, [&](const auto& name) { return markers.contains(name); });
    if (!is_named) names.push_back(std::move(pair));
  }
  return names;
}

void RequireMapped(const NameMap& map, const RecordedMotion& other,
                   const ComparisonRequest& request) {
  std::vector<std::string> markers;
  for (const PointTrack& track : other.points) markers.push_back(Printable(track.name));
  for (const NamedPair& pair : map.points)
    for (const std::string& name : pair.others)
      if (other.FindPoint(name) == nullptr)
        throw SetupError(Printable(request.map.string()) + ": names the marker " + Quoted(name) +
                         ", which " + Printable(request.other.string()) + " does not have; " +
                         ExpectedNames(name, markers));
}

/// Angles of both recordings by the map, and by equal names.
std::vector<AnglePair> AnglesFor(const NameMap& map, const RecordedMotion& own,
                                 const RecordedMotion& other) {
  std::vector<AnglePair> pairs = map.angles;
  for (const AngleCurve& track : own.angles) {
    const bool is_mapped =
        std::ranges::find(map.angles, track.name, &AnglePair::own) != map.angles.end();
    if (!is_mapped && other.FindAngle(track.name)) pairs.push_back({track.name, track.name});
  }
  return pairs;
}

/// Older models of OpenSim count a bent knee as negative. No knee bends backward by so much.
void TurnBackwardKnees(const RecordedMotion& other, std::vector<AnglePair>& angles,
                       std::vector<std::string>& remarks) {
  constexpr double kBackward_deg = -30;
  for (AnglePair& pair : angles) {
    if (!pair.own.starts_with("knee_angle_") || pair.own != pair.other) continue;
    const std::vector<double>& deg = other.FindAngle(pair.other)->deg;
    double low = 0, high = 0;
    for (const double value : deg) {
      low = std::fmin(low, value);
      high = std::fmax(high, value);
    }
    if (low > kBackward_deg || high > -kBackward_deg) continue;
    pair.sign = -1;
    remarks.push_back(pair.own + ": negative when bent, as in gait2354; its sign is turned");
  }
}

std::optional<Alignment> AlignPoints(const ResultMotion& own, const RecordedMotion& other,
                                     const std::vector<NamedPair>& names) {
  std::optional<Alignment> named = AlignByNames(own, other, names);
  if (named && named->median_mm <= kAlike_mm) return named;
  std::optional<Alignment> moved = AlignByMotion(own, other);
  if (!named) return moved;
  // Names are wrong only if motion brings as many points together, and much closer.
  constexpr double kMuchCloser = 3;
  if (moved && moved->pairs.size() >= named->pairs.size() &&
      kMuchCloser * moved->median_mm < named->median_mm)
    return moved;
  return named;
}

double MeanCorrelationOf(const std::vector<AngleComparison>& angles) {
  std::vector<double> correlations;
  for (const AngleComparison& angle : angles) correlations.push_back(angle.correlation);
  return AgreementOf(correlations).bias;
}

/// Remarks why recordings may not be of the same motion: an offset is found for any two that move.
void AddDoubts(double own_seconds, Comparison& comparison) {
  std::string doubt;
  // Of curves that correlate by less, one explains less than half of the other's variance.
  constexpr double kAlike = 0.7;
  const double correlation = MeanCorrelationOf(comparison.angles);
  if (comparison.alignment.median_mm > kAlike_mm) {
    doubt = fmt::format("paired points are {:.0f} mm apart in the median",
                        comparison.alignment.median_mm);
  } else if (comparison.points_rmsd_without_bias_mm > kSkin_mm) {
    doubt = fmt::format("points differ by {:.0f} mm RMSD even without bias",
                        comparison.points_rmsd_without_bias_mm);
  } else if (comparison.alignment.by == PairedBy::kAngles && !(correlation > kAlike)) {
    doubt = fmt::format("angles correlate by {:.2f} in the mean", correlation);
  }
  if (!doubt.empty())
    comparison.remarks.push_back(doubt + "; this may not be the same motion, or person");
  const double shorter_s = std::min(own_seconds, comparison.other_seconds);
  const double shared_s =
      comparison.time_s.empty() ? 0 : comparison.time_s.back() - comparison.time_s.front();
  if (shared_s < shorter_s / 2) {
    comparison.remarks.push_back(
        fmt::format("{:.1f} s are in both recordings, of {:.1f} s of the shorter one; the offset "
                    "may be wrong",
                    shared_s, shorter_s));
  }
}

/// Compares a person with a subject. @return  empty if they have nothing in common.
std::optional<Comparison> CompareOne(const Person& person, RecordedMotion other, const NameMap& map,
                                     const std::string& format) {
  Comparison comparison;
  comparison.person = person.name;
  comparison.subject = other.subject;
  comparison.format = format;
  comparison.other_rate_hz = other.Period() > 0 ? 1 / other.Period() : 0;
  comparison.other_seconds = other.Seconds();
  comparison.other_frames = other.time_s.size();
  if (!other.has_unit) {
    comparison.remarks.push_back(
        fmt::format("no unit is stated; lengths are taken as {}, by the person's size",
                    ScaleLike(person.motion.motion, other)));
  }
  ResultMotion own = person.motion;
  if (!other.joints.empty()) {
    SkeletonAngles angles = JointAnglesOf(person.result, other);
    own.motion.angles = std::move(angles.result);
    other.angles = std::move(angles.other);
  }
  for (AngleCurve& track : other.angles) Unwrap(track.deg);
  std::vector<AnglePair> angles = AnglesFor(map, own.motion, other);
  TurnBackwardKnees(other, angles, comparison.remarks);
  std::optional<Alignment> alignment = AlignPoints(own, other, NamesFor(map, other));
  const bool by_angles = !alignment;
  if (by_angles) alignment = AlignByAngles(own, other, angles);
  if (!alignment) return {};
  // OpenSim's ground has y up; other tables are in a world like ours.
  const RigidTransform ground =
      by_angles ? alignment->X : RigidTransform{alignment->X.R * YUpFromWorld().transpose()};
  ToOurGround(own, ground, alignment->offset_s, other);
  comparison.alignment = std::move(*alignment);
  Measure(own, other, angles, comparison);
  AddDoubts(own.motion.Seconds(), comparison);
  std::set<std::string> used;
  for (const PointComparison& point : comparison.points)
    used.insert(point.others.begin(), point.others.end());
  for (const PointTrack& track : other.points)
    if (!used.contains(track.name)) comparison.not_compared.push_back(track.name);
  return comparison;
}

/// Whether one comparison fits better. Points tell more than angles.
bool FitsBetter(const Comparison& one, const Comparison& other) {
  if (one.points.empty() != other.points.empty()) return other.points.empty();
  if (one.points.empty())
    return one.angles_rmsd_without_bias_deg < other.angles_rmsd_without_bias_deg;
  return one.points_rmsd_without_bias_mm < other.points_rmsd_without_bias_mm;
}

}  // namespace

Comparison Compare(const ComparisonRequest& request) {
  const NameMap map = request.map.empty() ? NameMap() : ReadNameMap(request.map);
  std::vector<std::string> remarks;
  const std::vector<Person> persons = ReadPersons(request, remarks);
  MotionFile file = ReadMotionFile(request.other, request.prefix);
  remarks.insert(remarks.end(), file.remarks.begin(), file.remarks.end());
  const std::vector<RecordedMotion> subjects = ChosenSubjects(request, file);
  for (const RecordedMotion& subject : subjects) RequireADay(subject, request.other);
  if (subjects.size() == 1) RequireMapped(map, subjects.front(), request);
  std::optional<Comparison> best;
  for (const Person& person : persons) {
    for (const RecordedMotion& subject : subjects) {
      std::optional<Comparison> one = CompareOne(person, subject, map, file.format);
      if (one && (!best || FitsBetter(*one, *best))) best = std::move(one);
    }
  }
  if (!best) {
    throw SetupError(Printable(request.other.string()) +
                     ": has no three points and no angle that move like those of " +
                     Printable(request.result.string()) +
                     "; expected the same motion, or names by --map");
  }
  best->remarks.insert(best->remarks.begin(), remarks.begin(), remarks.end());
  return std::move(*best);
}

}  // namespace mocap
