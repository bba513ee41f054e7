#include "tools/benchmark.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/errors.h"
#include "daemon/base/choice_option.h"
#include "daemon/base/number_option.h"
#include "drivers/take/text_file.h"
#include "tools/accuracy/accuracy_report.h"
#include "tools/accuracy/benchmark_options.h"
#include "tools/accuracy/benchmark_parts.h"
#include "tools/accuracy/carving_trial.h"
#include "tools/accuracy/evidence_report.h"
#include "tools/accuracy/paired_comparison.h"
#include "tools/accuracy/paper_report.h"
#include "tools/accuracy/score_table.h"
#include "tools/report/extremity_text.h"

namespace mocap {
namespace {

constexpr int kMostVaried = 1'000'000, kMostFirsts = 10;

bool HasTakesOfTheGrid(const BenchmarkOptions& options) {
  const std::array others = {kPeoplePart,   kVarietyPart, kPaperPart,
                             kEvidencePart, kTakesPart,   kNoisePart};
  return std::ranges::any_of(options.parts, [&](const std::string& part) {
    return std::ranges::find(others, part) == others.end();
  });
}

/// Checked before the work, so that a result cannot be lost.
void RequireRoomForTables(const std::filesystem::path& out) {
  MakeFolder(out);
  const auto require = [&out](const char* name, std::string_view beginning) {
    RequireWritable(out / name);
    RequireOwn(out / name, std::span(&beginning, 1), "a benchmark");
  };
  require("accuracy.md", "# Accuracy on simulated people");
  require("scores.csv", kScoreHeader);
}

/// The folders of takes; none if that part is not wanted.
std::vector<TakesFolder> WantedTakes(const BenchmarkOptions& options) {
  if (options.Wants(kTakesPart) != !options.folders.empty())
    throw SetupError(options.folders.empty()
                         ? "--parts takes: needs --takes; expected a folder of recorded takes"
                         : "--takes: is of the part takes; expected --parts takes beside it");
  return FoldersOfTakes(options.folders);
}

/// What can be compared with another version, person by person.
std::vector<ScoreRow> ScoresOf(const std::vector<VarietyGrid>& variety,
                               const std::vector<ScoredTakes>& takes) {
  std::vector<ScoreRow> scores;
  const auto add = [&scores](const std::vector<ScoreRow>& rows) {
    scores.insert(scores.end(), rows.begin(), rows.end());
  };
  for (const VarietyGrid& grid : variety)
    for (const VarietyRow& row : grid.rows)
      add(RowsOf(kVarietyPart, grid.filming.label, std::to_string(row.accuracy.seed), row.score));
  for (const ScoredTakes& folder : takes)
    for (const ScoredTake& take : folder.takes)
      for (const TakePerson& person : take.people)
        add(RowsOf(kTakesPart, folder.folder, person.name, person.score));
  return scores;
}

void RunBenchmark(const BenchmarkOptions& options) {
  const std::vector<TakesFolder> folders = WantedTakes(options);
  if (!options.out.empty()) RequireRoomForTables(options.out);
  AccuracyBenchmark benchmark{.seconds = options.SecondsOr(kSeconds),
                              .grid = {},
                              .sweeps = {},
                              .studios = {},
                              .people_seconds = options.SecondsOr(kPeopleSeconds),
                              .studio_seconds = options.SecondsOr(kStudioSeconds),
                              .people = {}};
  if (HasTakesOfTheGrid(options)) PrintNow(AccuracyHeader());
  if (options.Wants("grid")) {
    benchmark.grid = RunGrid(options);
    PrintNow("\n" + AccuracySummaryText(Summarize(benchmark.grid)) +
             ExtremityText(MeanExtremities(benchmark.grid)));
  }
  benchmark.sweeps = RunSweeps(options);
  if (options.Wants(kStudioPart)) {
    benchmark.studios = RunStudios(options);
    PrintNow(SweepTable(benchmark.studios));
  }
  if (options.Wants(kPeoplePart)) {
    benchmark.people = RunPeople(options);
    PrintNow("\n" + PeopleSummaryText(benchmark.people));
  }
  std::vector<VarietyGrid> variety;
  if (options.Wants(kVarietyPart)) variety = RunVariety(options);
  const std::vector<ScoredTakes> takes = RunTakes(options, folders);
  std::vector<PaperRow> paper;
  if (options.Wants(kPaperPart)) {
    paper = RunPaper(options);
    PrintNow(PaperTables(paper));
  }
  std::vector<EvidenceRow> evidence;
  if (options.Wants(kEvidencePart)) {
    evidence = RunEvidence(options);
    PrintNow(EvidenceTable(evidence) + CarvingLines());
  }
  std::string noise;
  std::string solved;
  if (options.Wants(kSolvePart)) {
    solved = SolveTable(RunSolve(options));
    PrintNow(solved);
  }
  if (options.Wants(kNoisePart)) {
    noise = NoiseTable(RunNoise(options));
    PrintNow(noise);
  }
  if (options.out.empty()) return;
  ReplaceText(options.out / "accuracy.md",
              AccuracyMarkdown(benchmark) + VarietyMarkdown(variety) +
                  TakesMarkdown(takes, options.FirstsOr(kTakeFirsts)) +
                  PaperMarkdown(paper, options.SecondsOr(kPaperSeconds)) +
                  EvidenceMarkdown(evidence, options.SecondsOr(kEvidenceSeconds)) + noise + solved);
  const std::vector<ScoreRow> scores = ScoresOf(variety, takes);
  if (!scores.empty()) ReplaceText(options.out / "scores.csv", ScoreCsv(scores));
  if (!benchmark.sweeps.empty()) {
    ReplaceText(options.out / "accuracy.html", AccuracySweepsHtml(benchmark.sweeps));
  }
  if (!evidence.empty()) ReplaceText(options.out / "evidence.html", EvidenceHtml(evidence));
}

void AddTakeOptions(CLI::App& command, BenchmarkOptions& options) {
  command
      .add_option(
          "--seconds", options.seconds,
          fmt::format("length of each take [s] (default: {}; several people: {}; studio: {}; "
                      "paper: {}; evidence: {}; noise: {})",
                      kSeconds, kPeopleSeconds, kStudioSeconds, kPaperSeconds, kEvidenceSeconds,
                      kNoiseSeconds))
      ->check(NumberFrom(1, 600));
  command
      .add_option(
          "--motions", options.motions,
          fmt::format(
              "motions of the people (default: {}; several people: {}; paper: {}; evidence: {})",
              fmt::join(kMotions, ","), fmt::join(kPeopleMotions, ","),
              fmt::join(kPaperMotions, ","), fmt::join(kEvidenceMotions, ",")))
      ->delimiter(',');
  command
      .add_option("--statures", options.statures_mm,
                  fmt::format("statures of the people [mm] (default: {}; paper: {}; evidence: {})",
                              fmt::join(kStatures_mm, ","), fmt::join(kPaperStatures_mm, ","),
                              fmt::join(kEvidenceStatures_mm, ",")))
      ->delimiter(',')
      ->check(NumberFrom(1000, 2100));
  command
      .add_option(
          "--seeds", options.seeds,
          fmt::format("number of random seeds per combination (default: {}; several people: {}; "
                      "studio: {}; variety: {} people; evidence: {}; noise: {} people)",
                      kSeeds, kPeopleSeeds, kStudioSeeds, kVariedPeople, kEvidenceSeeds,
                      kNoisePeople))
      ->check(NumberFrom(1, 1000));
  command.add_option("--from", options.from, "variety and noise: number of the first person")
      ->check(NumberFrom(1, kMostVaried))
      ->capture_default_str();
  std::vector<std::string> labels;
  for (const Filming& filming : Filmings()) labels.push_back(filming.label);
  command.add_option("--filmed", options.filmed, "variety: how people are filmed (default: all)")
      ->delimiter(',')
      ->check(OneOf(labels));
  command
      .add_option("--firsts", options.firsts,
                  fmt::format("variety and takes: how often each person is tracked, from another "
                              "first frame set each time (default: {}; takes: {})",
                              kFirsts, kTakeFirsts))
      ->check(NumberFrom(1, kMostFirsts));
  command
      .add_option("--takes", options.folders,
                  "takes: folders of recorded takes with truth, of one person or several")
      ->delimiter(',');
}

void AddCompareCommand(CLI::App& benchmark) {
  struct Files {
    std::filesystem::path before, after;
  };
  const auto files = std::make_shared<Files>();
  CLI::App* command = benchmark.add_subcommand(
      "compare", "Say whether the people of one scores.csv are tracked better than in another one");
  command->add_option("BEFORE", files->before, "scores.csv of an earlier benchmark")->required();
  command->add_option("AFTER", files->after, "scores.csv to compare with it")->required();
  command->callback([files] {
    PrintNow(ComparisonText(ComparePaired(ReadScores(files->before), ReadScores(files->after))));
  });
}

}  // namespace

void AddBenchmarkCommand(CLI::App& app) {
  const auto options = std::make_shared<BenchmarkOptions>();
  CLI::App* command = app.add_subcommand(
      "benchmark", "Measure accuracy on a grid of simulated takes, and what affects it");
  AddTakeOptions(*command, *options);
  std::vector<std::string> parts = options->parts;
  parts.insert(parts.end(), {kPeoplePart, kVarietyPart, kTakesPart, kStudioPart, kPaperPart,
                             kEvidencePart, kNoisePart, kSolvePart});
  command
      ->add_option(
          "--parts", options->parts,
          "parts to run; people (two to four at once), variety (of builds, hair, clothes "
          "and loads), takes (recorded ones), studio (number, place and pictures of the "
          "cameras), paper (its tracker, with truth in place of stages), evidence (clothes "
          "like the wall, and lossy pictures, of 4 to 16 cameras), noise (of the "
          "evidence, at true poses of varied people, and the odds of right and wrong poses) "
          "and solve (varied people, live and solved) "
          "run only on request")
      ->delimiter(',')
      ->check(OneOf(parts))
      ->capture_default_str();
  command->add_option("--out", options->out,
                      "output folder for accuracy.md, its plots, and scores.csv of variety and "
                      "takes");
  AddCompareCommand(*command);
  command->callback([command, options] {
    if (command->get_subcommands().empty()) RunBenchmark(*options);
  });
}

}  // namespace mocap
