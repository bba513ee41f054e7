#include "drivers/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "drivers/printable_text.h"

namespace mocap {
namespace {

// Longer names are not typed by hand.
constexpr std::size_t kLongestName = 64;
constexpr std::size_t kLettersPerError = 4;
// Fewer are the beginning of too many names.
constexpr std::size_t kShortestBeginning = 3;

char Small(char letter) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
}

/// Number of errors, then the number of letters that are missing at the end.
using Difference = std::pair<std::size_t, std::size_t>;

/// Compares a word with a name and with each beginning of it.
Difference DifferenceOf(std::string_view typed, std::string_view name) {
  const std::size_t width = name.size() + 1;
  std::vector<std::size_t> errors((typed.size() + 1) * width);
  const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& {
    return errors[i * width + j];
  };
  for (std::size_t i = 0; i <= typed.size(); ++i) at(i, 0) = i;
  for (std::size_t j = 0; j <= name.size(); ++j) at(0, j) = j;
  for (std::size_t i = 1; i <= typed.size(); ++i) {
    for (std::size_t j = 1; j <= name.size(); ++j) {
      const char a = Small(typed[i - 1]), b = Small(name[j - 1]);
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + (a != b)});
      const bool is_exchanged =
          i > 1 && j > 1 && a == Small(name[j - 2]) && Small(typed[i - 2]) == b;
      if (is_exchanged) at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  }
  Difference least{at(typed.size(), name.size()), 0};
  if (typed.size() < kShortestBeginning) return least;
  for (std::size_t j = typed.size() - 1; j < name.size(); ++j)
    least = std::min(least, Difference{at(typed.size(), j), name.size() - j});
  return least;
}

/// cam1 and cam2 are two things, not one of them misspelt.
bool DifferOnlyInNumber(std::string_view a, std::string_view b) {
  const auto are_alike = [](char x, char y) {
    const bool are_digits = std::isdigit(static_cast<unsigned char>(x)) != 0 &&
                            std::isdigit(static_cast<unsigned char>(y)) != 0;
    return x == y || are_digits;
  };
  return a != b && std::ranges::equal(a, b, are_alike);
}

}  // namespace

std::string NearestName(std::string_view typed, const std::vector<std::string>& names) {
  if (typed.empty() || typed.size() > kLongestName) return {};
  const std::size_t most = std::max<std::size_t>(1, typed.size() / kLettersPerError);
  const std::string* nearest = nullptr;
  Difference least{most, kLongestName};
  for (const std::string& name : names) {
    if (name.empty() || name.size() > kLongestName || DifferOnlyInNumber(typed, name)) continue;
    const Difference difference = DifferenceOf(typed, name);
    // A name of which every letter would have to be replaced resembles nothing.
    if (difference.first >= typed.size() || !(difference < least)) continue;
    least = difference;
    nearest = &name;
  }
  return nearest ? *nearest : std::string();
}

std::string WithNearestName(std::string_view typed, const std::vector<std::string>& names,
                            std::string wanted) {
  const std::string nearest = NearestName(typed, names);
  if (nearest.empty()) return wanted;
  if (!wanted.empty())
    wanted[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(wanted[0])));
  return "did you mean " + Printable(nearest) + (wanted.empty() ? "?" : "? " + wanted);
}

std::string ListedNames(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

std::string ExpectedNames(std::string_view typed, const std::vector<std::string>& names) {
  if (names.empty()) return "there is none";
  if (names.size() == 1 && NearestName(typed, names) == names.front())
    return WithNearestName(typed, names, "");
  return WithNearestName(
      typed, names, (names.size() == 1 ? "expected " : "expected one of ") + ListedNames(names));
}

}  // namespace mocap
