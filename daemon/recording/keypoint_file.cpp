#include "daemon/recording/keypoint_file.h"

#include <span>
#include <sstream>
#include <stdexcept>

#include "drivers/take/keypoint_table.h"

namespace mocap {
namespace {

/// Pictures whose people are known.
constexpr std::size_t kMostPictures = 1000;

}  // namespace

void KeypointFile::Write(KeypointView view) {
  const bool is_first = !out_.is_open();
  if (is_first) out_.open(file_, std::ios::binary);
  view.person = FreeNumber(view);
  std::ostringstream text;
  WriteKeypoints(text, std::span(&view, 1));
  // The header is a line.
  const std::string table = text.str();
  out_ << (is_first ? table : table.substr(table.find('\n') + 1));
  RequireGood();
}

void KeypointFile::Flush() {
  if (!out_.is_open()) return;
  out_.flush();
  RequireGood();
}

int KeypointFile::FreeNumber(const KeypointView& view) {
  std::set<int>& taken = numbers_[{view.capture_ns, view.camera}];
  int number = view.person;
  for (int next = 0; !taken.insert(number).second; ++next) number = next;
  if (numbers_.size() > kMostPictures) numbers_.erase(numbers_.begin());
  return number;
}

void KeypointFile::RequireGood() const {
  if (!out_) throw std::runtime_error(file_.string() + ": cannot be written");
}

}  // namespace mocap
