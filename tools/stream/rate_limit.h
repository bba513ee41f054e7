// How often a client wants to be told.
#pragma once

#include <cstdint>

namespace mocap {

/// Lets no more than so many a second pass, on the average. What comes at that rate passes as a
/// whole, though some of it comes a little early.
class RateLimit {
 public:
  /// @param hz  infinity: all passes.
  explicit RateLimit(double hz) : hz_(hz) {}

  /// Whether what has come now passes. @param now_ns  by the steady clock.
  bool Passes(std::int64_t now_ns);

 private:
  static constexpr double kMostSaved = 2;

  const double hz_;
  double saved_ = kMostSaved;  ///< Turns that were not taken.
  std::int64_t before_ns_ = 0;
};

}  // namespace mocap
