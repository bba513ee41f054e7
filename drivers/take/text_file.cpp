#include "drivers/take/text_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "core/errors.h"
#include "drivers/lowered.h"
#include "drivers/take/input_file.h"

namespace mocap {
namespace {

constexpr mode_t kAsUsual = 0666;

std::string Problem(const std::filesystem::path& file) {
  const char* wanted = errno == ENOSPC || errno == EDQUOT
                           ? "free space on its disk"
                           : "a file in an existing folder with write permission";
  return file.string() + ": cannot be written: " + std::strerror(errno) + "; expected " + wanted;
}

/// A file being written; messages may use another name.
class Output {
 public:
  Output(const std::filesystem::path& file, std::filesystem::path name)
      : name_(std::move(name)),
        fd_(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kAsUsual)) {
    Check(fd_ >= 0);
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output() {
    if (fd_ >= 0) close(fd_);
  }

  void Write(const std::string& text) const {
    for (std::size_t done = 0; done < text.size();) {
      const ssize_t written = write(fd_, text.data() + done, text.size() - done);
      if (written < 0 && errno == EINTR) continue;
      Check(written > 0);
      done += static_cast<std::size_t>(written);
    }
  }
  void Sync() const { Check(fsync(fd_) == 0); }
  void Resemble(const struct stat& old) const {
    Check(fchmod(fd_, old.st_mode & 07777) == 0);
    // Only root may change the owner. Otherwise the current user stays the owner.
    if (fchown(fd_, old.st_uid, old.st_gid) != 0) errno = 0;
  }
  void Close() {
    const int result = close(fd_);
    fd_ = -1;
    Check(result == 0);
  }

 private:
  void Check(bool is_good) const {
    if (!is_good) throw std::runtime_error(Problem(name_));
  }

  std::filesystem::path name_;
  int fd_;
};

std::filesystem::path PartOf(const std::filesystem::path& file) { return file.string() + ".part"; }

/// The target of a symbolic link, or the file itself.
std::filesystem::path Behind(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path target = std::filesystem::canonical(file, error);
  return error ? file : target;
}

bool IsSpecial(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

std::string BeginningOf(const std::filesystem::path& file) {
  constexpr std::size_t kLongestBeginning = 256;
  std::string begin(kLongestBeginning, '\0');
  const int fd = OpenToRead(file, "a file to write over");
  const ssize_t got = read(fd, begin.data(), begin.size());
  close(fd);
  begin.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  return begin;
}

}  // namespace

void WriteText(const std::filesystem::path& file, const std::string& text) {
  Output out(file, file);
  out.Write(text);
  out.Close();
}

void ReplaceText(const std::filesystem::path& file, const std::string& text) {
  if (IsSpecial(file)) return WriteText(file, text);
  const std::filesystem::path target = Behind(file);
  const std::filesystem::path part = PartOf(target);
  try {
    Output out(part, file);
    out.Write(text);
    struct stat old {};
    if (stat(target.c_str(), &old) == 0) out.Resemble(old);
    out.Sync();
    out.Close();
    if (rename(part.c_str(), target.c_str()) != 0) throw std::runtime_error(Problem(file));
  } catch (...) {
    unlink(part.c_str());
    throw;
  }
}

void RequireWritable(const std::filesystem::path& file) {
  if (file.empty()) throw SetupError("the name of a file to write is empty; expected a name");
  const bool is_special = IsSpecial(file);
  const std::filesystem::path tried = is_special ? file : PartOf(Behind(file));
  if (const int fd = open(tried.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, kAsUsual); fd >= 0) {
    close(fd);
  } else {
    throw SetupError(Problem(file));
  }
  if (!is_special) unlink(tried.c_str());
}

void RequireSuffix(const std::filesystem::path& file, std::string_view suffix) {
  if (Lowered(file.extension().string()) == suffix) return;
  throw SetupError(file.string() + ": does not end in " + std::string(suffix) +
                   ", the suffix of what is written");
}

bool IsOwnFile(const std::filesystem::path& file, std::span<const std::string_view> beginnings) {
  if (!IsThere(file) || IsSpecial(file)) return false;
  const std::string begin = BeginningOf(file);
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](std::string_view own) { return begin.starts_with(own); });
}

void RequireOwn(const std::filesystem::path& file, std::span<const std::string_view> beginnings,
                std::string_view kind) {
  if (!IsThere(file) || IsSpecial(file) || IsOwnFile(file, beginnings)) return;
  if (BeginningOf(file).empty()) return;
  throw SetupError(file.string() + ": exists and is not " + std::string(kind) +
                   " of mocap; expected the name of a new file");
}

void MakeFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw SetupError(folder.string() + ": the folder cannot be created: " + error.message() +
                     "; expected another folder");
  }
  RequireFolder(folder, "a folder for results");
}

}  // namespace mocap
