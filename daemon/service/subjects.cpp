#include "daemon/service/subjects.h"

#include <algorithm>
#include <stdexcept>

#include "config/subject_file.h"
#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"

namespace mocap {

std::filesystem::path Subjects::FileOf(const std::string& name) const {
  return folder_ / (name + ".toml");
}

void Subjects::Save(const std::string& name, const BodySizes& sizes) const {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw std::runtime_error(folder_.string() + ": cannot be created: " + error.message());
  SaveSubject(FileOf(name), sizes);
}

BodySizes Subjects::Load(const std::string& name) const {
  if (!IsThere(FileOf(name))) {
    throw SetupError("there is no subject " + name + "; " + ExpectedNames(name, Names()));
  }
  return LoadSubject(FileOf(name));
}

std::vector<KnownPerson> Subjects::Known() const {
  std::vector<KnownPerson> known;
  for (const std::string& name : Names()) {
    try {
      known.push_back({name, Load(name)});
    } catch (const SetupError&) {
      // `mocap subject list` reports it.
    }
  }
  return known;
}

std::vector<std::string> Subjects::Names() const {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, error)) {
    if (entry.path().extension() == ".toml" && !IsHidden(entry.path()))
      names.push_back(entry.path().stem());
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace mocap
