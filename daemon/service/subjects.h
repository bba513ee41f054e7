// The people whose sizes are stored.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/body/body_sizes.h"
#include "core/body/recognition.h"

namespace mocap {

/// One file per person, in a folder that is created when needed. Thread-bound.
class Subjects {
 public:
  explicit Subjects(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Stores sizes under a name, replacing older ones. @throws std::runtime_error
  void Save(const std::string& name, const BodySizes& sizes) const;
  /// @throws SetupError  if there are none, or their file is damaged.
  BodySizes Load(const std::string& name) const;
  /// All except those with damaged files, sorted by name.
  std::vector<KnownPerson> Known() const;
  /// Sorted names.
  std::vector<std::string> Names() const;

 private:
  std::filesystem::path FileOf(const std::string& name) const;

  std::filesystem::path folder_;
};

}  // namespace mocap
