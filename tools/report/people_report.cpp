#include "tools/report/people_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "drivers/printable_text.h"
#include "tools/report/people_text.h"
#include "tools/report/report.h"
#include "tools/report/report_figures.h"
#include "tools/report/report_pictures.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

constexpr int kFigures = 8;

int FigureOf(std::size_t person) { return static_cast<int>(person % kFigures); }

Json Named(const std::string& name, std::size_t person) {
  return {{"text", name}, {"figure", FigureOf(person)}};
}

Json FoundPercent(const FollowedTruth& followed) {
  if (followed.covered == 0) return nullptr;
  return NumberOrNull(100.0 * followed.found_covered / followed.covered);
}

Json ErrorOf(const FollowedTruth& followed) {
  return followed.found > 0 ? NumberOrNull(followed.mean_mm) : Json();
}

Json PeopleTiles(const PeopleEvaluation& evaluation) {
  Json tiles = Json::array(
      {Tile("Tracked people", evaluation.people.size(), 0, "",
            evaluation.truth.empty() ? "the take has no truth"
                                     : fmt::format("{} were there", evaluation.truth.size()))});
  if (evaluation.truth.empty()) return Tiles(tiles);
  const FollowedTruth& sum = evaluation.sum;
  tiles.push_back(Tile("Error of 14 points", ErrorOf(sum), 1, "mm", "mean over all people found"));
  tiles.push_back(Tile("Found while covered", FoundPercent(sum), 1, "%",
                       fmt::format("of {}", Counted(sum.covered, "frame"))));
  tiles.push_back(Tile("Switches", sum.switches, 0, "", "tracks that changed person"));
  tiles.push_back(
      Tile("Phantom frames", evaluation.phantom_frames, 0, "", "tracks without a person"));
  tiles.push_back(Tile("Duplicate frames", evaluation.duplicate_frames, 0, "",
                       "second tracks of the same person"));
  return Tiles(tiles);
}

/// A band of states for each person, over the take's frames.
Json Bands(const PeopleEvaluation& evaluation) {
  Json people = Json::array();
  for (std::size_t i = 0; i < evaluation.people.size(); ++i) {
    const TrackedPerson& person = evaluation.people[i];
    people.push_back(StateBand(person.name, FigureOf(i), person.evaluation));
  }
  return StateBands(people);
}

Json TrackedSection(const PeopleEvaluation& evaluation) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < evaluation.people.size(); ++i) {
    const TrackedPerson& person = evaluation.people[i];
    const Evaluation& one = person.evaluation;
    const bool is_scored = one.accuracy && !one.accuracy->frames.empty();
    rows.push_back({Named(person.name, i), one.result.poses.size(),
                    NumberOrNull(one.mean_residual_mm), NumberOrNull(one.result.body.stature_mm),
                    person.true_person < 0
                        ? "–"
                        : evaluation.truth[static_cast<std::size_t>(person.true_person)].name,
                    is_scored ? NumberOrNull(one.accuracy->distance_mm.mean) : Json(),
                    person.phantom_frames, person.duplicate_frames});
  }
  return Table({{"tracked"},
                {"frames", 0},
                {"fit mm", 1},
                {"stature mm", 0},
                {"true person"},
                {"error mm", 1},
                {"phantom", 0},
                {"duplicate", 0}},
               rows);
}

void AddTrueTable(const PeopleEvaluation& evaluation, Json& sections) {
  if (evaluation.truth.empty()) return;
  Json rows = Json::array();
  const auto add = [&rows](const std::string& name, const FollowedTruth& followed) {
    rows.push_back({name, followed.frames, followed.found, followed.covered, FoundPercent(followed),
                    followed.switches, ErrorOf(followed)});
  };
  for (std::size_t i = 0; i < evaluation.truth.size(); ++i)
    add(evaluation.truth[i].name, evaluation.followed[i]);
  add("all", evaluation.sum);
  sections.push_back(Table({{"true"},
                            {"frames", 0},
                            {"found", 0},
                            {"covered", 0},
                            {"found while covered %", 1},
                            {"switches", 0},
                            {"error mm", 1}},
                           rows));
  sections.push_back(Paragraph(std::string(kTrueColumnsText)));
}

/// Every person's row at a time.
std::vector<ViewedBody> EverybodyAt(const PeopleEvaluation& evaluation, std::int64_t time_ns) {
  std::vector<ViewedBody> bodies;
  for (std::size_t i = 0; i < evaluation.people.size(); ++i) {
    const Result& result = evaluation.people[i].evaluation.result;
    const auto row = std::ranges::find(result.poses, time_ns, &PoseRow::timestamp_ns);
    if (row != result.poses.end()) bodies.push_back({*row, result.body.sizes, FigureOf(i)});
  }
  return bodies;
}

/// Everyone's error. People come and go, so each curve has frames of its own.
Json ErrorsFigure(const PeopleEvaluation& evaluation) {
  Json series = Json::array();
  for (std::size_t i = 0; i < evaluation.people.size(); ++i) {
    const TrackedPerson& person = evaluation.people[i];
    Json frames = Json::array();
    for (const PoseRow& row : person.evaluation.result.poses) frames.push_back(row.frame);
    series.push_back(
        Series(person.name, FigureOf(i), "line", ErrorCurve(person.evaluation), {{"x", frames}}));
  }
  return Figure("Distance from the truth", "mean of 14 points.",
                Json::array({{{"x", {{"label", "frame number"}}},
                              {"y", {{"label", "error [mm]"}}},
                              {"height", 160},
                              {"series", series}}}));
}

std::vector<double> FramesOf(const PeopleEvaluation& evaluation, const TakeSamples& samples) {
  std::vector<double> frames;
  for (const SampledMoment& moment : samples.moments) {
    const std::vector<ViewedBody> bodies = EverybodyAt(evaluation, moment.timestamp_ns);
    frames.push_back(bodies.empty() ? std::nan("") : static_cast<double>(bodies.front().row.frame));
  }
  return frames;
}

}  // namespace

std::vector<SampleRequest> ChooseReportMoments(const PeopleEvaluation& evaluation) {
  std::set<std::int64_t> tracked_ns;
  for (const TrackedPerson& person : evaluation.people) {
    for (const PoseRow& row : person.evaluation.result.poses) {
      if (IsTracked(row)) tracked_ns.insert(row.timestamp_ns);
    }
  }
  return ChooseReportMoments(std::vector<std::int64_t>(tracked_ns.begin(), tracked_ns.end()));
}

std::string PeopleReportHtml(const PeopleEvaluation& evaluation, const TakeSamples& samples,
                             const std::vector<CameraOverlap>& overlaps) {
  Json sections = {PeopleTiles(evaluation), Bands(evaluation), TrackedSection(evaluation)};
  AddTrueTable(evaluation, sections);
  Json paths = Json::array(), details = Json::array();
  for (std::size_t i = 0; i < evaluation.people.size(); ++i) {
    const TrackedPerson& person = evaluation.people[i];
    paths.push_back(TorsoPath(person.evaluation, person.name, FigureOf(i)));
    if (person.evaluation.first_tracked_pose < 0) continue;
    details.push_back({{"type", "details"},
                       {"name", person.name},
                       {"figure", FigureOf(i)},
                       {"sections", TrackingSections(person.evaluation, samples)}});
  }
  sections.push_back(Heading("Camera views"));
  std::int64_t start_ns = std::numeric_limits<std::int64_t>::max();
  for (const TrackedPerson& person : evaluation.people) {
    for (const PoseRow& row : person.evaluation.result.poses)
      start_ns = std::min(start_ns, row.timestamp_ns);
  }
  sections.push_back(PictureSection(samples, overlaps, start_ns, [&](std::int64_t time_ns) {
    return EverybodyAt(evaluation, time_ns);
  }));
  sections.push_back(Heading("Everybody"));
  sections.push_back(PathsFigure("Paths of the torsos", samples, paths));
  if (!evaluation.truth.empty()) sections.push_back(ErrorsFigure(evaluation));
  sections.push_back(Heading("Each person"));
  Append(details, sections);
  Append(OverlapSections(FramesOf(evaluation, samples), overlaps), sections);
  return ReportHtml(evaluation.take,
                    CountedPeople(evaluation.people.size()) + " tracked, " +
                        Counted(samples.cameras.size(), "camera"),
                    sections);
}

}  // namespace mocap
