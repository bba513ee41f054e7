#include "tools/gait.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "daemon/base/json.h"
#include "drivers/printable_text.h"
#include "drivers/take/text_file.h"
#include "tools/gait/gait_analysis.h"
#include "tools/gait/gait_report.h"
#include "tools/gait/gait_text.h"
#include "tools/remarks.h"
#include "tools/report/report_page.h"

namespace mocap {
namespace {

struct GaitArguments {
  std::filesystem::path result;
  std::filesystem::path out;
  std::filesystem::path report;
  std::optional<std::string> prefix;
  bool people = false;
  bool json = false;
};

void PrintText(const std::string& text) { std::fputs(text.c_str(), stdout); }

void WriteReport(const GaitArguments& arguments, const PeopleGaits& people) {
  if (arguments.report.empty()) return;
  const std::filesystem::path result = std::filesystem::weakly_canonical(arguments.result);
  ReplaceText(arguments.report, GaitReportHtml(result.filename().string(), people));
}

GaitAnalysis Analyse(const Result& result, const std::filesystem::path& where,
                     const std::filesystem::path& out) {
  TellRemarks("gait", result.remarks);
  if (!out.empty()) RequireRoomForGait(out);
  GaitAnalysis gait = AnalyseGait(result, Printable(where.string()));
  if (!out.empty()) WriteGait(out, gait);
  return gait;
}

void RunForPeople(const GaitArguments& arguments) {
  Json json = Json::object();
  std::string text;
  PeopleGaits people;
  for (const auto& [name, result] : ReadPeople(arguments.result, arguments.prefix)) {
    const std::filesystem::path out =
        arguments.out.empty() ? std::filesystem::path() : arguments.out / name;
    const GaitAnalysis& gait =
        people.emplace_back(name, Analyse(result, arguments.result / name, out)).second;
    json[name] = GaitJson(gait);
    text += (text.empty() ? "" : "\n") + Printable(name) + ": " + GaitText(gait);
  }
  WriteReport(arguments, people);
  PrintText(arguments.json ? JsonText({{"people", json}}) + '\n' : text);
}

void RunGait(const GaitArguments& arguments) {
  if (!arguments.report.empty()) RequireRoomForReport(arguments.report);
  if (arguments.people || IsOfPeople(arguments.result)) return RunForPeople(arguments);
  const GaitAnalysis gait =
      Analyse(ReadResult(arguments.result, arguments.prefix), arguments.result, arguments.out);
  WriteReport(arguments, {{"", gait}});
  PrintText(arguments.json ? JsonText(GaitJson(gait)) + '\n' : GaitText(gait));
}

}  // namespace

void AddGaitCommand(CLI::App& app) {
  const auto arguments = std::make_shared<GaitArguments>();
  CLI::App* command =
      app.add_subcommand("gait", "Find the steps of people who walk, and measure them");
  command
      ->add_option("RESULT", arguments->result,
                   "result folder of mocap track, for one person or several, or an LCM log")
      ->required();
  command->add_option("--out", arguments->out,
                      "output folder: events, strides, figures and curves as CSV");
  command->add_option("--report", arguments->report,
                      "output HTML report: figures, events, joint angles over the gait cycle");
  command->add_option("--prefix", arguments->prefix,
                      "prefix of the LCM channel names, for a log of several daemons");
  command->add_flag("--people", arguments->people,
                    "with a log: all people, not only the one tracked longest");
  command->add_flag("--json", arguments->json, "print one JSON object");
  command->callback([arguments] { RunGait(*arguments); });
}

}  // namespace mocap
