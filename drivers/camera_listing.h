// List of the connected cameras, for people.
#pragma once

#include <string>
#include <vector>

namespace mocap {

/// One camera that was found.
struct ListedCamera {
  std::string driver;  ///< As in `source.driver`.
  std::string device;  ///< Value for `device`: the name that stays valid longest.
  std::string model;
  std::string serial;      ///< Empty if it has none.
  std::string bus;         ///< Bus, or network address.
  double link_mbit_s = 0;  ///< 0: unknown.
  /// One line per format, with its sizes and rates.
  std::vector<std::string> formats;
  std::vector<std::string> remarks;  ///< Obstacles to using it.
};

}  // namespace mocap
