#include "tools/accuracy/takes_trial.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "config/config.h"
#include "config/load_config.h"
#include "config/open_studio.h"
#include "config/subject_file.h"
#include "core/errors.h"
#include "daemon/pipeline/pipeline.h"
#include "drivers/printable_text.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"
#include "tools/accuracy/first_sinks.h"
#include "tools/report/people_evaluation.h"
#include "tools/results/result_sink.h"

namespace mocap {
namespace {

/// One more than anybody expects, so that phantoms are seen.
constexpr int kMostInTake = 4;

std::string LastName(const std::filesystem::path& folder) {
  return std::filesystem::weakly_canonical(folder).filename().string();
}

bool IsTake(const std::filesystem::path& folder) {
  return IsThere(TakeLayout{folder}.Description());
}

TakesFolder TakesIn(const std::filesystem::path& folder) {
  RequireFolder(folder, "a folder of takes");
  TakesFolder found{.name = LastName(folder), .takes = {}};
  std::vector<std::filesystem::path> takes;
  if (IsTake(folder)) {
    takes.push_back(folder);
  } else {
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (IsTake(entry.path())) takes.push_back(entry.path());
  }
  std::ranges::sort(takes);
  for (const std::filesystem::path& take : takes) {
    if (ReadTruePeople(take).empty()) {
      found.remarks.push_back(take.string() + ": has no truth and is left out");
    } else {
      found.takes.push_back(take);
    }
  }
  if (found.takes.empty())
    throw SetupError(folder.string() + ": has no take with truth; expected a folder of takes");
  return found;
}

class TimesSink : public PoseSink {
 public:
  explicit TimesSink(PoseSink& sink) : sink_(sink) {}
  void OnSet(const TrackedSet& set) override {
    set_ns.push_back(set.capture_ns);
    sink_.OnSet(set);
  }

  std::vector<std::int64_t> set_ns;

 private:
  PoseSink& sink_;
};

PeopleResults PeopleOf(const ResultSink& sink, bool several_people) {
  PeopleResults people;
  if (!several_people) people.emplace_back("person", sink.result());
  for (const auto& [id, result] : sink.people()) people.emplace_back(std::to_string(id), result);
  return people;
}

/// Fills the sinks. @return  the capture times of all sets.
std::vector<std::int64_t> TrackTake(const std::filesystem::path& take, bool several_people,
                                    FirstSinks& sinks) {
  TimesSink times(sinks.own());
  const Config defaults;
  Pipeline pipeline(OpenTake(take, {}),
                    {.voxel_mm = defaults.voxel_mm,
                     .overflow = Overflow::kWait,
                     .latency_origin = LatencyOrigin::kArrival,
                     .tracker = defaults.tracker,
                     .people = several_people ? kMostInTake : 1,
                     .other_starts = sinks.others()},
                    LoadBodyTable(defaults.body), times);
  const std::filesystem::path subject = TakeLayout{take}.Subject();
  if (IsThere(subject)) pipeline.ChangeSubject(KnownPerson{"", LoadSubject(subject)});
  pipeline.Start();
  pipeline.Join();
  return times.set_ns;
}

/// Keeps the sets from this one on.
void KeepFrom(std::int64_t set, PeopleResults& people) {
  for (auto& [name, result] : people)
    std::erase_if(result.poses, [set](const PoseRow& row) { return row.frame < set; });
  std::erase_if(people, [](const auto& person) { return person.second.poses.empty(); });
}

/// Keeps the truth from this time on.
void KeepFromTime(std::int64_t from_ns, std::vector<TruePerson>& people) {
  for (TruePerson& person : people) {
    const auto first = std::ranges::find_if(
        person.truth.frames, [from_ns](const ScoredFrame& f) { return f.timestamp_ns >= from_ns; });
    const auto before = first - person.truth.frames.begin();
    person.truth.RemoveFirst(static_cast<std::size_t>(before));
    person.covered.erase(person.covered.begin(), person.covered.begin() + before);
  }
  std::erase_if(people, [](const TruePerson& person) { return person.truth.frames.empty(); });
}

/// True frames in which a person should be tracked.
std::vector<std::int64_t> WantedFrames(const TruePerson& person) {
  std::vector<std::int64_t> covered;
  for (std::size_t i = 0; i < person.covered.size(); ++i)
    if (person.covered[i]) covered.push_back(static_cast<std::int64_t>(i));
  return covered;
}

/// Collects the runs on a take.
class TakeScorer {
 public:
  TakeScorer(std::vector<TruePerson> truth, bool several_people)
      : truth_(std::move(truth)),
        several_people_(several_people),
        errors_(truth_.size()),
        extremities_(truth_.size()),
        switches_(truth_.size()) {}

  void Add(PeopleResults people) {
    for (std::vector<ErrorsBySet>& runs : errors_) runs.emplace_back();
    several_people_ ? AddSeveral(std::move(people)) : AddOne(std::move(people));
  }

  ScoredTake Row(const std::string& take) const {
    ScoredTake row{.people = {}, .stray_sets = stray_sets_};
    for (std::size_t i = 0; i < truth_.size(); ++i) {
      const std::vector<std::int64_t> wanted = WantedFrames(truth_[i]);
      if (wanted.empty()) continue;
      row.people.push_back({several_people_ ? take + '/' + truth_[i].name : take,
                            ScoreFirsts(errors_[i], wanted), switches_[i],
                            MeanOf(extremities_[i])});
    }
    return row;
  }

 private:
  void AddOne(PeopleResults people) {
    if (people.empty()) return;
    const Evaluation evaluation = EvaluateOne(std::move(people.front().second), truth_);
    for (const FrameError& error : evaluation.accuracy->frames)
      errors_.front().back()[error.truth] = error;
    extremities_.front().push_back(evaluation.extremities);
  }

  void AddSeveral(PeopleResults people) {
    const PeopleEvaluation evaluation = EvaluatePeople(std::move(people), truth_);
    stray_sets_ += evaluation.phantom_frames + evaluation.duplicate_frames;
    for (std::size_t i = 0; i < truth_.size(); ++i) switches_[i] += evaluation.followed[i].switches;
    for (const TrackedPerson& person : evaluation.people) {
      if (!person.evaluation.accuracy) continue;
      extremities_[static_cast<std::size_t>(person.true_person)].push_back(
          person.evaluation.extremities);
      for (const FrameError& error : person.evaluation.accuracy->frames) {
        const PersonMatch& match = person.matches[static_cast<std::size_t>(error.truth)];
        errors_[static_cast<std::size_t>(match.person)].back()[match.frame] = error;
      }
    }
  }

  const std::vector<TruePerson> truth_;
  const bool several_people_;
  std::vector<std::vector<ErrorsBySet>> errors_;             ///< Of each person, by run.
  std::vector<std::vector<ExtremityAccuracy>> extremities_;  ///< Likewise.
  std::vector<int> switches_;
  int stray_sets_ = 0;
};

}  // namespace

std::vector<TakesFolder> FoldersOfTakes(const std::vector<std::filesystem::path>& folders) {
  std::vector<TakesFolder> found;
  for (const std::filesystem::path& folder : folders) {
    TakesFolder takes = TakesIn(folder);
    if (std::ranges::find(found, takes.name, &TakesFolder::name) != found.end())
      throw SetupError("--takes: names two folders " + takes.name + "; expected different names");
    found.push_back(std::move(takes));
  }
  return found;
}

ScoredTake RunTakeTrial(const std::filesystem::path& take, int firsts) {
  MOCAP_CHECK(firsts > 0);
  std::vector<TruePerson> truth = ReadTruePeople(take);
  const bool several_people = truth.size() > 1;
  FirstSinks sinks(firsts, several_people ? KeptPeople::kEverybody : KeptPeople::kFirst);
  const std::vector<std::int64_t> set_ns = TrackTake(take, several_people, sinks);
  const auto wanted = static_cast<std::size_t>(firsts);
  if (set_ns.size() < wanted)
    throw SetupError(take.string() + ": has " + Counted(set_ns.size(), "frame set") +
                     "; expected at least " + std::to_string(firsts));
  // Between the last set that a run leaves out and the first one that all track.
  KeepFromTime(firsts == 1 ? std::numeric_limits<std::int64_t>::min()
                           : std::midpoint(set_ns[wanted - 2], set_ns[wanted - 1]),
               truth);
  if (truth.empty())
    throw SetupError(take.string() + ": has no truth from set " + std::to_string(firsts - 1) +
                     " on");
  TakeScorer scorer(std::move(truth), several_people);
  for (const ResultSink& sink : sinks.all()) {
    PeopleResults people = PeopleOf(sink, several_people);
    KeepFrom(firsts - 1, people);
    scorer.Add(std::move(people));
  }
  return scorer.Row(LastName(take));
}

}  // namespace mocap
