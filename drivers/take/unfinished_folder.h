// Folders of work that may fail.
#pragma once

#include <filesystem>
#include <system_error>
#include <utility>

namespace mocap {

/// Removes a folder with its contents, unless the work in it was finished.
class UnfinishedFolder {
 public:
  explicit UnfinishedFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}
  ~UnfinishedFolder() {
    std::error_code error;
    if (!is_finished_) std::filesystem::remove_all(folder_, error);
  }
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;

  /// The folder stays.
  void Finish() { is_finished_ = true; }

 private:
  const std::filesystem::path folder_;
  bool is_finished_ = false;
};

}  // namespace mocap
