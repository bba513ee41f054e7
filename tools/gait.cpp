#include "tools/gait.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "daemon/base/json.h"
#include "drivers/printable_text.h"
#include "tools/gait/gait_analysis.h"
#include "tools/remarks.h"

namespace mocap {
namespace {

struct GaitArguments {
  std::filesystem::path result;
  std::filesystem::path out;
  std::optional<std::string> prefix;
  bool people = false;
  bool json = false;
};

void Print(const std::string& text) { std::fputs(text.c_str(), stdout); }

GaitAnalysis Analyse(const Result& result, const std::filesystem::path& out) {
  TellRemarks("gait", result.remarks);
  GaitAnalysis gait = AnalyseGait(result);
  if (!out.empty()) WriteGait(out, gait);
  return gait;
}

void RunForPeople(const GaitArguments& arguments) {
  Json people = Json::object();
  std::string text;
  for (const auto& [name, result] : ReadPeople(arguments.result, arguments.prefix)) {
    const std::filesystem::path out =
        arguments.out.empty() ? std::filesystem::path() : arguments.out / name;
    const GaitAnalysis gait = Analyse(result, out);
    people[name] = GaitJson(gait);
    text += (text.empty() ? "" : "\n") + Printable(name) + ": " + GaitText(gait);
  }
  Print(arguments.json ? JsonText({{"people", people}}) + '\n' : text);
}

void RunGait(const GaitArguments& arguments) {
  if (arguments.people || IsOfPeople(arguments.result)) return RunForPeople(arguments);
  const GaitAnalysis gait = Analyse(ReadResult(arguments.result, arguments.prefix), arguments.out);
  Print(arguments.json ? JsonText(GaitJson(gait)) + '\n' : GaitText(gait));
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
  command->add_option("--prefix", arguments->prefix,
                      "prefix of the LCM channel names, for a log of several daemons");
  command->add_flag("--people", arguments->people,
                    "with a log: all people, not only the one tracked longest");
  command->add_flag("--json", arguments->json, "print one JSON object");
  command->callback([arguments] { RunGait(*arguments); });
}

}  // namespace mocap
