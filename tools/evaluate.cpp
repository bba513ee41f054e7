#include "tools/evaluate.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "tools/evaluation.h"
#include "tools/evaluation_text.h"

namespace mocap {
namespace {

struct EvaluateArguments {
  std::filesystem::path take;
  std::filesystem::path result;
  bool json = false;
};

void RunEvaluate(const EvaluateArguments& arguments) {
  const Evaluation evaluation = Evaluate(arguments.take, arguments.result);
  const std::string text =
      arguments.json ? EvaluationJson(evaluation, {}) : EvaluationText(evaluation);
  std::fputs(text.c_str(), stdout);
}

}  // namespace

void AddEvaluateCommand(CLI::App& app) {
  const auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command = app.add_subcommand("evaluate", "Say how good a result is");
  command->add_option("take", arguments->take, "Folder of the take")->required();
  command->add_option("result", arguments->result, "Folder that `mocap track` left, or an LCM log")
      ->required();
  command->add_flag("--json", arguments->json, "Print one JSON object");
  command->callback([arguments] { RunEvaluate(*arguments); });
}

}  // namespace mocap
