// A file with the carved sets of a take, to be read in any order.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <vector>

#include "core/solving/recorded_set.h"

namespace mocap {

/// Where the sets of a file are.
struct SpoolIndex {
  std::vector<std::int64_t> offset;
  std::vector<std::int64_t> capture_ns;
};

/// Writes sets one after the other. A person at 30 sets a second takes about 5 GB an hour.
class SetSpoolWriter {
 public:
  /// @throws std::runtime_error  here and below, when the file cannot be written.
  explicit SetSpoolWriter(const std::filesystem::path& file);

  void Add(const RecordedSet& set);
  /// Completes the file.
  SpoolIndex Finish();

 private:
  std::filesystem::path file_;
  std::ofstream out_;
  std::vector<char> bytes_;
  SpoolIndex index_;
};

/// Reads them. One for each thread.
class SetSpoolReader : public RecordedSets {
 public:
  /// @param index  borrowed.
  SetSpoolReader(const std::filesystem::path& file, const SpoolIndex& index);

  int count() const override { return static_cast<int>(index_.offset.size()); }
  std::int64_t capture_ns(int set) const override { return index_.capture_ns[set]; }
  /// @throws std::runtime_error  when the file was changed, or the command is asked to stop.
  void Read(int set, RecordedSet& recorded) override;

 private:
  std::filesystem::path file_;
  std::ifstream in_;
  const SpoolIndex& index_;
  std::vector<char> bytes_;
};

}  // namespace mocap
