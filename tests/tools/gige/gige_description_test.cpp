#include "tools/gige/gige_description.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mocap {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(GigeDescription, TriggersAndRateAreTheStudiosToObey) {
  const std::string xml = DescribeGigeCamera(false);
  EXPECT_THAT(xml, HasSubstr("<Address>0x340</Address>"));
  EXPECT_THAT(xml, Not(HasSubstr("<Address>0x300</Address>")));
  EXPECT_THAT(xml, Not(HasSubstr("<Address>0x138</Address>")));
}

TEST(GigeDescription, PtpIsThereWhenWanted) {
  EXPECT_THAT(DescribeGigeCamera(true), HasSubstr("\"PtpStatus\""));
  EXPECT_THAT(DescribeGigeCamera(false), Not(HasSubstr("Ptp")));
}

}  // namespace
}  // namespace mocap
