// The cameras that are connected, for a person who looks for them.
#pragma once

#include <string>
#include <vector>

namespace mocap {

/// One camera that was found.
struct ListedCamera {
  std::string driver;  ///< As `source.driver` names it.
  std::string device;  ///< What to write as `device`: the name that stays the same longest.
  std::string model;
  std::string serial;      ///< Empty: it has none.
  std::string bus;         ///< Or its network address.
  double link_mbit_s = 0;  ///< 0: unknown.
  /// One line each: a format, its sizes and rates.
  std::vector<std::string> formats;
  std::vector<std::string> remarks;  ///< What stands in the way of using it.
};

}  // namespace mocap
