// Matches frames of a recording in time.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string_view>

#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "drivers/quoted.h"
#include "drivers/take/text_table.h"
#include "tools/calibration/footage.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

constexpr double kLatest_s = 4e9;

// Splits a line, with or without blanks or quotation marks around the fields.
std::vector<std::string> Fields(std::string_view line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',')
      fields.emplace_back();
    else if (c != ' ' && c != '\t' && c != '"')
      fields.back() += c;
  }
  return fields;
}

/// Caliscope's table, row by row.
class SharedTimes {
 public:
  explicit SharedTimes(const fs::path& file) : lines_(file, "a table of cam_id,frame_time") {
    std::string_view line;
    lines_.Next(line);
    const std::vector<std::string> names = Fields(line);
    const auto column = [&](const char* name) {
      const auto place = std::find(names.begin(), names.end(), name);
      return place == names.end() ? -1 : static_cast<int>(place - names.begin());
    };
    columns_ = static_cast<int>(names.size());
    camera_ = std::max(column("cam_id"), column("port"));
    frame_ = column("frame_index");
    time_ = column("frame_time");
    if (camera_ < 0 || time_ < 0) Fail("expected the header \"cam_id,frame_time\"");
  }

  /// Reads the next row. @return  false at the end.
  bool Next(int& camera, int& frame, std::int64_t& time_ns) {
    std::string_view line;
    do {
      if (!lines_.Next(line)) return false;
    } while (line.find_first_not_of(" \t") == std::string_view::npos);
    const std::vector<std::string> fields = Fields(line);
    if (static_cast<int>(fields.size()) != columns_)
      Fail("has another number of fields (" + std::to_string(fields.size()) +
           ") than the header (" + std::to_string(columns_) + ")");
    camera = Parse<int>(fields, camera_, "cam_id");
    frame = frame_ < 0 ? counts_[camera] : Parse<int>(fields, frame_, "frame_index");
    const double time_s = Parse<double>(fields, time_, "frame_time");
    if (!(std::abs(time_s) < kLatest_s))
      Fail("frame_time is " + Quoted(fields[time_]) + "; expected seconds");
    time_ns = std::llround(time_s * 1e9);
    ++counts_[camera];
    return true;
  }

  [[noreturn]] void Fail(const std::string& what) const { lines_.Fail(what); }

 private:
  template <typename Number>
  Number Parse(const std::vector<std::string>& fields, int column, const char* name) const {
    const std::string& field = fields[static_cast<std::size_t>(column)];
    Number number{};
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), number);
    if (error != std::errc() || end != field.data() + field.size())
      Fail(std::string(name) + " is " + Quoted(field) + "; expected a number");
    return number;
  }

  TextLines lines_;
  int columns_ = 0;
  int camera_ = -1, frame_ = -1, time_ = -1;
  std::map<int, int> counts_;
};

std::string WithoutZeros(const std::string& digits) {
  const std::size_t first = digits.find_first_not_of('0');
  return first == std::string::npos ? "0" : digits.substr(first);
}

std::vector<std::string> NumbersIn(const std::string& text) {
  std::vector<std::string> numbers;
  bool inside = false;
  for (const char c : text) {
    const bool is_digit = c >= '0' && c <= '9';
    if (is_digit && !inside) numbers.emplace_back();
    if (is_digit) numbers.back() += c;
    inside = is_digit;
  }
  for (std::string& number : numbers) number = WithoutZeros(number);
  return numbers;
}

bool IsNumber(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool HasKeyLess(const FootageFrame& frame, const std::string& key) {
  return IsKeyLess(frame.key, key);
}

const FootageFrame* FindKey(const FootageCamera& camera, const std::string& key) {
  const auto place = std::lower_bound(camera.frames.begin(), camera.frames.end(), key, HasKeyLess);
  return place != camera.frames.end() && place->key == key ? &*place : nullptr;
}

// "cam2 lacks img03.png": by another camera's name of it.
void TellMissing(Footage& footage, const std::set<std::string, decltype(&IsKeyLess)>& keys) {
  constexpr int kMostNamed = 5;
  for (const FootageCamera& camera : footage.cameras) {
    std::vector<std::string> named;
    int missing = 0;
    for (const std::string& key : keys) {
      if (FindKey(camera, key) != nullptr || ++missing > kMostNamed) continue;
      for (const FootageCamera& other : footage.cameras) {
        if (const FootageFrame* frame = FindKey(other, key)) {
          named.push_back(Printable(frame->name) + " of " + other.name);
          break;
        }
      }
    }
    if (missing == 0) continue;
    footage.notes.push_back(camera.name + ": lacks " + Counted(missing, "picture") +
                            " that others have (" + ListedNames(named) +
                            (missing > kMostNamed ? ", ..." : "") +
                            "); the rest is paired by the numbers in their names");
  }
}

// Half of it is the largest distance between frames of one moment.
std::int64_t IntervalOf(const Footage& footage, bool timed, const auto& time_of) {
  std::int64_t interval_ns = std::numeric_limits<std::int64_t>::max();
  for (const FootageCamera& camera : footage.cameras) {
    std::vector<std::int64_t> steps_ns;
    for (std::size_t i = 1; i < camera.frames.size(); ++i)
      steps_ns.push_back(time_of(camera, i) - time_of(camera, i - 1));
    if (steps_ns.empty()) continue;
    // A telephone's frames are irregular; sometimes two come at once.
    const auto middle =
        steps_ns.begin() + (timed ? 0 : static_cast<std::ptrdiff_t>(steps_ns.size() / 2));
    std::nth_element(steps_ns.begin(), middle, steps_ns.end());
    interval_ns = std::min(interval_ns, *middle);
  }
  return interval_ns == std::numeric_limits<std::int64_t>::max() ? kUntimedInterval_ns
                                                                 : interval_ns;
}

}  // namespace

bool IsKeyLess(const std::string& a, const std::string& b) {
  if (IsNumber(a) && IsNumber(b) && a.size() != b.size()) return a.size() < b.size();
  return a < b;
}

std::vector<std::string> PictureKeys(const std::vector<fs::path>& files) {
  std::vector<std::vector<std::string>> numbers;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (const fs::path& file : files) {
    numbers.push_back(NumbersIn(file.stem().string()));
    fewest = std::min(fewest, numbers.back().size());
  }
  // Most names have the count at the end; "3_cam1" has it first.
  for (std::size_t from_end = 1; !files.empty() && from_end <= fewest; ++from_end) {
    std::vector<std::string> keys;
    for (const auto& of_file : numbers) keys.push_back(of_file[of_file.size() - from_end]);
    if (std::set<std::string>(keys.begin(), keys.end()).size() == keys.size()) return keys;
  }
  std::vector<std::string> keys;
  for (const fs::path& file : files) keys.push_back(file.filename().string());
  return keys;
}

void PairPictures(Footage& footage) {
  if (footage.cameras.size() < 2) return;
  std::set<std::string, decltype(&IsKeyLess)> keys(&IsKeyLess);
  std::map<std::string, int> cameras_with;
  std::size_t pictures = 0;
  for (const FootageCamera& camera : footage.cameras) {
    pictures += camera.frames.size();
    for (const FootageFrame& frame : camera.frames) {
      if (frame.key.empty()) return;
      keys.insert(frame.key);
      ++cameras_with[frame.key];
    }
  }
  std::size_t shared = 0;
  for (const auto& [key, count] : cameras_with) shared += count > 1 ? count : 0;
  const bool equal =
      std::all_of(footage.cameras.begin(), footage.cameras.end(), [&](const FootageCamera& camera) {
        return camera.frames.size() == footage.cameras.front().frames.size();
      });
  if (2 * shared < pictures) {
    // Each camera counts independently.
    footage.notes.push_back(
        equal ? "the cameras' pictures have no numbers in common; paired in their order"
              : "the cameras' pictures have no numbers in common, and differ in count; they cannot "
                "be paired");
    if (equal) return;
  }
  std::map<std::string, std::int64_t> place;
  for (const std::string& key : keys) place.emplace(key, static_cast<std::int64_t>(place.size()));
  for (FootageCamera& camera : footage.cameras) {
    camera.placed = true;
    for (FootageFrame& frame : camera.frames)
      frame.time_ns = place[frame.key] * kUntimedInterval_ns;
  }
  if (2 * shared >= pictures) TellMissing(footage, keys);
}

void ReadSharedTimes(const fs::path& file, Footage& footage) {
  SharedTimes table(file);
  std::map<int, std::map<int, std::int64_t>> times_ns;
  int id = 0, frame = 0;
  for (std::int64_t time_ns = 0; table.Next(id, frame, time_ns);) {
    std::map<int, std::int64_t>& of_camera = times_ns[id];
    if (!of_camera.emplace(frame, time_ns).second)
      table.Fail("has frame " + std::to_string(frame) + " of camera " + std::to_string(id) +
                 " twice");
    const auto place = of_camera.find(frame), next = std::next(place);
    if ((place != of_camera.begin() && std::prev(place)->second >= time_ns) ||
        (next != of_camera.end() && next->second <= time_ns))
      table.Fail("frame_time does not increase from frame to frame of camera " +
                 std::to_string(id));
  }
  for (FootageCamera& camera : footage.cameras) {
    std::map<int, std::int64_t> of_camera;
    for (const auto& [number, times] : times_ns) {
      const std::string text = std::to_string(number);
      if (camera.name == "cam_" + text || camera.name == "port_" + text || camera.name == text)
        of_camera = times;
    }
    if (of_camera.size() != camera.frames.size())
      throw SetupError(file.string() + ": has times of " + std::to_string(of_camera.size()) +
                       " frames of " + camera.name + "; its video has " +
                       std::to_string(camera.frames.size()));
    camera.timed = true;
    auto time = of_camera.begin();
    for (FootageFrame& f : camera.frames) f.time_ns = (time++)->second;
  }
}

std::vector<FootageMoment> MatchMoments(const Footage& footage) {
  const auto all = [&](bool FootageCamera::*has) {
    return std::all_of(footage.cameras.begin(), footage.cameras.end(),
                       [has](const FootageCamera& camera) { return camera.*has; });
  };
  const bool timed = all(&FootageCamera::timed);
  const bool placed = timed || all(&FootageCamera::placed);
  const auto time_of = [&](const FootageCamera& camera, std::size_t i) {
    return placed ? camera.frames[i].time_ns : static_cast<std::int64_t>(i) * kUntimedInterval_ns;
  };
  const std::int64_t interval_ns = IntervalOf(footage, timed, time_of);
  // All cameras' frames in order of time; a new moment begins if the last one is too old or taken.
  struct Entry {
    std::int64_t time_ns;
    int camera, frame;
  };
  std::vector<Entry> entries;
  for (std::size_t c = 0; c < footage.cameras.size(); ++c) {
    for (std::size_t i = 0; i < footage.cameras[c].frames.size(); ++i)
      entries.push_back({time_of(footage.cameras[c], i), static_cast<int>(c), static_cast<int>(i)});
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.time_ns != b.time_ns ? a.time_ns < b.time_ns : a.camera < b.camera;
  });
  std::vector<FootageMoment> moments;
  for (const Entry& entry : entries) {
    const bool fits = !moments.empty() &&
                      entry.time_ns - moments.back().time_ns <= interval_ns / 2 &&
                      moments.back().frames[entry.camera] < 0;
    if (!fits) moments.push_back({entry.time_ns, std::vector<int>(footage.cameras.size(), -1)});
    moments.back().frames[entry.camera] = entry.frame;
  }
  return moments;
}

}  // namespace mocap
