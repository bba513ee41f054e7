#include "config/subject_file.h"

#include <string>

#include "config/body_size_fields.h"
#include "config/toml_section.h"
#include "drivers/take/text_file.h"
#include "drivers/take/toml_text.h"

namespace mocap {
namespace {

// For all parts of all people.
constexpr double kSmallest_mm = 10;
constexpr double kLargest_mm = 1500;

}  // namespace

BodySizes LoadSubject(const std::filesystem::path& file) {
  TomlSection root = TomlSection::ReadFile(file);
  TomlSection section = root.NeededSection("sizes", "a table of the person's sizes");
  BodySizes sizes;
  for (const BodySizeField& field : kBodySizeFields) {
    sizes.*field.value =
        section.NumberWithin(std::string(field.name) + "_mm", kSmallest_mm, kLargest_mm);
  }
  section.RejectUnknownKeys();
  return sizes;
}

void SaveSubject(const std::filesystem::path& file, const BodySizes& sizes,
                 const std::string& name) {
  std::string text = name.empty() ? "" : "name = " + TomlText(name) + '\n';
  text += "stature_mm = " + TomlNumber(sizes.Stature()) + "\n\n[sizes]\n";
  for (const BodySizeField& field : kBodySizeFields) {
    text += std::string(field.name) + "_mm = " + TomlNumber(sizes.*field.value) + '\n';
  }
  ReplaceText(file, text);
}

}  // namespace mocap
