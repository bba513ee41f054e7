// The formats of `mocap export`: purpose and writer of each.
#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/interchange/skeletons.h"
#include "tools/results/result.h"

namespace mocap {

/// A person whose motion is exported. Not owned.
struct ExportSubject {
  std::string name;  ///< With several people: person-1, or the person's own. Else empty.
  const Result& result;
};

/// Content of one file. Not owned.
struct ExportScene {
  std::span<const ExportSubject> subjects;  ///< One, or all if the format supports it.
  /// Frames and times of all people tracked together; the first is time 0.
  const std::vector<PoseRow>& moments;
  std::string file_name;                         ///< For formats that contain it.
  bool is_of_all = false;                        ///< Labels then name their subject.
  const Skeleton* skeleton = &MocapdSkeleton();  ///< For BVH.

  /// Prefix of a subject's labels.
  std::string LabelPrefix(const ExportSubject& subject) const;
};

/// What the file does not contain, one line each.
using ExportRemarks = std::vector<std::string>;

struct ExportFormat {
  std::string_view name;       ///< For --format; also the file suffix.
  std::string_view purpose;    ///< For the help.
  std::string_view beginning;  ///< Beginning of each such file, which may be overwritten.
  bool holds_everybody;        ///< With several people, also writes a file of all.
  /// @throws SetupError  when a result has nothing for the format.
  ExportRemarks (*write)(const ExportScene& scene, std::ostream& out);
};

/// All formats, in the order of the help.
std::span<const ExportFormat> ExportFormats();
/// @throws SetupError  for an unknown name.
const ExportFormat& FindExportFormat(std::string_view name);

}  // namespace mocap
