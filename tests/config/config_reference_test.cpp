// config/mocapd.toml, which explains every key, against what the code reads.
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "config/load_config.h"
#include "core/errors.h"
#include "tests/support/temporary_folder.h"

namespace mocap {
namespace {

const std::filesystem::path kSource = MOCAP_SOURCE_DIR;

std::string Reference() { return testing::ReadText(kSource / "config/mocapd.toml"); }

/// Keys that the readers of the configuration ask for.
std::set<std::string> KeysInCode() {
  static const std::regex kAsked(
      R"re((?:Text|Texts|Flag|Choice|Number|Numbers|NumberWithin|IntegerWithin|Integers|Section|Sections|Has)\(\s*"(\w+)")re");
  static const std::regex kOptional(R"re((?:OptionalWithin|ReadRange)\(section, "(\w+)")re");
  std::set<std::string> keys;
  for (const char* file :
       {"load_config.cpp", "load_service_config.cpp", "read_cameras.cpp", "read_nodes.cpp"}) {
    const std::string code = testing::ReadText(kSource / "config" / file);
    for (const std::regex& asks : {kAsked, kOptional}) {
      for (std::sregex_iterator i(code.begin(), code.end(), asks), end; i != end; ++i) {
        keys.insert((*i)[1]);
      }
    }
  }
  return keys;
}

/// Keys that the reference names, in use or as an example.
std::set<std::string> KeysInReference() {
  static const std::regex kKey(R"re(^(?:# )?(?:(\w+) = |\[+(\w+)\]+$))re");
  std::set<std::string> keys;
  std::istringstream lines(Reference());
  std::smatch match;
  for (std::string line; std::getline(lines, line);) {
    if (!std::regex_search(line, match, kKey)) continue;
    keys.insert(match[1].matched ? match[1] : match[2]);
  }
  return keys;
}

TEST(ConfigReference, ExplainsEveryKeyThatIsRead) {
  const std::set<std::string> explained = KeysInReference();
  ASSERT_GT(KeysInCode().size(), 40u);
  for (const std::string& key : KeysInCode()) {
    // Where pan_rad is told of, in words.
    const bool is_in_words = Reference().find(key) != std::string::npos;
    EXPECT_TRUE(explained.contains(key) || is_in_words) << key;
  }
}

TEST(ConfigReference, NamesNoKeyThatIsNotRead) {
  const std::set<std::string> read = KeysInCode();
  for (const std::string& key : KeysInReference()) EXPECT_TRUE(read.contains(key)) << key;
}

TEST(ConfigReference, ItsExamplesAreAccepted) {
  // Two cameras, one for each driver, each with all of its driver's keys.
  const std::string text = Reference();
  const std::size_t cameras = text.find("# [[cameras]]");
  ASSERT_NE(cameras, std::string::npos);
  const std::size_t v4l2 = text.find("# For \"v4l2\":", cameras);
  const std::size_t aravis = text.find("# For \"aravis\":", v4l2);
  const auto uncommented = [](const std::string& part) {
    static const std::regex kExample(R"re(^# (\w+ = .*|\[.*)$)re");
    std::string lines;
    std::istringstream in(part);
    std::smatch match;
    for (std::string line; std::getline(in, line);) {
      if (std::regex_match(line, match, kExample)) lines += std::string(match[1]) + '\n';
    }
    return lines;
  };
  const testing::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "mocapd.toml";
  const std::string common = uncommented(text.substr(cameras, v4l2 - cameras));
  const std::string of_v4l2 = uncommented(text.substr(v4l2, aravis - v4l2));
  const std::string of_aravis = uncommented(text.substr(aravis));
  const std::string live = "calibration = \"c.toml\"\n[source]\ndriver = ";
  testing::WriteText(file, live + "\"v4l2\"\n" + common + of_v4l2);
  EXPECT_EQ(LoadConfig(file).cameras.size(), 1u);
  const std::string plain = "[[cameras]]\nname = \"cam1\"\n";
  testing::WriteText(file, live + "\"aravis\"\n" + plain + of_aravis);
  EXPECT_EQ(LoadConfig(file).cameras.size(), 1u);
}

}  // namespace
}  // namespace mocap
