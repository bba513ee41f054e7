// The target of a request: a path and a query.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace mocap {

struct RequestTarget {
  std::string path;  ///< As received: it is only compared, and opens no file.
  std::map<std::string, std::string>
      query;  ///< Percent-decoded; the last value of a repeated name.
};

RequestTarget ParseRequestTarget(std::string_view target);

}  // namespace mocap
