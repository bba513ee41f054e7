#include "tools/export.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>

#include "core/errors.h"
#include "drivers/printable_text.h"
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
  std::optional<std::string> prefix;
};

/// What is written over must be a former export.
void RequireRoomForExport(const ExportArguments& arguments) {
  const std::string_view beginning = arguments.format == "bvh"   ? "HIERARCHY"
                                     : arguments.format == "trc" ? "PathFileType"
                                                                 : "time_s,utime_us,";
  RequireWritable(arguments.out);
  RequireOwn(arguments.out, std::span(&beginning, 1), "a " + arguments.format + " export");
}

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
  RequireRoomForExport(arguments);
  const Result result = ReadResult(arguments.result, arguments.prefix);
  for (const std::string& remark : result.remarks) {
    fmt::print(stderr, "mocap export: {}\n", Printable(remark));
  }
  if (result.poses.empty()) {
    throw SetupError(arguments.result.string() + ": holds no frame; one at least is wanted");
  }
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
  command->add_option("--prefix", arguments->prefix,
                      "of a log of several daemons: what stands before the channels' names");
  command->callback([arguments] { Export(*arguments); });
}

}  // namespace mocap
