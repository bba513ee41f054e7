#include "tools/compare.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "daemon/base/json.h"
#include "drivers/take/text_file.h"
#include "tools/comparison/comparison.h"
#include "tools/comparison/comparison_report.h"
#include "tools/comparison/comparison_text.h"
#include "tools/remarks.h"
#include "tools/report/report_page.h"

namespace mocap {
namespace {

struct CompareArguments {
  ComparisonRequest request;
  std::filesystem::path report;
  bool json = false;
};

void RunCompare(const CompareArguments& arguments) {
  if (!arguments.report.empty()) RequireRoomForReport(arguments.report);
  const Comparison comparison = Compare(arguments.request);
  TellRemarks("compare", comparison.remarks);
  if (!arguments.report.empty()) {
    const std::string title = arguments.request.result.filename().string() + " and " +
                              arguments.request.other.filename().string();
    ReplaceText(arguments.report, ComparisonReportHtml(title, comparison));
  }
  const std::string text =
      arguments.json ? JsonText(ComparisonJson(comparison)) + '\n' : ComparisonText(comparison);
  std::fputs(text.c_str(), stdout);
}

}  // namespace

void AddCompareCommand(CLI::App& app) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand(
      "compare", "Compare a result with markers, or another recording of the same motion");
  command
      ->add_option("RESULT", arguments->request.result,
                   "result folder of mocap track, for one person or several, or an LCM log")
      ->required();
  command
      ->add_option("OTHER", arguments->request.other,
                   "C3D, TRC, BVH, OpenSim .mot, truth.csv or exported CSV, a take with truth, or "
                   "a second result")
      ->required();
  command->add_option("--map", arguments->request.map,
                      "TOML file that says which marker is which point, for other names");
  command->add_option("--report", arguments->report,
                      "output HTML report: figures, Bland-Altman plots, curves");
  command->add_option("--person", arguments->request.person,
                      "person of a result of several; otherwise whoever fits best");
  command->add_option("--subject", arguments->request.subject,
                      "subject of a file of several; otherwise whoever fits best");
  command->add_option("--prefix", arguments->request.prefix,
                      "prefix of the LCM channel names, for a log of several daemons");
  command->add_flag("--json", arguments->json, "print one JSON object");
  command->callback([arguments] { RunCompare(*arguments); });
}

}  // namespace mocap
