#include "tools/results/true_people.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "drivers/take/text_file.h"
#include "tests/support/box_take.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class TruePeopleTest : public ::testing::Test {
 protected:
  TruePeopleTest() {
    testing::WriteBoxTake(take_);
    for (const char* person : {"person-2", "person-10"}) {
      std::filesystem::create_directory(take_ / person);
      for (const char* file : {"truth.csv", "truth.toml"}) {
        std::filesystem::copy(take_ / file, take_ / person / file);
      }
    }
  }
  void Describe(const std::string& more) {
    ReplaceText(take_ / "take.toml", testing::ReadText(take_ / "take.toml") + more);
  }

  const testing::TemporaryFolder folder_;
  const std::filesystem::path take_ = folder_.path() / "take";
};

TEST_F(TruePeopleTest, EachPersonHasATruthInTheOrderOfTheNumbers) {
  const std::vector<TruePerson> people = ReadTruePeople(take_);
  ASSERT_EQ(people.size(), 2u);
  EXPECT_EQ(people[0].name, "person-2");
  EXPECT_EQ(people[1].name, "person-10");
  EXPECT_EQ(people[0].truth.frames.size(), static_cast<std::size_t>(testing::kFrames));
  EXPECT_THAT(people[0].covered, ::testing::Each(true)) << "the take does not tell";
}

TEST_F(TruePeopleTest, WhoNeverCameIntoTheRoomIsLeftOut) {
  const std::filesystem::path table = take_ / "person-2" / "truth.csv";
  const std::string text = testing::ReadText(table);
  ReplaceText(table, text.substr(0, text.find('\n') + 1));
  const std::vector<TruePerson> people = ReadTruePeople(take_);
  ASSERT_EQ(people.size(), 1u);
  EXPECT_EQ(people[0].name, "person-10");
}

TEST_F(TruePeopleTest, TheTakeTellsInWhichFramesSomebodyIsCovered) {
  Describe("\n[[person]]\nfolder = \"person-2\"\ncovered = [[1, 2], [5, 5]]\n");
  const std::vector<bool> covered = ReadTruePeople(take_)[0].covered;
  EXPECT_THAT(std::vector<bool>(covered.begin(), covered.begin() + 7),
              ElementsAre(false, true, true, false, false, true, false));
}

TEST_F(TruePeopleTest, AStretchWithoutAnEndIsRefused) {
  Describe("\n[[person]]\nfolder = \"person-2\"\ncovered = [[1, 2], [5]]\n");
  try {
    ReadTruePeople(take_);
    FAIL();
  } catch (const SetupError& error) {
    EXPECT_THAT(error.what(), HasSubstr("covered"));
    EXPECT_THAT(error.what(), HasSubstr("take.toml"));
  }
}

TEST_F(TruePeopleTest, ATakeOfOnePersonHasOne) {
  std::filesystem::remove_all(take_ / "person-2");
  std::filesystem::remove_all(take_ / "person-10");
  const std::vector<TruePerson> people = ReadTruePeople(take_);
  ASSERT_EQ(people.size(), 1u);
  EXPECT_EQ(people[0].name, "truth");
  std::filesystem::remove(take_ / "truth.csv");
  EXPECT_TRUE(ReadTruePeople(take_).empty());
}

}  // namespace
}  // namespace mocap
