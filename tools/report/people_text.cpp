#include "tools/report/people_text.h"

#include <fmt/format.h>

#include <vector>

#include "daemon/base/json.h"
#include "drivers/printable_text.h"
#include "tools/report/evaluation_text.h"

namespace mocap {
namespace {

double FoundShare(const FollowedTruth& followed) {
  return followed.found_covered / static_cast<double>(followed.covered);
}

int TrackedFrames(const Evaluation& evaluation) {
  return evaluation.frames_in_state[static_cast<std::size_t>(CaptureState::kTracking)];
}

std::string NameOfTruth(const PeopleEvaluation& evaluation, const TrackedPerson& person) {
  if (person.true_person < 0) return "-";
  return evaluation.truth[static_cast<std::size_t>(person.true_person)].name;
}

std::string TrackedTable(const PeopleEvaluation& evaluation) {
  const bool has_truth = !evaluation.truth.empty();
  std::string text = fmt::format("{:<12}{:>8}{:>9}{:>13}{:>12}", "tracked", "frames", "tracked",
                                 "fit mm", "stature mm");
  text += has_truth ? fmt::format("  {:<12}{:>9}{:>10}{:>11}\n", "true person", "error mm",
                                  "phantom", "duplicate")
                    : "\n";
  for (const TrackedPerson& person : evaluation.people) {
    const Evaluation& one = person.evaluation;
    text += fmt::format("{:<12}{:>8}{:>9}{:>13.1f}{:>12.0f}", Printable(person.name),
                        one.result.poses.size(), TrackedFrames(one), one.mean_residual_mm,
                        one.result.body.stature_mm);
    if (!has_truth) {
      text += '\n';
      continue;
    }
    const bool is_scored = one.accuracy && !one.accuracy->frames.empty();
    text += fmt::format("  {:<12}{:>9}{:>10}{:>11}\n", Printable(NameOfTruth(evaluation, person)),
                        is_scored ? fmt::format("{:.1f}", one.accuracy->distance_mm.mean) : "-",
                        person.phantom_frames, person.duplicate_frames);
  }
  return text;
}

std::string TrueRow(const std::string& name, const FollowedTruth& followed) {
  const std::string error = followed.found > 0 ? fmt::format("{:.1f}", followed.mean_mm) : "-";
  const std::string share =
      followed.covered > 0 ? fmt::format("{:.1f} %", 100 * FoundShare(followed)) : "-";
  return fmt::format("{:<12}{:>8}{:>9}{:>13}{:>21}  {:<3}{:>9}{:>10}\n", name, followed.frames,
                     followed.found, followed.covered, share, "", error, followed.switches);
}

std::string TrueTable(const PeopleEvaluation& evaluation) {
  std::string text =
      fmt::format("\n{:<12}{:>8}{:>9}{:>13}{:>21}  {:<3}{:>9}{:>10}\n", "true", "frames", "found",
                  "covered", "found while covered", "", "error mm", "switches");
  for (std::size_t i = 0; i < evaluation.truth.size(); ++i) {
    text += TrueRow(Printable(evaluation.truth[i].name), evaluation.followed[i]);
  }
  text += TrueRow("all", evaluation.sum);
  return text +
         fmt::format(
             "\n{}\nframes of tracks without a person (phantom): {}\nframes of second tracks of "
             "the same person (duplicate): {}\n",
             kTrueColumnsText, evaluation.phantom_frames, evaluation.duplicate_frames);
}

Json FollowedJson(const FollowedTruth& followed) {
  Json json = Json::object();
  json["frames"] = followed.frames;
  json["found_frames"] = followed.found;
  json["covered_frames"] = followed.covered;
  if (followed.covered > 0) json["found_while_covered_share"] = Rounded(FoundShare(followed), 4);
  json["switches"] = followed.switches;
  if (followed.found > 0) json["mpjpe_mm"] = Rounded(followed.mean_mm, 1);
  return json;
}

/// Of all tracked people.
ProbabilityCheck ProbabilitiesOf(const PeopleEvaluation& evaluation) {
  ProbabilityCheck all;
  for (const TrackedPerson& person : evaluation.people) {
    const auto& certainty = person.evaluation.certainty;
    if (certainty && certainty->check) all.Add(certainty->check->probabilities);
  }
  return all;
}

}  // namespace

std::string CountedPeople(std::size_t count) {
  return count == 1 ? "1 person" : std::to_string(count) + " people";
}

std::string PeopleText(const PeopleEvaluation& evaluation) {
  std::string text =
      Printable(evaluation.take) + ": " + CountedPeople(evaluation.people.size()) + " tracked";
  if (evaluation.truth.empty()) {
    return text + "\n\n" + TrackedTable(evaluation) + "\naccuracy    the take has no truth\n";
  }
  return text + ", " + CountedPeople(evaluation.truth.size()) + " there\n\n" +
         TrackedTable(evaluation) + TrueTable(evaluation) +
         ProbabilityTable(ProbabilitiesOf(evaluation));
}

std::string PeopleJson(const PeopleEvaluation& evaluation) {
  Json people = Json::array(), truth = Json::array();
  for (const TrackedPerson& person : evaluation.people) {
    Json& json = people.emplace_back();
    json["name"] = person.name;
    if (!evaluation.truth.empty()) {
      json["true_person"] = NameOfTruth(evaluation, person);
      json["phantom_frames"] = person.phantom_frames;
      json["duplicate_frames"] = person.duplicate_frames;
    }
    AddEvaluation(person.evaluation, json);
  }
  for (std::size_t i = 0; i < evaluation.truth.size(); ++i) {
    Json& json = truth.emplace_back();
    json["name"] = evaluation.truth[i].name;
    json["followed"] = FollowedJson(evaluation.followed[i]);
  }
  Json json = Json::object();
  json["take"] = evaluation.take;
  json["people"] = people;
  if (!evaluation.truth.empty()) {
    json["truth"] = truth;
    json["all"] = FollowedJson(evaluation.sum);
    const ProbabilityCheck probabilities = ProbabilitiesOf(evaluation);
    if (!probabilities.IsEmpty()) json["probabilities"] = ProbabilityJson(probabilities);
    json["phantom_frames"] = evaluation.phantom_frames;
    json["duplicate_frames"] = evaluation.duplicate_frames;
  }
  return JsonText(json) + '\n';
}

}  // namespace mocap
