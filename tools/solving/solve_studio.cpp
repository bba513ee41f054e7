#include "tools/solving/solve_studio.h"

#include <utility>

#include "daemon/pipeline/pipeline.h"
#include "daemon/pipeline/segmented_frame.h"
#include "tools/solving/live_pass.h"

namespace mocap {
namespace {

FirstPass TrackLive(Studio studio, const BodyTable& body, const SolveOptions& options,
                    const SolveFiles& files, Solved& solved) {
  options.tell("first pass");
  LivePass live(files.Sets(), options.people.has_value(), options.live);
  Pipeline pipeline(std::move(studio),
                    {.voxel_mm = options.voxel_mm,
                     .overflow = Overflow::kWait,
                     .latency_origin = LatencyOrigin::kArrival,
                     .people = options.people.value_or(1),
                     .elsewhere = options.masked},
                    body, live);
  if (options.subject) pipeline.ChangeSubject(options.subject);
  pipeline.Start();
  pipeline.Join();
  const auto moments = pipeline.Moments();
  solved.moments.assign(moments.begin(), moments.end());
  FirstPass pass = live.Finish();
  files.Save(pass);
  return pass;
}

Result ResultOf(SolvedPerson& person, const SpoolIndex& index, const SolveOptions& options) {
  FilterMotion(person.body, options.filter, person.poses);
  Result result;
  result.body = RecordOf(person.body);
  result.take = options.take;
  result.filter = options.filter.name();
  const CaptureResult nobody;
  // The one person has a row for every set.
  const auto fill_up_to = [&](int end) {
    while (!options.people && std::ssize(result.poses) < end) {
      const auto set = std::ssize(result.poses);
      result.poses.push_back(
          PoseRowOf(set, index.capture_ns[static_cast<std::size_t>(set)], nobody, person.body));
    }
  };
  for (const SolvedPose& pose : person.poses) {
    fill_up_to(pose.set);
    result.poses.push_back(PoseRowOf(pose.set, pose.capture_ns, pose.result, person.body));
  }
  fill_up_to(static_cast<int>(index.offset.size()));
  return result;
}

}  // namespace

Solved SolveStudio(Studio studio, const BodyTable& body, const SolveOptions& options) {
  const SolveFiles files(options.work, options.mark);
  Solved solved;
  std::optional<FirstPass> pass = files.LoadFirstPass(body);
  if (!pass) pass = TrackLive(std::move(studio), body, options, files, solved);
  solved.sets = pass->index.offset.size();
  auto people = SolvePeople(files, *pass,
                            {.jobs = options.jobs,
                             .fineness = FinenessFor(options.people.value_or(1)),
                             .measures = !options.subject,
                             .tell = options.tell});
  for (auto& [number, person] : people)
    solved.people[number] = ResultOf(person, pass->index, options);
  return solved;
}

}  // namespace mocap
