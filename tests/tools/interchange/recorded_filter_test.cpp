#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/moving_body.h"
#include "tests/support/temporary_folder.h"
#include "tools/interchange/export_format.h"

namespace mocap {
namespace {

std::string Exported(const Result& result, std::string_view format) {
  const ExportSubject subject{"", result};
  std::stringstream file;
  FindExportFormat(format).write({std::span(&subject, 1), result.poses, "walk"}, file);
  return file.str();
}

TEST(RecordedFilter, IsInTheFilesThatHaveAPlaceForIt) {
  Result solved = testing::SwingingResult(12);
  solved.filter = "butterworth:4:6";
  const Result live = testing::SwingingResult(12);
  for (const char* format : {"c3d", "glb", "mot"}) {
    EXPECT_THAT(Exported(solved, format), ::testing::HasSubstr("butterworth:4:6")) << format;
    EXPECT_THAT(Exported(live, format), ::testing::Not(::testing::HasSubstr("butterworth")))
        << format;
  }
}

TEST(RecordedFilter, IsInTheResultsFolder) {
  const testing::TemporaryFolder folder;
  Result result = testing::SwingingResult(3);
  for (const std::optional<std::string>& filter :
       {std::optional<std::string>(), std::optional<std::string>("butterworth:4:6")}) {
    result.filter = filter;
    WriteResult(folder.path(), result);
    EXPECT_EQ(ReadResult(folder.path()).filter, filter);
  }
}

}  // namespace
}  // namespace mocap
