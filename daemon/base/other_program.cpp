#include "daemon/base/other_program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <system_error>
#include <utility>

#include "daemon/base/file_descriptor.h"

namespace mocap {
namespace {

using Clock = std::chrono::steady_clock;
using End = ProgramRun::End;

/// Kept of standard error: only the last line is needed.
constexpr std::size_t kMostWordsKept = 4096;
/// A program that floods one pipe cannot keep us from the other pipe or the deadline.
constexpr int kReadsInARow = 16;

void Require(bool is_done) {
  if (!is_done) throw std::system_error(errno, std::generic_category());
}

struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    Require(pipe2(ends.data(), O_CLOEXEC) == 0);
    read = FileDescriptor(ends[0]);
    write = FileDescriptor(ends[1]);
  }

  FileDescriptor read, write;
};

/// Returns a pipe that contains a text, then ends. The pipe buffers this much without a reader.
FileDescriptor PipeOf(std::string_view text) {
  Pipe pipe;
  Require(write(pipe.write.get(), text.data(), text.size()) == std::ssize(text));
  return std::move(pipe.read);
}

/// What the child does not inherit: files, session, and blocked or ignored signals.
class SpawnSettings {
 public:
  SpawnSettings(int input, int output, int words) {
    posix_spawn_file_actions_init(&files_);
    posix_spawn_file_actions_adddup2(&files_, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files_, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files_, words, STDERR_FILENO);
    posix_spawn_file_actions_addclosefrom_np(&files_, STDERR_FILENO + 1);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    sigaddset(&signals, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    posix_spawnattr_setflags(&attributes_,
                             POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings() {
    posix_spawnattr_destroy(&attributes_);
    posix_spawn_file_actions_destroy(&files_);
  }

  pid_t Spawn(const std::vector<std::string>& command) const {
    std::vector<char*> words;
    for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    pid_t process = 0;
    errno = posix_spawnp(&process, words[0], &files_, &attributes_, words.data(), environ);
    Require(errno == 0);
    return process;
  }

 private:
  posix_spawn_file_actions_t files_;
  posix_spawnattr_t attributes_;
};

/// A process that leads its own process group. The whole group is killed at the end.
class Child {
 public:
  explicit Child(pid_t process) : process_(process) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (process_ > 0) End();
  }

  /// Becomes readable when the process has ended. Its status is kept until End.
  FileDescriptor HasEnded() const {
    // glibc 2.36 declares pidfd_open for C only.
    FileDescriptor ended(static_cast<int>(syscall(SYS_pidfd_open, process_, 0)));
    Require(ended.valid());
    return ended;
  }
  /// @return  the status, as from waitpid.
  int End() {
    // The process id cannot be reused until the process has been waited for.
    kill(-process_, SIGKILL);
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
    return status;
  }

 private:
  pid_t process_;
};

/// One of the child's output pipes, and what was read from it.
class Ear {
 public:
  explicit Ear(FileDescriptor end) : end_(std::move(end)) {
    Require(fcntl(end_.get(), F_SETFL, O_NONBLOCK) == 0);
  }

  /// -1 after the end of the stream.
  int descriptor() const { return end_.get(); }
  std::string& heard() { return heard_; }

  void Listen() {
    std::array<char, 4096> bytes;
    for (int i = 0; i < kReadsInARow && end_.valid(); ++i) {
      const ssize_t count = read(end_.get(), bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0 && errno == EAGAIN) return;
      if (count <= 0) end_.Reset();
      heard_.append(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    }
  }

 private:
  FileDescriptor end_;
  std::string heard_;
};

End ListenUntilEnd(const FileDescriptor& has_ended, const ProgramLimits& limits, Ear& output,
                   Ear& words) {
  const Clock::time_point deadline = Clock::now() + limits.patience;
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return End::kDeadlinePassed;
    std::array<pollfd, 3> waits = {{{has_ended.get(), POLLIN, 0},
                                    {output.descriptor(), POLLIN, 0},
                                    {words.descriptor(), POLLIN, 0}}};
    if (poll(waits.data(), waits.size(), static_cast<int>(std::min<long>(left, 60'000))) < 0) {
      Require(errno == EINTR);
      continue;
    }
    output.Listen();
    words.Listen();
    std::string& kept = words.heard();
    if (kept.size() > kMostWordsKept) kept.erase(0, kept.size() - kMostWordsKept);
    if (output.heard().size() > limits.longest_output) return End::kSaidTooMuch;
    // All output from before the exit has been read. Other processes may keep the pipes open.
    if (waits[0].revents != 0) return End::kExited;
  }
}

std::string LastLine(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::size_t last = text.find_last_not_of(kBlank);
  if (last == std::string_view::npos) return {};
  text = text.substr(0, last + 1);
  const std::size_t before = text.find_last_of("\r\n");
  return std::string(before == std::string_view::npos ? text : text.substr(before + 1));
}

ProgramRun Run(const std::vector<std::string>& command, std::string_view input,
               const ProgramLimits& limits) {
  FileDescriptor in = PipeOf(input);
  Pipe out, err;
  Child child(SpawnSettings(in.get(), out.write.get(), err.write.get()).Spawn(command));
  for (FileDescriptor* of_child : {&in, &out.write, &err.write}) of_child->Reset();
  Ear output(std::move(out.read)), words(std::move(err.read));
  ProgramRun run;
  run.end = ListenUntilEnd(child.HasEnded(), limits, output, words);
  const int status = child.End();
  if (run.end == End::kExited && WIFSIGNALED(status)) {
    run.end = End::kKilledBySignal;
    run.number = WTERMSIG(status);
  } else if (run.end == End::kExited) {
    run.number = WEXITSTATUS(status);
  }
  run.output = std::move(output.heard());
  run.last_words = LastLine(words.heard());
  return run;
}

}  // namespace

bool IsProgram(const std::string& name) {
  const auto is_executable = [](const std::filesystem::path& file) {
    std::error_code error;
    return std::filesystem::is_regular_file(file, error) && access(file.c_str(), X_OK) == 0;
  };
  if (name.find('/') != std::string::npos) return is_executable(name);
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (is_executable(std::filesystem::path(folder.empty() ? "." : folder) / name)) return true;
  }
  return false;
}

ProgramRun RunOtherProgram(const std::vector<std::string>& command, std::string_view input,
                           const ProgramLimits& limits) {
  try {
    return Run(command, input, limits);
  } catch (const std::system_error& error) {
    return {.end = End::kNotStarted, .number = error.code().value()};
  }
}

}  // namespace mocap
