#include "tools/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/errors.h"
#include "drivers/printable_text.h"
#include "drivers/take/text_file.h"
#include "tools/results/bvh_motion.h"
#include "tools/results/bvh_writer.h"
#include "tools/results/csv_writer.h"
#include "tools/results/export_axes.h"
#include "tools/results/people_times.h"
#include "tools/results/result.h"
#include "tools/results/trc_writer.h"

namespace mocap {
namespace {

struct ExportArguments {
  std::filesystem::path result;
  std::string format;
  std::filesystem::path out;
  std::optional<std::string> prefix;
  bool people = false;
};

/// What is written over must be a former export.
void RequireRoomForExport(const std::string& format, const std::filesystem::path& out) {
  const std::string_view beginning = format == "bvh"   ? "HIERARCHY"
                                     : format == "trc" ? "PathFileType"
                                                       : "time_s,utime_us,";
  RequireWritable(out);
  RequireOwn(out, std::span(&beginning, 1), "a " + format + " export");
}

void TellRemarks(const Result& result) {
  for (const std::string& remark : result.remarks) {
    fmt::print(stderr, "mocap export: {}\n", Printable(remark));
  }
}

/// BVH cannot say all that a result says; the person should know what is not in the file.
/// @param whose  "person-2: ", of several.
void TellLosses(const BvhMotion& motion, const std::string& whose) {
  const auto tell = [&](const std::string& loss) {
    fmt::print(stderr, "mocap export: {}{}\n", Printable(whose), loss);
  };
  if (motion.skipped_frames > 0) {
    tell(fmt::format("frames before the first tracked one, left out: {}", motion.skipped_frames));
  }
  if (motion.held_frames > 0) {
    tell(fmt::format("frames missing or not tracked, the last pose again: {}", motion.held_frames));
  }
  if (motion.worst_mm > 1) {
    tell(
        fmt::format("bones change their length in this result and are constant in BVH: joints are "
                    "off by up to {:.1f} mm",
                    motion.worst_mm));
  }
}

void WriteBvhOf(const Result& result, const std::filesystem::path& source, const std::string& whose,
                std::ostream& out) {
  BvhMotion motion;
  try {
    motion = MakeBvhMotion(result);
  } catch (const SetupError& error) {
    throw SetupError(source.string() + ": " + whose + error.what());
  }
  WriteBvh(motion, out);
  TellLosses(motion, whose);
}

/// As BVH, from the moment on at which the first of all was there.
void WriteBvhAmong(const std::vector<PoseRow>& moments, const ExportArguments& arguments,
                   const std::string& name, const Result& result, std::ostream& out) {
  const Result held = HoldingFirstPose(result, moments);
  const auto first = std::ranges::find_if(result.poses, IsTracked);
  const auto after_ns = static_cast<double>(first->timestamp_ns - held.poses.front().timestamp_ns);
  if (after_ns > 0) {
    fmt::print(stderr,
               "mocap export: {}: not tracked in the first {:.2f} s, the first pose instead\n",
               Printable(name), 1e-9 * after_ns);
  }
  WriteBvhOf(held, arguments.result, name + ": ", out);
}

void ExportOne(const ExportArguments& arguments) {
  RequireRoomForExport(arguments.format, arguments.out);
  const Result result = ReadResult(arguments.result, arguments.prefix);
  TellRemarks(result);
  if (result.poses.empty()) {
    throw SetupError(arguments.result.string() + ": holds no frame; one at least is wanted");
  }
  std::ostringstream out;
  if (arguments.format == "bvh") {
    WriteBvhOf(result, arguments.result, "", out);
  } else if (arguments.format == "trc") {
    WriteTrc(result, arguments.out.filename().string(), out);
  } else {
    WriteCsv(result, out);
  }
  ReplaceText(arguments.out, out.str());
}

/// "walk.bvh" of person-1 is walk-person-1.bvh; out of a log, of anna, walk-anna.bvh.
std::filesystem::path FileOf(const std::filesystem::path& out, const std::string& name) {
  std::filesystem::path file = out;
  return file.replace_filename(out.stem().string() + '-' + name + out.extension().string());
}

void WriteOneOf(const ExportArguments& arguments, const std::vector<PoseRow>& moments,
                const std::string& name, const Result& result) {
  const std::filesystem::path file = FileOf(arguments.out, name);
  std::ostringstream out;
  if (arguments.format == "bvh") {
    WriteBvhAmong(moments, arguments, name, result, out);
  } else if (arguments.format == "trc") {
    const TrcSubject subject{"", result};
    WriteTrc(std::span(&subject, 1), moments, file.filename().string(), out);
  } else {
    WriteCsv(result, out, moments.front().timestamp_ns);
  }
  ReplaceText(file, out.str());
  fmt::print("{}\n", Printable(file.string()));
}

/// Each person's file; as TRC also one of all.
void ExportPeople(const ExportArguments& arguments) {
  PeopleResults people = ReadPeople(arguments.result, arguments.prefix);
  for (const auto& [name, result] : people) TellRemarks(result);
  std::erase_if(people, [](const auto& person) {
    return std::ranges::none_of(person.second.poses, IsTracked);
  });
  if (people.empty()) {
    throw SetupError(arguments.result.string() + ": holds nobody who was tracked");
  }
  for (const auto& [name, result] : people) {
    RequireRoomForExport(arguments.format, FileOf(arguments.out, name));
  }
  const std::vector<PoseRow> moments = MomentsOf(people);
  if (arguments.format == "trc") {
    RequireRoomForExport(arguments.format, arguments.out);
    std::vector<TrcSubject> subjects;
    for (const auto& [name, result] : people) subjects.push_back({name, result});
    std::ostringstream out;
    WriteTrc(subjects, moments, arguments.out.filename().string(), out);
    ReplaceText(arguments.out, out.str());
    fmt::print("{}\n", Printable(arguments.out.string()));
  }
  for (const auto& [name, result] : people) WriteOneOf(arguments, moments, name, result);
}

void Export(const ExportArguments& arguments) {
  const bool is_of_people = arguments.people || IsOfPeople(arguments.result);
  is_of_people ? ExportPeople(arguments) : ExportOne(arguments);
}

}  // namespace

void AddExportCommand(CLI::App& app) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command =
      app.add_subcommand("export", "Writes a result for animation, biomechanics or a spreadsheet");
  command
      ->add_option("RESULT", arguments->result,
                   "folder of mocap track, of one person or of several, or an LCM log")
      ->required();
  command
      ->add_option("--format", arguments->format,
                   "bvh (cm, y up), trc (mm, y up) or csv (mm, z up as in the studio)")
      ->required()
      ->check(CLI::IsMember({"bvh", "trc", "csv"}));
  command
      ->add_option(
          "--out", arguments->out,
          "file to write; of several people FILE-person-1 and so on, out of a log FILE-anna "
          "for who has a name")
      ->required();
  command->add_option("--prefix", arguments->prefix,
                      "of a log of several daemons: what stands before the channels' names");
  command->add_flag("--people", arguments->people, "of a log: everybody, not only the first");
  command->callback([arguments] { Export(*arguments); });
}

}  // namespace mocap
