// The people whose sizes are kept.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/body/body_sizes.h"
#include "core/people/recognition.h"

namespace mocap {

/// One file a person in a folder, which is made when it is needed. Thread-bound.
class Subjects {
 public:
  explicit Subjects(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Keeps sizes under a name, in place of what was there. @throws std::runtime_error
  void Save(const std::string& name, const BodySizes& sizes) const;
  /// @throws SetupError  when there is none, or its file is damaged.
  BodySizes Load(const std::string& name) const;
  /// All but those whose files are damaged, by name.
  std::vector<KnownPerson> Known() const;
  /// Names in order.
  std::vector<std::string> Names() const;

 private:
  std::filesystem::path FileOf(const std::string& name) const;

  std::filesystem::path folder_;
};

}  // namespace mocap
