#include "tools/remarks.h"

#include <cstdio>

#include "drivers/printable_text.h"

namespace mocap {

void TellRemarks(const std::string& command, const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) {
    std::fprintf(stderr, "mocap %s: %s\n", command.c_str(), Printable(remark).c_str());
  }
}

}  // namespace mocap
