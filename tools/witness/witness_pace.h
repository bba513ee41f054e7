// How often a live witness may look.
#pragma once

#include <cstdint>

namespace mocap {

/// Keeps a witness within its share of one processor's time. Thread-bound.
class WitnessPace {
 public:
  /// @param rate_hz  wanted looks at each person. @param share  of one processor, above 0.
  WitnessPace(double rate_hz, double share) : rate_hz_(rate_hz), share_(share) {}

  /// Notes a look that began then and took so much of a processor's time.
  void Note(std::int64_t begin_ns, std::int64_t cpu_ns);

  /// When the next look may begin; 0: at once.
  std::int64_t next_ns() const { return next_ns_; }
  /// Pictures of cameras to ask for, per second.
  /// @param people  whom each picture shows. @param is_in_doubt  whether somebody's pose is in
  /// doubt: twice as many looks are wanted then.
  double Rate(int people, bool is_in_doubt) const;

 private:
  const double rate_hz_, share_;
  double look_ns_ = 0;  ///< Processor time of a look, as lately; 0 before the first.
  std::int64_t next_ns_ = 0;
};

}  // namespace mocap
