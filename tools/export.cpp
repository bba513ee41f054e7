#include "tools/export.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>

#include "core/errors.h"
#include "drivers/take/text_file.h"
#include "tools/results/bvh_motion.h"
#include "tools/results/bvh_writer.h"
#include "tools/results/csv_writer.h"
#include "tools/results/result.h"
#include "tools/results/trc_writer.h"

namespace mocap {
namespace {

struct ExportArguments {
  std::filesystem::path result;
  std::string format;
  std::filesystem::path out;
};

/// BVH cannot say all that a result says; the person should know what is not in the file.
void TellLosses(const BvhMotion& motion) {
  if (motion.skipped_frames > 0) {
    fmt::print(stderr, "mocap export: frames before the first tracked one, left out: {}\n",
               motion.skipped_frames);
  }
  if (motion.held_frames > 0) {
    fmt::print(stderr, "mocap export: frames missing or not tracked, the last pose again: {}\n",
               motion.held_frames);
  }
  if (motion.worst_mm > 1) {
    fmt::print(stderr,
               "mocap export: bones change their length in this result and are constant in BVH: "
               "joints are off by up to {:.1f} mm\n",
               motion.worst_mm);
  }
}

void WriteBvhOf(const Result& result, const std::filesystem::path& source, std::ostream& out) {
  BvhMotion motion;
  try {
    motion = MakeBvhMotion(result);
  } catch (const SetupError& error) {
    throw SetupError(source.string() + ": " + error.what());
  }
  WriteBvh(motion, out);
  TellLosses(motion);
}

void Export(const ExportArguments& arguments) {
  RequireWritable(arguments.out);
  const Result result = ReadResult(arguments.result);
  std::ostringstream out;
  if (arguments.format == "bvh") {
    WriteBvhOf(result, arguments.result, out);
  } else if (arguments.format == "trc") {
    WriteTrc(result, arguments.out.filename().string(), out);
  } else {
    WriteCsv(result, out);
  }
  ReplaceText(arguments.out, out.str());
}

}  // namespace

void AddExportCommand(CLI::App& app) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command =
      app.add_subcommand("export", "Writes a result for animation, biomechanics or a spreadsheet");
  command->add_option("RESULT", arguments->result, "folder of mocap track, or an LCM log")
      ->required();
  command
      ->add_option("--format", arguments->format,
                   "bvh (cm, y up), trc (mm, y up) or csv (mm, z up as in the studio)")
      ->required()
      ->check(CLI::IsMember({"bvh", "trc", "csv"}));
  command->add_option("--out", arguments->out, "file to write")->required();
  command->callback([arguments] { Export(*arguments); });
}

}  // namespace mocap
