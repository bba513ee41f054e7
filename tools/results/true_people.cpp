#include "tools/results/true_people.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "config/toml_section.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"
#include "tools/results/result.h"

namespace mocap {
namespace {

/// First and last frames of ranges, alternating.
using Stretches = std::vector<double>;

/// By the people's folders.
std::map<std::string, Stretches> ReadCovered(const std::filesystem::path& take) {
  std::map<std::string, Stretches> covered;
  const std::filesystem::path file = TakeLayout{take}.Description();
  if (!IsThere(file)) return covered;
  TomlSection description = TomlSection::ReadFile(file);
  for (TomlSection& person : description.Sections("person")) {
    if (!person.Has("covered")) continue;
    Stretches stretches = person.AllNumbers("covered");
    if (stretches.size() % 2 != 0) {
      person.Fail("covered", "has a first frame without a last one; expected pairs of both");
    }
    covered[person.Text("folder")] = std::move(stretches);
  }
  return covered;
}

bool IsWithin(const Stretches& stretches, std::int64_t frame) {
  const auto number = static_cast<double>(frame);
  for (std::size_t i = 0; i + 1 < stretches.size(); i += 2) {
    if (number >= stretches[i] && number <= stretches[i + 1]) return true;
  }
  return false;
}

TruePerson PersonOf(std::string name, TakeTruth truth, const Stretches* covered) {
  TruePerson person{std::move(name), std::move(truth), {}};
  for (const std::int64_t number : person.truth.numbers) {
    person.covered.push_back(!covered || IsWithin(*covered, number));
  }
  return person;
}

}  // namespace

std::vector<TruePerson> ReadTruePeople(const std::filesystem::path& take) {
  std::vector<TruePerson> people;
  const std::map<std::string, Stretches> covered = ReadCovered(take);
  for (const std::filesystem::path& folder : PersonFolders(take)) {
    std::optional<TakeTruth> truth = ReadTruthAmongOthers(folder);
    if (!truth) continue;
    const std::string name = folder.filename().string();
    const auto found = covered.find(name);
    people.push_back(
        PersonOf(name, std::move(*truth), found == covered.end() ? nullptr : &found->second));
  }
  if (!people.empty()) return people;
  if (std::optional<TakeTruth> truth = ReadTakeTruth(take)) {
    people.push_back(PersonOf("truth", std::move(*truth), nullptr));
  }
  return people;
}

}  // namespace mocap
