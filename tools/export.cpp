#include "tools/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
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
#include "daemon/base/choice_option.h"
#include "drivers/printable_text.h"
#include "drivers/take/text_file.h"
#include "tools/interchange/export_format.h"
#include "tools/interchange/people_times.h"
#include "tools/remarks.h"
#include "tools/results/export_axes.h"
#include "tools/results/result.h"

namespace mocap {
namespace {

struct ExportArguments {
  std::filesystem::path result;
  std::string format;
  std::filesystem::path out;
  std::optional<std::string> skeleton;
  std::optional<std::string> prefix;
  bool people = false;
};

/// One line per format, for the help.
std::string FormatsText() {
  std::string text = "output format:";
  for (const ExportFormat& format : ExportFormats()) {
    text += fmt::format("\n{}  {}", format.name, format.purpose);
  }
  return text;
}

std::string SkeletonsText() {
  std::string text = "joints of bvh:";
  for (const Skeleton* skeleton : Skeletons())
    text += fmt::format("\n{}  {}", skeleton->name, skeleton->purpose);
  return text;
}

std::vector<std::string> SkeletonNames() {
  std::vector<std::string> names;
  for (const Skeleton* skeleton : Skeletons()) names.emplace_back(skeleton->name);
  return names;
}

const Skeleton& SkeletonOf(const ExportArguments& arguments) {
  if (!arguments.skeleton) return MocapdSkeleton();
  if (arguments.format != "bvh") {
    throw SetupError("--skeleton: " + arguments.format +
                     " has no choice of skeletons; expected --format bvh");
  }
  return FindSkeleton(*arguments.skeleton);
}

std::vector<std::string> FormatNames() {
  std::vector<std::string> names;
  for (const ExportFormat& format : ExportFormats()) names.emplace_back(format.name);
  return names;
}

/// Only a former export may be overwritten.
void RequireRoomForExport(const ExportFormat& format, const std::filesystem::path& out) {
  RequireWritable(out);
  RequireOwn(out, std::span(&format.beginning, 1), fmt::format("a {} export", format.name));
}

/// @param whose  "person-2: ", if there are several.
void WriteScene(const ExportFormat& format, const ExportScene& scene, const std::string& source,
                const std::string& whose, const std::filesystem::path& file) {
  std::ostringstream out;
  try {
    ExportRemarks remarks = format.write(scene, out);
    for (std::string& remark : remarks) remark.insert(0, whose);
    TellRemarks("export", remarks);
  } catch (const SetupError& error) {
    throw SetupError(source + ": " + whose + error.what());
  }
  ReplaceText(file, out.str());
  fmt::print("{}\n", Printable(file.string()));
}

/// Whether a name is that of person K's file beside `out`.
bool IsOfPerson(const std::string& name, const std::filesystem::path& out) {
  const std::string begin = out.stem().string() + "-person-";
  const std::string end = out.extension().string();
  if (name.size() <= begin.size() + end.size()) return false;
  const std::string number = name.substr(begin.size(), name.size() - begin.size() - end.size());
  return name.starts_with(begin) && name.ends_with(end) &&
         std::ranges::all_of(number, [](char c) { return c >= '0' && c <= '9'; });
}

/// Earlier exports to the same --out that were not written again: beside the new ones they would be
/// taken for part of them. What cannot be read is not one.
std::vector<std::filesystem::path> StaleExports(const ExportFormat& format,
                                                const std::filesystem::path& out,
                                                std::span<const std::filesystem::path> written) {
  std::vector<std::filesystem::path> stale;
  std::error_code error;
  const std::filesystem::path folder = out.has_parent_path() ? out.parent_path() : ".";
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::filesystem::path file = out.parent_path() / entry.path().filename();
    const bool is_of_out = file == out || IsOfPerson(file.filename().string(), out);
    if (!is_of_out || std::ranges::find(written, file) != written.end()) continue;
    try {
      if (IsOwnFile(file, std::span(&format.beginning, 1))) stale.push_back(file);
    } catch (const SetupError&) {
      continue;
    }
  }
  std::ranges::sort(stale);
  return stale;
}

void ExportOne(const ExportFormat& format, const ExportArguments& arguments) {
  RequireRoomForExport(format, arguments.out);
  const Result result = ReadResult(arguments.result, arguments.prefix);
  TellRemarks("export", result.remarks);
  if (result.poses.empty()) {
    throw SetupError(arguments.result.string() + ": contains no frame; expected at least one");
  }
  const ExportSubject subject{"", result};
  const ExportScene scene{std::span(&subject, 1), result.poses, arguments.out.filename().string(),
                          false, &SkeletonOf(arguments)};
  WriteScene(format, scene, arguments.result.string(), "", arguments.out);
  // Their names are not this command's to remove.
  for (const auto& file : StaleExports(format, arguments.out, std::span(&arguments.out, 1)))
    TellRemarks("export", {file.string() + ": was not written now; it is of an earlier export"});
}

/// "walk.bvh" of person-1 becomes walk-person-1.bvh; of anna in a log, walk-anna.bvh.
std::filesystem::path FileOf(const std::filesystem::path& out, const std::string& name) {
  std::filesystem::path file = out;
  return file.replace_filename(out.stem().string() + '-' + name + out.extension().string());
}

/// Reads the results of people who were ever tracked.
PeopleResults ReadTrackedPeople(const ExportArguments& arguments) {
  PeopleResults people = ReadPeople(arguments.result, arguments.prefix);
  for (const auto& [name, result] : people) TellRemarks("export", result.remarks);
  std::erase_if(people, [](const auto& person) {
    return std::ranges::none_of(person.second.poses, IsTracked);
  });
  if (people.empty()) {
    throw SetupError(arguments.result.string() + ": contains no tracked person");
  }
  return people;
}

/// Writes each person's file, and a common one if the format supports it.
void ExportPeople(const ExportFormat& format, const ExportArguments& arguments) {
  const PeopleResults people = ReadTrackedPeople(arguments);
  std::vector<ExportSubject> subjects;
  for (const auto& [name, result] : people) subjects.push_back({name, result});
  if (format.holds_everybody) RequireRoomForExport(format, arguments.out);
  for (const ExportSubject& subject : subjects) {
    RequireRoomForExport(format, FileOf(arguments.out, subject.name));
  }
  const std::vector<PoseRow> moments = MomentsOf(people);
  std::vector<std::filesystem::path> written;
  const auto write = [&](std::span<const ExportSubject> whom, bool is_of_all,
                         const std::string& whose, const std::filesystem::path& file) {
    const ExportScene scene{whom, moments, file.filename().string(), is_of_all,
                            &SkeletonOf(arguments)};
    WriteScene(format, scene, arguments.result.string(), whose, file);
    written.push_back(file);
  };
  if (format.holds_everybody) write(subjects, true, "", arguments.out);
  for (const ExportSubject& subject : subjects) {
    write(std::span(&subject, 1), false, subject.name + ": ", FileOf(arguments.out, subject.name));
  }
  for (const auto& file : StaleExports(format, arguments.out, written)) {
    std::error_code error;
    if (std::filesystem::remove(file, error))
      TellRemarks("export", {file.string() + ": removed, an earlier export to the same --out"});
  }
}

void Export(const ExportArguments& arguments) {
  const ExportFormat& format = FindExportFormat(arguments.format);
  RequireSuffix(arguments.out, fmt::format(".{}", format.name));
  SkeletonOf(arguments);
  const bool is_of_people = arguments.people || IsOfPeople(arguments.result);
  is_of_people ? ExportPeople(format, arguments) : ExportOne(format, arguments);
}

}  // namespace

void AddExportCommand(CLI::App& app) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command =
      app.add_subcommand("export", "Export a result for animation, biomechanics or spreadsheets");
  command
      ->add_option("RESULT", arguments->result,
                   "result folder of mocap track, for one person or several, or an LCM log")
      ->required();
  command->add_option("--format", arguments->format, FormatsText())
      ->required()
      ->check(OneOf(FormatNames()));
  command
      ->add_option("--out", arguments->out,
                   "output file with the format's suffix; with several people one file each, such "
                   "as walk-person-1.bvh, or walk-anna.bvh for a named person in a log; "
                   "earlier exports to the same FILE are replaced")
      ->required();
  command->add_option("--skeleton", arguments->skeleton, SkeletonsText())
      ->check(OneOf(SkeletonNames()));
  command->add_option("--prefix", arguments->prefix,
                      "prefix of the LCM channel names, for a log of several daemons");
  command->add_flag("--people", arguments->people,
                    "with a log: all people, not only the one tracked longest");
  command->callback([arguments] { Export(*arguments); });
}

}  // namespace mocap
