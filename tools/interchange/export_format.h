// The formats of `mocap export`: what each is for, and who writes it.
#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/results/result.h"

namespace mocap {

/// Somebody whose motion is exported. Borrowed.
struct ExportSubject {
  std::string name;  ///< Of several people: person-1, or his own. Empty: nobody else is there.
  const Result& result;
};

/// What goes into one file. Borrowed.
struct ExportScene {
  std::span<const ExportSubject> subjects;  ///< One, or everybody where the format holds them.
  /// Frames and times of all who were tracked together; the first of them is time 0.
  const std::vector<PoseRow>& moments;
  std::string file_name;   ///< For formats that tell it.
  bool is_of_all = false;  ///< Labels say then whose they are.

  /// What stands before a subject's labels.
  std::string LabelPrefix(const ExportSubject& subject) const;
};

/// What a person should know is not in the file, a line each.
using ExportRemarks = std::vector<std::string>;

struct ExportFormat {
  std::string_view name;       ///< Of --format; files end in it.
  std::string_view purpose;    ///< For the help.
  std::string_view beginning;  ///< Of each such file: what may be written over.
  bool holds_everybody;        ///< Of several people there is a file of all, too.
  /// @throws SetupError  when a result has nothing that the format can hold.
  ExportRemarks (*write)(const ExportScene& scene, std::ostream& out);
};

/// All of them, as the help lists them.
std::span<const ExportFormat> ExportFormats();
/// @throws SetupError  for a name that is none.
const ExportFormat& FindExportFormat(std::string_view name);

}  // namespace mocap
