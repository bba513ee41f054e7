// Another program that is asked one thing, bounded in time and in what it says.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mocap {

/// How another program ended, and what it said until then.
struct ProgramRun {
  enum class End { kExited, kKilledBySignal, kNotStarted, kDeadlinePassed, kSaidTooMuch };

  End end = End::kNotStarted;
  int number = 0;           ///< The exit status, the signal, or errno of the start; otherwise 0.
  std::string output = {};  ///< Its standard output.
  std::string last_words = {};  ///< The last line of its standard error that says something.
};

struct ProgramLimits {
  std::chrono::milliseconds patience{0};  ///< Until it has to have ended.
  std::size_t longest_output = 0;         ///< [bytes]
};

/// Runs a program without a shell, in a session of its own, so that it can ask nobody on a
/// terminal.
///
/// It ends with all that it started in its process group, whatever happens: nothing is left of it,
/// no process and no descriptor. Thread-safe.
/// @param command  the program, looked up in PATH, and its arguments.
/// @param input    its standard input, to the end; at most PIPE_BUF bytes.
ProgramRun RunOtherProgram(const std::vector<std::string>& command, std::string_view input,
                           const ProgramLimits& limits);

}  // namespace mocap
