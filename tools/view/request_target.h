// The target of a request: a path and a query.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace mocap {

struct RequestTarget {
  std::string path;  ///< As it came: it is compared, and opens no file.
  std::map<std::string, std::string>
      query;  ///< Percent-decoded; of a name that comes twice, the last.
};

RequestTarget ParseRequestTarget(std::string_view target);

}  // namespace mocap
