#include "drivers/utc_time.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

TEST(UtcTime, ComesBackToTheSecond) {
  EXPECT_EQ(UtcText(951'782'400), "2000-02-29T00:00:00Z");
  EXPECT_EQ(UtcFromText("2000-02-29T00:00:00Z"), 951'782'400);
  EXPECT_EQ(UtcFromText(UtcText(1'795'291'261)), 1'795'291'261);
}

TEST(UtcTime, TakesNothingElse) {
  for (const char* text : {"", "2000-02-29", "2000-02-29T00:00:00", "2000-13-01T00:00:00Z",
                           "2000-02-29T00:00:00Z later"}) {
    EXPECT_FALSE(UtcFromText(text)) << text;
  }
}

}  // namespace
}  // namespace mocap
