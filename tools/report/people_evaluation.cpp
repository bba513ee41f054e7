#include "tools/report/people_evaluation.h"

#include <algorithm>

#include "tools/results/export_axes.h"
#include "tools/results/take_identity.h"

namespace mocap {
namespace {

/// Poses of another take, or times in another unit, would be "no tracked frame has truth".
void TellOfOtherTimes(const std::filesystem::path& take, const std::vector<TruePerson>& truth,
                      Result& result) {
  if (truth.empty() || result.poses.empty()) return;
  std::int64_t first_ns = truth.front().truth.frames.front().timestamp_ns;
  std::int64_t last_ns = first_ns;
  for (const TruePerson& person : truth) {
    first_ns = std::min(first_ns, person.truth.frames.front().timestamp_ns);
    last_ns = std::max(last_ns, person.truth.frames.back().timestamp_ns);
  }
  const std::int64_t from_ns = result.poses.front().timestamp_ns;
  const std::int64_t to_ns = result.poses.back().timestamp_ns;
  if (from_ns <= last_ns && first_ns <= to_ns) return;
  result.remarks.push_back(take.string() + ": its truth is of " + std::to_string(first_ns) +
                           " to " + std::to_string(last_ns) + " ns, the result of " +
                           std::to_string(from_ns) + " to " + std::to_string(to_ns) +
                           " ns: nothing can be compared");
}

std::string NameOf(const std::filesystem::path& take) {
  return std::filesystem::weakly_canonical(take).filename().string();
}

std::vector<ScoredFrame> OutputOf(const Result& result) {
  std::vector<ScoredFrame> frames;
  for (const PoseRow& row : result.poses) {
    frames.push_back({row.timestamp_ns, IsTracked(row), ScoredPointsOf(row.points_W)});
  }
  return frames;
}

std::vector<MatchedPerson> MatchAll(const PeopleResults& people,
                                    const std::vector<TruePerson>& truth) {
  std::vector<std::vector<ScoredFrame>> outputs, truths;
  for (const auto& [name, result] : people) outputs.push_back(OutputOf(result));
  for (const TruePerson& person : truth) truths.push_back(person.truth.frames);
  return MatchPeople(truths, outputs);
}

int MostOften(const std::vector<PersonMatch>& matches, std::size_t people) {
  std::vector<int> frames(people);
  for (const PersonMatch& match : matches) ++frames[static_cast<std::size_t>(match.person)];
  const auto most = std::ranges::max_element(frames);
  return most == frames.end() || *most == 0 ? -1 : static_cast<int>(most - frames.begin());
}

/// Scores a result in the frames that match any person.
void Score(const std::vector<TruePerson>& truth, TrackedPerson& person) {
  if (person.true_person < 0) return;
  Evaluation& evaluation = person.evaluation;
  // Sizes are compared with the most frequent match.
  evaluation.truth = truth[static_cast<std::size_t>(person.true_person)].truth;
  evaluation.truth->frames.clear();
  evaluation.truth->numbers.clear();
  evaluation.truth->extremities.clear();
  std::vector<ScoredFrame> output;
  for (const PersonMatch& match : person.matches) {
    const TakeTruth& other = truth[static_cast<std::size_t>(match.person)].truth;
    evaluation.truth->Add(other, static_cast<std::size_t>(match.frame));
    const PoseRow& row = evaluation.result.poses[static_cast<std::size_t>(match.pose)];
    output.push_back({row.timestamp_ns, true, ScoredPointsOf(row.points_W)});
  }
  evaluation.accuracy = MeasureAccuracy(evaluation.truth->frames, output);
  for (FrameError& error : evaluation.accuracy->frames) {
    error.pose = person.matches[static_cast<std::size_t>(error.pose)].pose;
  }
  evaluation.extremities =
      MeasureExtremities(evaluation.result, *evaluation.truth, evaluation.accuracy->frames);
  evaluation.certainty = MeasureCertainty(evaluation.result.poses, evaluation.accuracy);
  evaluation.lengths = CompareLengths(evaluation.result.body.sizes, *evaluation.truth);
}

FollowedTruth FollowedOf(int person, const TruePerson& truth,
                         const std::vector<TrackedPerson>& people) {
  struct Follower {
    int tracked = -1;
    double mean_mm = 0;
  };
  std::vector<Follower> followers(truth.truth.frames.size());
  for (std::size_t i = 0; i < people.size(); ++i) {
    for (const PersonMatch& match : people[i].matches) {
      if (match.person != person) continue;
      followers[static_cast<std::size_t>(match.frame)] = {static_cast<int>(i), match.mean_mm};
    }
  }
  FollowedTruth followed;
  followed.frames = static_cast<int>(followers.size());
  int last = -1;
  for (std::size_t frame = 0; frame < followers.size(); ++frame) {
    const auto [tracked, mean_mm] = followers[frame];
    followed.covered += truth.covered[frame];
    if (tracked < 0) continue;
    ++followed.found;
    followed.found_covered += truth.covered[frame];
    followed.switches += last >= 0 && tracked != last;
    followed.mean_mm += mean_mm;
    last = tracked;
  }
  if (followed.found > 0) followed.mean_mm /= followed.found;
  return followed;
}

FollowedTruth SumOf(const std::vector<FollowedTruth>& all) {
  FollowedTruth sum;
  for (const FollowedTruth& one : all) {
    sum.frames += one.frames;
    sum.covered += one.covered;
    sum.found += one.found;
    sum.found_covered += one.found_covered;
    sum.switches += one.switches;
    sum.mean_mm += one.mean_mm * one.found;
  }
  if (sum.found > 0) sum.mean_mm /= sum.found;
  return sum;
}

}  // namespace

PeopleEvaluation EvaluatePeople(PeopleResults people, std::vector<TruePerson> truth) {
  PeopleEvaluation evaluation;
  std::vector<MatchedPerson> matched = MatchAll(people, truth);
  for (std::size_t i = 0; i < people.size(); ++i) {
    TrackedPerson& person = evaluation.people.emplace_back();
    person.name = people[i].first;
    person.evaluation = Evaluate(std::move(people[i].second), std::nullopt);
    person.matches = std::move(matched[i].matches);
    person.true_person = MostOften(person.matches, truth.size());
    Score(truth, person);
    if (truth.empty()) continue;
    const auto tracked = std::ranges::count_if(person.evaluation.result.poses, IsTracked);
    person.duplicate_frames = matched[i].duplicates;
    person.phantom_frames = static_cast<int>(tracked) - static_cast<int>(person.matches.size()) -
                            person.duplicate_frames;
    evaluation.phantom_frames += person.phantom_frames;
    evaluation.duplicate_frames += person.duplicate_frames;
  }
  for (std::size_t i = 0; i < truth.size(); ++i) {
    evaluation.followed.push_back(FollowedOf(static_cast<int>(i), truth[i], evaluation.people));
  }
  evaluation.sum = SumOf(evaluation.followed);
  evaluation.truth = std::move(truth);
  return evaluation;
}

Evaluation EvaluateOne(Result result, const std::vector<TruePerson>& truth) {
  if (truth.empty()) return Evaluate(std::move(result), std::nullopt);
  if (truth.size() == 1) return Evaluate(std::move(result), truth.front().truth);
  PeopleResults person;
  person.emplace_back("", std::move(result));
  return std::move(EvaluatePeople(std::move(person), truth).people.front().evaluation);
}

Evaluation EvaluateOne(const std::filesystem::path& take, const std::filesystem::path& result,
                       const std::optional<std::string>& prefix) {
  const TakeIdentity identity(take);
  const std::vector<TruePerson> truth = ReadTruePeople(take);
  Result read = ReadResult(result, prefix);
  identity.Require(result, read);
  TellOfOtherTimes(take, truth, read);
  Evaluation evaluation = EvaluateOne(std::move(read), truth);
  evaluation.take = NameOf(take);
  return evaluation;
}

PeopleEvaluation EvaluatePeople(const std::filesystem::path& take,
                                const std::filesystem::path& result,
                                const std::optional<std::string>& prefix) {
  const TakeIdentity identity(take);
  std::vector<TruePerson> truth = ReadTruePeople(take);
  PeopleResults people = ReadPeople(result, prefix);
  for (auto& [name, read] : people) {
    identity.Require(IsOfPeople(result) ? result / name : result, read);
    TellOfOtherTimes(take, truth, read);
  }
  PeopleEvaluation evaluation = EvaluatePeople(std::move(people), std::move(truth));
  evaluation.take = NameOf(take);
  return evaluation;
}

}  // namespace mocap
