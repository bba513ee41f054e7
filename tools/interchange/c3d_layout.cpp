#include "tools/interchange/c3d_layout.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/interchange/c3d_parameters.h"

namespace mocap {
namespace {

/// Limit of 16 bits; longer recordings have their length in TRIAL and LONG_FRAMES.
constexpr std::int64_t kLongest = 65'535;

int Shortened(std::int64_t frames) { return static_cast<int>(std::min(frames, kLongest)); }

void AddPoints(const C3dLayout& layout, int data_block, C3dParameters& parameters) {
  parameters.Group("POINT");
  parameters.Integer("USED", static_cast<int>(layout.labels.size()));
  parameters.Integer("FRAMES", Shortened(layout.frames));
  if (layout.frames > kLongest) {
    parameters.Real("LONG_FRAMES", static_cast<double>(layout.frames));
  }
  parameters.Integer("DATA_START", data_block);
  parameters.Real("SCALE", kC3dScale);
  parameters.Real("RATE", layout.rate_hz);
  parameters.Text("X_SCREEN", "+X");
  parameters.Text("Y_SCREEN", "+Z");
  parameters.Text("UNITS", "mm");
  parameters.Texts("LABELS", layout.labels);
  parameters.Texts("DESCRIPTIONS", std::vector<std::string>(layout.labels.size()));
  const std::string type_groups[] = {"ANGLES", "ANGLE_UNITS"};
  parameters.TextPairs("TYPE_GROUPS", type_groups);
  parameters.Texts("ANGLES", layout.angle_labels);
  parameters.Text("ANGLE_UNITS", "deg");
}

void AddTrial(const C3dLayout& layout, C3dParameters& parameters) {
  // 32 bits in two words, low word first.
  const int start[] = {1, 0};
  const int end[] = {static_cast<int>(layout.frames & 0xffff),
                     static_cast<int>(layout.frames >> 16)};
  parameters.Group("TRIAL");
  parameters.Integers("ACTUAL_START_FIELD", start, {2});
  parameters.Integers("ACTUAL_END_FIELD", end, {2});
  parameters.Real("CAMERA_RATE", layout.rate_hz);
}

void AddSubjects(const C3dLayout& layout, C3dParameters& parameters) {
  const bool has_prefixes = !layout.label_prefixes.empty();
  parameters.Group("SUBJECTS");
  parameters.Integer("USED", static_cast<int>(layout.subjects.size()));
  parameters.Integer("IS_STATIC", 0);
  parameters.Integer("USES_PREFIXES", has_prefixes);
  parameters.Texts("NAMES", layout.subjects);
  if (has_prefixes) parameters.Texts("LABEL_PREFIXES", layout.label_prefixes);
  parameters.Texts("MARKER_SETS", std::vector<std::string>(layout.subjects.size(), "mocapd"));
}

/// Of each analog channel per frame. There is no channel, but readers compare this with the rates.
constexpr std::uint16_t kAnalogSamples = 1;

/// Empty groups that programs expect.
void AddWhatIsMissing(const C3dLayout& layout, C3dParameters& parameters) {
  parameters.Group("ANALOG");
  parameters.Integer("USED", 0);
  parameters.Real("GEN_SCALE", 1);
  parameters.Real("RATE", kAnalogSamples * layout.rate_hz);
  parameters.Texts("LABELS", {});
  parameters.Texts("DESCRIPTIONS", {});
  parameters.Texts("UNITS", {});
  parameters.Reals("SCALE", {}, {0});
  parameters.Integers("OFFSET", {}, {0});
  const int zero[] = {1, 0};
  parameters.Group("FORCE_PLATFORM");
  parameters.Integer("USED", 0);
  parameters.Integers("ZERO", zero, {2});
  parameters.Integers("TYPE", {}, {0});
  parameters.Reals("CORNERS", {}, {3, 4, 0});
  parameters.Reals("ORIGIN", {}, {3, 0});
  parameters.Integers("CHANNEL", {}, {6, 0});
}

template <typename Get>
std::vector<std::string> TextsOf(std::span<const C3dEvent> events, Get get) {
  std::vector<std::string> texts;
  for (const C3dEvent& event : events) texts.push_back(get(event));
  return texts;
}

void AddEvents(std::span<const C3dEvent> events, C3dParameters& parameters) {
  const std::string contexts[] = {"General", "Left", "Right"};
  const std::string descriptions[] = {"For other events", "Left side", "Right side"};
  const int context_icons[] = {0, 1, 2};
  const int orange_red_green[] = {255, 164, 0, 255, 0, 0, 0, 255, 0};
  parameters.Group("EVENT_CONTEXT");
  parameters.Integer("USED", 3);
  parameters.Integers("ICON_IDS", context_icons, {3});
  parameters.Texts("LABELS", contexts);
  parameters.Texts("DESCRIPTIONS", descriptions);
  parameters.Integers("COLOURS", orange_red_green, {3, 3});
  std::vector<double> minutes_and_seconds;
  std::vector<int> icons;
  for (const C3dEvent& event : events) {
    const double minutes = std::floor(event.time_s / 60);
    minutes_and_seconds.insert(minutes_and_seconds.end(), {minutes, event.time_s - 60 * minutes});
    icons.push_back(event.icon);
  }
  parameters.Group("EVENT");
  parameters.Integer("USED", static_cast<int>(events.size()));
  parameters.Texts("CONTEXTS", TextsOf(events, [](const C3dEvent& e) { return e.context; }));
  parameters.Texts("LABELS", TextsOf(events, [](const C3dEvent& e) { return e.label; }));
  parameters.Texts("SUBJECTS", TextsOf(events, [](const C3dEvent& e) { return e.subject; }));
  parameters.Texts("DESCRIPTIONS", std::vector<std::string>(events.size()));
  parameters.Reals("TIMES", minutes_and_seconds, {2, events.size()});
  parameters.Integers("ICON_IDS", icons, {events.size()});
}

std::string Parameters(const C3dLayout& layout, int data_block) {
  C3dParameters parameters;
  AddTrial(layout, parameters);
  AddSubjects(layout, parameters);
  AddPoints(layout, data_block, parameters);
  AddWhatIsMissing(layout, parameters);
  AddEvents(layout.events, parameters);
  parameters.Group("MANUFACTURER");
  parameters.Text("COMPANY", "mocapd");
  parameters.Text("SOFTWARE", "mocapd");
  parameters.Text("VERSION_LABEL", MOCAP_VERSION);
  if (!layout.filter.empty()) parameters.Text("FILTER", layout.filter);
  return parameters.Section();
}

std::string HeaderBlock(const C3dLayout& layout, int data_block) {
  constexpr std::uint16_t kLabelsOfFourLetters = 12345;
  constexpr std::size_t kBeforeLabels = 2 * 149;
  ByteWriter header;
  header.Add(std::uint8_t{2});  // First block of the parameters.
  header.Add(std::uint8_t{0x50});
  header.Add(static_cast<std::uint16_t>(layout.labels.size()));
  header.Add(std::uint16_t{0});  // Analog values of all channels per frame.
  header.Add(std::uint16_t{1});
  header.Add(static_cast<std::uint16_t>(Shortened(layout.frames)));
  header.Add(std::uint16_t{0});  // No interpolated gaps.
  header.Add(static_cast<float>(kC3dScale));
  header.Add(static_cast<std::uint16_t>(data_block));
  header.Add(kAnalogSamples);
  header.Add(static_cast<float>(layout.rate_hz));
  header.PadTo(kBeforeLabels);
  header.Add(kLabelsOfFourLetters);
  header.PadTo(kC3dBlock);
  return header.Take();
}

}  // namespace

std::string C3dBeginning(const C3dLayout& layout) {
  const auto blocks = static_cast<int>(Parameters(layout, 0).size() / kC3dBlock);
  const int data_block = 2 + blocks;
  return HeaderBlock(layout, data_block) + Parameters(layout, data_block);
}

}  // namespace mocap
