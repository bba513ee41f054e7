#include "config/parse_toml.h"

#include <algorithm>

#include "core/errors.h"
#include "drivers/printable_text.h"
#include "drivers/take/input_file.h"

namespace mocap {
namespace {

constexpr std::size_t kMostBytes = 4 << 20;
constexpr int kMostParts = 16;     ///< In a key.
constexpr int kMostBrackets = 16;  ///< Nested.
constexpr std::size_t kLongestReason = 160;

/// Scans TOML and measures the nesting of its tables, never deeper than the parser would.
class DepthGuard {
 public:
  DepthGuard(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  void Check() {
    while (!rest_.empty()) {
      const char c = rest_.front();
      if (c == '"' || c == '\'') {
        SkipString(c);
      } else if (c == '#') {
        rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
      } else {
        Count(c);
        rest_.remove_prefix(1);
      }
    }
  }

 private:
  void Count(char c) {
    if (c == '\n') ++line_;
    if (c == '.') {
      if (++dots_ >= kMostParts) Fail("has a key of more than", kMostParts, "parts");
    } else if (c != ' ' && std::string_view("=,{}[]\n").find(c) != std::string_view::npos) {
      dots_ = 0;
    }
    if (c == '[' || c == '{') {
      if (++brackets_ > kMostBrackets) Fail("has more than", kMostBrackets, "brackets open");
    } else if (c == ']' || c == '}') {
      brackets_ = std::max(0, brackets_ - 1);
    }
  }

  // Skips a string. An unterminated one is left for the parser to reject.
  void SkipString(char quote) {
    const std::string three(3, quote);
    const bool has_lines = rest_.starts_with(three);
    rest_.remove_prefix(has_lines ? 3 : 1);
    while (!rest_.empty()) {
      if (has_lines ? rest_.starts_with(three) : rest_.front() == quote) break;
      if (rest_.front() == '\n' && !has_lines) return;
      if (rest_.front() == '\n') ++line_;
      const bool is_escape = quote == '"' && rest_.front() == '\\' && rest_.size() > 1;
      if (is_escape && rest_[1] == '\n') ++line_;
      rest_.remove_prefix(is_escape ? 2 : 1);
    }
    // Up to two quotes before the closing three may belong to the text.
    for (int i = 0; i < (has_lines ? 5 : 1) && rest_.starts_with(quote); ++i) {
      rest_.remove_prefix(1);
    }
  }

  [[noreturn]] void Fail(const char* what, int most, const char* of_what) const {
    throw SetupError(name_ + ":" + std::to_string(line_) + ": " + what + " " +
                     std::to_string(most) + " " + of_what + "; expected flat tables");
  }

  std::string_view rest_;
  const std::string& name_;
  int line_ = 1, dots_ = 0, brackets_ = 0;
};

/// Converts line endings to those that the parser accepts.
std::string WithLineFeeds(std::string_view text) {
  std::string plain;
  plain.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r') {
      plain += text[i];
    } else if (i + 1 == text.size() || text[i + 1] != '\n') {
      plain += '\n';
    }
  }
  return plain;
}

int LinesBefore(std::string_view text, std::size_t place) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + place, '\n'));
}

void RequireText(std::string_view text, const std::string& name) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
    throw SetupError(name + ":1: is UTF-16; expected TOML in UTF-8");
  }
  const std::size_t zero = text.find('\0');
  if (zero == std::string_view::npos) return;
  throw SetupError(name + ":" + std::to_string(LinesBefore(text, zero)) +
                   ": contains a zero byte; expected TOML, which is text");
}

}  // namespace

toml::table ParseToml(std::string_view text, const std::string& name) {
  RequireText(text, name);
  const std::string plain = WithLineFeeds(text);
  DepthGuard(plain, name).Check();
  try {
    return toml::parse(plain, name);
  } catch (const toml::parse_error& error) {
    throw SetupError(name + ":" + std::to_string(error.source().begin.line) +
                     ": is not TOML: " + Shortened(error.description(), kLongestReason));
  }
}

toml::table ParseTomlFile(const std::filesystem::path& file) {
  return ParseToml(ReadTomlText(file), file.string());
}

std::string ReadTomlText(const std::filesystem::path& file) {
  return ReadWholeFile(file, "a TOML file", kMostBytes);
}

}  // namespace mocap
