#include "tools/solving/take_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/solving/path_smoother.h"
#include "core/solving/take_sizes.h"
#include "tools/job_pool.h"
#include "tools/solving/linked_tracks.h"

namespace mocap {
namespace {

/// A take is solved in parts, so that memory does not grow with it, each with some time before and
/// after: what lies farther away decides nothing.
struct PartLengths {
  double length_s = 20, margin_s = 3;
};
constexpr PartLengths kParts{};

/// A part of the sets: [begin, end), and with its margins [from, to).
struct Part {
  int begin, end, from, to;
};

std::vector<Part> PartsOf(const SpoolIndex& index) {
  const auto& ns = index.capture_ns;
  std::vector<Part> parts;
  if (ns.empty()) return parts;
  const int sets = static_cast<int>(ns.size());
  const auto set_at = [&](double s) {
    const auto at_ns = ns.front() + static_cast<std::int64_t>(s * 1e9);
    return static_cast<int>(std::ranges::lower_bound(ns, at_ns) - ns.begin());
  };
  const double whole_s = static_cast<double>(ns.back() - ns.front()) * 1e-9;
  const int count = std::max(1, static_cast<int>(whole_s / kParts.length_s));
  for (int i = 0; i < count; ++i) {
    const double begin_s = i * kParts.length_s, end_s = begin_s + kParts.length_s;
    const bool is_last = i + 1 == count;
    const Part part{set_at(begin_s), is_last ? sets : set_at(end_s),
                    set_at(begin_s - kParts.margin_s),
                    is_last ? sets : set_at(end_s + kParts.margin_s)};
    if (part.begin < part.end) parts.push_back(part);
  }
  return parts;
}

PersonTrack TrackAlong(const std::vector<PathStep>& path, const BodyModel& body) {
  PersonTrack track{body, 0, {}};
  for (std::size_t set = 0; set < path.size(); ++set)
    if (path[set].pose) track.Set(static_cast<int>(set), *path[set].pose);
  return track;
}

class TakeSolver {
 public:
  TakeSolver(const SolveFiles& files, const FirstPass& pass, const TakeSolverOptions& options)
      : files_(files), index_(pass.index), options_(options), parts_(PartsOf(index_)) {
    for (auto& [number, track] : LinkTracks(pass.tracks, Reader())) {
      numbers_.push_back(number);
      tracks_.push_back(track);
    }
  }

  std::map<int, SolvedPerson> Solve() {
    for (std::size_t person = 0; person < tracks_.size(); ++person) {
      paths_.push_back(PathOf(person));
      // The next people are divided from where this one was, also before live tracking found him.
      tracks_[person] = TrackAlong(paths_.back(), tracks_[person].body);
    }
    if (options_.measures) MeasureAll();
    std::map<int, SolvedPerson> solved;
    for (std::size_t person = 0; person < tracks_.size(); ++person)
      solved.emplace(numbers_[person], SolvedPerson{tracks_[person].body, SmoothAll(person)});
    return solved;
  }

 private:
  SetSpoolReader Reader() const { return {files_.Sets(), index_}; }
  PersonEvidence EvidenceOf(const RecordedSets& sets, std::size_t person) const {
    return {sets, tracks_, person, options_.fineness};
  }
  /// Whether a person was tracked in a part or its margins.
  bool IsSeenIn(const Part& part, std::size_t person) const {
    return tracks_[person].first < part.to && tracks_[person].end() > part.from;
  }

  std::vector<PathStep> PathOf(std::size_t person) const {
    std::vector<PathStep> path;
    const auto append = [&path](const std::vector<PathStep>& steps) {
      path.insert(path.end(), steps.begin(), steps.end());
    };
    std::vector<std::vector<PathStep>> known = files_.LoadPath(numbers_[person]);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (i < known.size()) {
        append(known[i]);
        continue;
      }
      options_.tell(
          fmt::format("person {}: path, part {} of {}", numbers_[person], i + 1, parts_.size()));
      const std::optional<PoseState> before = path.empty() ? std::nullopt : path.back().pose;
      const std::vector<PathStep> steps = FindPath(person, parts_[i], before);
      files_.AppendPath(numbers_[person], steps);
      append(steps);
    }
    return path;
  }

  std::vector<PathStep> FindPath(std::size_t person, const Part& part,
                                 const std::optional<PoseState>& before) const {
    const auto length = static_cast<std::size_t>(part.end - part.begin);
    if (!IsSeenIn(part, person)) return std::vector<PathStep>(length);
    const std::vector<Candidates> candidates = CandidatesIn(person, part.from, part.to);
    std::vector<PathStep> steps = LikeliestPath(
        std::span(candidates).subspan(static_cast<std::size_t>(part.begin - part.from)),
        TimesBetween_s(part.begin, part.to), tracks_[person].body, before);
    steps.resize(length);
    return steps;
  }

  /// Candidates of both directions of time for sets [from, to).
  std::vector<Candidates> CandidatesIn(std::size_t person, int from, int to) const {
    const std::array<RunOver, 2> runs = {RunOver{from, to - 1}, RunOver{to - 1, from}};
    std::array<std::vector<Candidates>, 2> found;
    std::vector<std::function<void()>> jobs;
    for (std::size_t i = 0; i < runs.size(); ++i)
      jobs.emplace_back([this, person, &runs, &found, i] {
        SetSpoolReader reader = Reader();
        PersonEvidence evidence = EvidenceOf(reader, person);
        found[i] = FollowHypotheses(reader, runs[i], evidence);
      });
    DoAll(jobs, options_.jobs);
    std::vector<Candidates> both = std::move(found[0]);
    for (std::size_t i = 0; i < both.size(); ++i) {
      const Candidates& backward = found[1][both.size() - 1 - i];
      both[i].insert(both[i].end(), backward.begin(), backward.end());
    }
    return both;
  }

  /// Times since the set before; of the first set, to the next.
  std::vector<double> TimesBetween_s(int from, int to) const {
    std::vector<double> dt_s;
    const SetSpoolReader reader = Reader();
    for (int set = from; set < to; ++set) {
      const int before = std::max(1, set) - 1;
      dt_s.push_back(TimeBetween_s(reader, before, std::min(before + 1, reader.count() - 1)));
    }
    return dt_s;
  }

  /// Measures everybody's sizes over the whole path.
  void MeasureAll() {
    options_.tell("sizes");
    std::vector<PersonTrack> measured = tracks_;
    std::vector<std::function<void()>> jobs;
    for (std::size_t person = 0; person < tracks_.size(); ++person)
      jobs.emplace_back([this, person, &measured] {
        SetSpoolReader reader = Reader();
        PersonEvidence evidence = EvidenceOf(reader, person);
        const std::vector<PathStep>& path = paths_[person];
        PersonTrack& track = measured[person];
        track.body.Resize(MeasureOver(reader, 0, path, evidence));
      });
    DoAll(jobs, options_.jobs);
    tracks_ = std::move(measured);
  }

  std::vector<SolvedPose> SmoothAll(std::size_t person) const {
    options_.tell(fmt::format("person {}: smoothing", numbers_[person]));
    const Things things = ThingsOf(paths_[person]);
    std::vector<std::vector<SolvedPose>> parts(parts_.size());
    std::vector<std::function<void()>> jobs;
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (IsSeenIn(parts_[i], person))
        jobs.emplace_back([this, person, things, i, &parts] {
          parts[i] = SmoothPart(person, parts_[i], things);
        });
    DoAll(jobs, options_.jobs);
    std::vector<SolvedPose> poses;
    for (const std::vector<SolvedPose>& part : parts)
      poses.insert(poses.end(), part.begin(), part.end());
    return poses;
  }

  std::vector<SolvedPose> SmoothPart(std::size_t person, const Part& part, Things things) const {
    SetSpoolReader reader = Reader();
    PersonEvidence evidence = EvidenceOf(reader, person);
    const std::span<const PathStep> steps =
        std::span(paths_[person])
            .subspan(static_cast<std::size_t>(part.from),
                     static_cast<std::size_t>(part.to - part.from));
    std::vector<SolvedPose> poses;
    SmoothPath(reader, {part.from, steps, part.begin, part.end}, things, evidence,
               [&](int set, const CaptureResult& result) {
                 poses.push_back({set, index_.capture_ns[static_cast<std::size_t>(set)], result});
               });
    return poses;
  }

  const SolveFiles& files_;
  const SpoolIndex& index_;
  const TakeSolverOptions& options_;
  const std::vector<Part> parts_;
  std::vector<int> numbers_;
  std::vector<PersonTrack> tracks_;
  std::vector<std::vector<PathStep>> paths_;
};

}  // namespace

std::map<int, SolvedPerson> SolvePeople(const SolveFiles& files, const FirstPass& pass,
                                        const TakeSolverOptions& options) {
  return TakeSolver(files, pass, options).Solve();
}

}  // namespace mocap
