// Runs another program for one request, with limits on its time and output.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mocap {

/// How another program ended, and its output until then.
struct ProgramRun {
  enum class End { kExited, kKilledBySignal, kNotStarted, kDeadlinePassed, kSaidTooMuch };

  End end = End::kNotStarted;
  int number = 0;               ///< Exit status, signal, or errno of the failed start; otherwise 0.
  std::string output = {};      ///< Its standard output.
  std::string last_words = {};  ///< Last line of its standard error that is not blank.
};

struct ProgramLimits {
  std::chrono::milliseconds patience{0};  ///< Time limit for the whole run.
  std::size_t longest_output = 0;         ///< [bytes]
};

/// Whether RunOtherProgram would find a program: a path, or a name in PATH.
bool IsProgram(const std::string& name);

/// Runs a program without a shell, in its own session, so that it cannot prompt on a terminal.
///
/// In every case, the program and its process group are killed at the end: no process and no
/// descriptor is left. Thread-safe.
/// @param command  the program, looked up in PATH, and its arguments.
/// @param input    its whole standard input; at most PIPE_BUF bytes.
ProgramRun RunOtherProgram(const std::vector<std::string>& command, std::string_view input,
                           const ProgramLimits& limits);

}  // namespace mocap
