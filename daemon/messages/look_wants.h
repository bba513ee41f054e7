// What pictures of people clients ask for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mocap/look_request_t.hpp>
#include <optional>
#include <string>
#include <vector>

namespace mocap {

/// What is wanted of all who ask.
struct LookWant {
  double rate_hz = 0;  ///< Of cameras' pictures.
  int person = 0;      ///< 0: everybody.
  int side_px = 0;     ///< 0: as large as they are.
  bool is_raw = false;
};

/// Keeps each asker's last request while it holds. Bounded, whatever comes. Thread-bound.
class LookWants {
 public:
  static constexpr std::size_t kMostAskers = 8;
  static constexpr double kLeastHz = 0.2, kMostHz = 30;
  static constexpr double kLongestHold_s = 60;

  /// Takes a request. Anyone may have sent it: numbers that are none are ignored, others bounded.
  /// @param now_ns  by the steady clock.
  void Take(const look_request_t& request, std::int64_t now_ns);
  /// What satisfies all whose requests still hold: pictures are encoded once. Raw if all want that.
  /// @return  empty: nobody asks.
  std::optional<LookWant> At(std::int64_t now_ns);

 private:
  struct Asker {
    std::string name;
    LookWant want;
    std::int64_t until_ns = 0;
  };

  std::vector<Asker> askers_;
};

}  // namespace mocap
