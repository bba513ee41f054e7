#include "drivers/take/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/errors.h"

namespace mocap {
namespace {

[[noreturn]] void Fail(const std::filesystem::path& path, const std::string& what,
                       std::string_view wanted) {
  throw SetupError(path.string() + ": " + what + "; expected " + std::string(wanted));
}

bool IsAbsence(int error) { return error == ENOENT || error == ENOTDIR; }

/// Throws a message for errno.
[[noreturn]] void FailByErrno(const std::filesystem::path& path, std::string_view wanted) {
  if (path.empty()) throw SetupError("a path is empty; expected " + std::string(wanted));
  if (IsAbsence(errno)) Fail(path, "not found", wanted);
  Fail(path, std::string("cannot be opened: ") + std::strerror(errno), wanted);
}

void RequireRegular(const std::filesystem::path& file, const struct stat& status,
                    std::string_view wanted) {
  if (S_ISDIR(status.st_mode)) Fail(file, "is a folder", wanted);
  if (!S_ISREG(status.st_mode)) Fail(file, "is not a regular file", wanted);
}

/// Closes a file descriptor.
class Closing {
 public:
  explicit Closing(int fd) : fd_(fd) {}
  ~Closing() { close(fd_); }
  Closing(const Closing&) = delete;
  Closing& operator=(const Closing&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

}  // namespace

bool IsThere(const std::filesystem::path& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) == 0) return true;
  if (IsAbsence(errno)) return false;
  throw SetupError(path.string() + ": cannot be accessed: " + std::strerror(errno) +
                   "; expected a path that may be used");
}

int OpenToRead(const std::filesystem::path& file, std::string_view wanted) {
  // Only files are opened: a pipe would block until its other end opens.
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) FailByErrno(file, wanted);
  RequireRegular(file, status, wanted);
  const int fd = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) FailByErrno(file, wanted);
  return fd;
}

void RequireFile(const std::filesystem::path& file, std::string_view wanted) {
  const Closing opened(OpenToRead(file, wanted));
}

void RequireFolder(const std::filesystem::path& folder, std::string_view wanted) {
  struct stat status {};
  if (stat(folder.c_str(), &status) != 0) FailByErrno(folder, wanted);
  if (!S_ISDIR(status.st_mode)) Fail(folder, "is not a folder", wanted);
}

std::string ReadWholeFile(const std::filesystem::path& file, std::string_view wanted,
                          std::size_t most_bytes) {
  const Closing opened(OpenToRead(file, wanted));
  std::string text;
  std::size_t size = 0;
  for (;;) {
    text.resize(std::min(most_bytes + 1, std::max<std::size_t>(4096, 2 * size)));
    const ssize_t got = read(opened.get(), text.data() + size, text.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) FailByErrno(file, wanted);
    size += static_cast<std::size_t>(got);
    if (size > most_bytes) {
      Fail(file, "is larger than " + std::to_string(most_bytes >> 20) + " MB", wanted);
    }
    if (got == 0) break;
  }
  text.resize(size);
  return text;
}

std::filesystem::path PlainFolder(const std::filesystem::path& folder) {
  const std::filesystem::path plain = folder.lexically_normal();
  return plain.has_filename() || !plain.has_relative_path() ? plain : plain.parent_path();
}

}  // namespace mocap
