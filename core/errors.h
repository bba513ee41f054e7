// Failures of set-up and of the program itself. An outage (a timeout, a torn frame) is a value,
// never an exception.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace mocap {

/// Reports input that cannot be used: a command line, a configuration, a take, a calibration.
///
/// The message is one line: where (file, line or key), what was found, what is wanted. Caught in
/// `main`, which prints it and exits with 2.
class SetupError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Ends the program with a message, for states that only a bug can reach.
[[noreturn]] inline void AbortOnBug(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: bug: %s does not hold\n", file, line, condition);
  std::abort();
}

}  // namespace mocap

/// Always-on check of an invariant.
#define MOCAP_CHECK(condition) \
  ((condition) ? static_cast<void>(0) : ::mocap::AbortOnBug(#condition, __FILE__, __LINE__))
