#include "tools/evaluate.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/printable_text.h"
#include "drivers/take/text_file.h"
#include "tools/remarks.h"
#include "tools/report/evaluation.h"
#include "tools/report/evaluation_text.h"
#include "tools/report/hull_overlap.h"
#include "tools/report/people_report.h"
#include "tools/report/people_text.h"
#include "tools/report/report.h"
#include "tools/report/report_page.h"
#include "tools/studio_examination.h"
#include "tools/take_samples.h"

namespace mocap {
namespace {

struct EvaluateArguments {
  std::filesystem::path take;
  std::filesystem::path result;
  std::filesystem::path report;
  std::optional<std::string> prefix;
  bool people = false;
  bool json = false;
};

TakeSamples SampleForReport(const std::filesystem::path& take,
                            const std::vector<SampleRequest>& moments) {
  TakeSamples samples = SampleTake(take, moments, kReportVoxelMm);
  TellRemarks("evaluate", samples.remarks);
  if (const auto fault = ExamineStudio(samples))
    TellRemarks("evaluate", {take.string() + ": " + fault->text});
  return samples;
}

void WritePeopleReport(const EvaluateArguments& arguments, const PeopleEvaluation& evaluation) {
  RequireRoomForReport(arguments.report);
  const TakeSamples samples = SampleForReport(arguments.take, ChooseReportMoments(evaluation));
  ReplaceText(arguments.report, PeopleReportHtml(evaluation, samples, MeasureOverlaps(samples)));
}

std::vector<CameraOverlap> WriteReport(const EvaluateArguments& arguments,
                                       const Evaluation& evaluation) {
  RequireRoomForReport(arguments.report);
  const TakeSamples samples = SampleForReport(arguments.take, ChooseReportMoments(evaluation));
  std::vector<CameraOverlap> overlaps = MeasureOverlaps(samples);
  ReplaceText(arguments.report, ReportHtml(evaluation, samples, overlaps));
  return overlaps;
}

void RunForPeople(const EvaluateArguments& arguments) {
  const PeopleEvaluation evaluation =
      EvaluatePeople(arguments.take, arguments.result, arguments.prefix);
  for (const TrackedPerson& person : evaluation.people)
    TellRemarks("evaluate", person.evaluation.result.remarks);
  if (!arguments.report.empty()) WritePeopleReport(arguments, evaluation);
  const std::string text = arguments.json ? PeopleJson(evaluation) : PeopleText(evaluation);
  std::fputs(text.c_str(), stdout);
}

void RunEvaluate(const EvaluateArguments& arguments) {
  if (arguments.people || IsOfPeople(arguments.result)) return RunForPeople(arguments);
  const Evaluation evaluation = EvaluateOne(arguments.take, arguments.result, arguments.prefix);
  TellRemarks("evaluate", evaluation.result.remarks);
  std::vector<CameraOverlap> overlaps;
  if (!arguments.report.empty()) overlaps = WriteReport(arguments, evaluation);
  const std::string text =
      arguments.json ? EvaluationJson(evaluation, overlaps) : EvaluationText(evaluation);
  std::fputs(text.c_str(), stdout);
}

}  // namespace

void AddEvaluateCommand(CLI::App& app) {
  const auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command = app.add_subcommand(
      "evaluate",
      "Report the precision of a result, and its accuracy if the take has ground truth");
  command->add_option("TAKE", arguments->take, "take folder")->required();
  command
      ->add_option("RESULT", arguments->result,
                   "result folder of mocap track, for one person or several, or an LCM log")
      ->required();
  command->add_option("--report", arguments->report,
                      "output HTML report: figures, camera views, tables");
  command->add_option("--prefix", arguments->prefix,
                      "prefix of the LCM channel names, for a log of several daemons");
  command->add_flag("--people", arguments->people,
                    "with a log: all people, not only the one tracked longest");
  command->add_flag("--json", arguments->json, "print one JSON object");
  command->callback([arguments] { RunEvaluate(*arguments); });
}

}  // namespace mocap
