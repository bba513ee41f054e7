#include "config/parse_toml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/errors.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string Error(const std::string& text) {
  try {
    ParseToml(text, "a.toml");
  } catch (const SetupError& error) {
    return error.what();
  }
  return "none";
}

std::string Repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

TEST(ParseToml, WhatNestsDeeplyIsRefusedInOneLine) {
  const std::string cases[] = {
      "a = 1\nb" + Repeated(".a", 300'000) + " = 1\n",
      "a = 1\n[b" + Repeated(".a", 300'000) + "]\n",
      "a = 1\n[[b" + Repeated(".a", 300'000) + "]]\n",
      "a = 1\nb = {a" + Repeated(".a", 300'000) + " = 1}\n",
      "a = 1\nb" + Repeated(" . \"x.y\"", 300'000) + " = 1\n",
      "a = 1\nb = " + Repeated("[", 300'000) + "\n",
      "a = 1\nb = " + Repeated("{a = ", 300'000) + "\n",
  };
  for (const std::string& text : cases) {
    EXPECT_THAT(Error(text), AllOf(HasSubstr("a.toml:2: has "), HasSubstr("expected flat tables")))
        << text.substr(0, 40);
  }
}

TEST(ParseToml, DotsAndBracketsInStringsAndCommentsNestNothing) {
  const std::string dots = Repeated(".", 100) + Repeated("[{", 100);
  EXPECT_EQ(Error("a = \"" + dots + "\\\"" + dots + "\" # " + dots + "\nb = '" + dots + "'\n"),
            "none");
  EXPECT_EQ(Error("a = \"\"\"x\n\"" + dots + "\"\"\"\"\"\nb = '''\n'" + dots + "'''''\n"), "none");
  EXPECT_EQ(Error("a = [" + Repeated("[1.5, 2.5],", 100) + "]\n"), "none");
}

TEST(ParseToml, LinesAreCountedThroughStringsOfSeveral) {
  EXPECT_THAT(Error("a = '''\n\n'''\nb = \"\"\"\n\\\n\"\"\"\nc" + Repeated(".c", 99) + " = 1\n"),
              HasSubstr("a.toml:7: "));
}

TEST(ParseToml, IsReadHoweverAnEditorSavedIt) {
  const char* saved[] = {
      "\xef\xbb\xbf"
      "a = 1\r\nb = 2\r\n",
      "a = 1\rb = 2\r", "a = 1\nb = 2"};
  for (const char* text : saved) {
    EXPECT_EQ(ParseToml(text, "a.toml")["b"].value<int>(), 2) << text;
  }
}

TEST(ParseToml, WhatIsNoTomlIsOneShortLineWithoutControlCharacters) {
  const std::string wrong[] = {std::string("a = 1\n\0", 7),
                               "\xff\xfe a",
                               "a = \x1b[31m\n",
                               "a = \"\x1b[31m\"\n",
                               std::string(100'000, 'x'),
                               "a = \"" + std::string(100'000, 'x')};
  for (const std::string& text : wrong) {
    const std::string error = Error(text);
    EXPECT_THAT(error, AllOf(HasSubstr("a.toml:"), Not(HasSubstr("\x1b")), Not(HasSubstr("\n"))));
    EXPECT_LT(error.size(), 250u);
  }
}

TEST(ParseToml, AFileThatIsFarTooLargeIsRefused) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "large.toml";
  testing::WriteText(file, "# " + std::string(5 << 20, 'x') + "\n");
  EXPECT_THROW(ParseTomlFile(file), SetupError);
}

}  // namespace
}  // namespace mocap
