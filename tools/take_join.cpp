#include "tools/take_join.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "config/load_config.h"
#include "config/open_studio.h"
#include "config/parse_toml.h"
#include "core/errors.h"
#include "drivers/take/calibration_file.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/take_table.h"
#include "drivers/take/take_writer.h"
#include "drivers/take/text_file.h"
#include "drivers/take/toml_text.h"
#include "tools/stop_on_signals.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

struct TimeSpan {
  std::int64_t first_ns, last_ns;

  std::int64_t Length() const { return last_ns - first_ns; }
};

/// One of the takes to join.
struct Part {
  TakeLayout layout;
  double fps_nominal = 0;
  std::vector<CameraCalibration> cameras;  ///< Cameras with frames.
  std::vector<CameraCalibration> known;    ///< All cameras of its calibration.
  toml::table description;
  TimeSpan span{};

  std::string name() const { return layout.folder.string(); }
};

TimeSpan SpanOf(const Part& part) {
  std::optional<TimeSpan> span;
  for (const CameraCalibration& camera : part.cameras) {
    const std::vector<TakeRow> rows = ReadTakeTable(part.layout.Table(camera.name)).rows;
    const TimeSpan own{rows.front().timestamp_ns, rows.back().timestamp_ns};
    if (!span) span = own;
    span = {std::min(span->first_ns, own.first_ns), std::max(span->last_ns, own.last_ns)};
  }
  return *span;
}

Part OpenPart(const fs::path& take) {
  // Reports anything that would keep the take from being tracked.
  const Studio studio = OpenTake(take, {});
  Part part;
  part.layout.folder = PlainFolder(take);
  part.fps_nominal = studio.fps_nominal;
  for (const StudioCamera& camera : studio.cameras) part.cameras.push_back(camera.calibration);
  part.known = LoadCalibration(part.layout.Calibration());
  part.description = ParseTomlFile(part.layout.Description());
  part.span = SpanOf(part);
  return part;
}

void RequireOneRate(const std::vector<Part>& parts) {
  for (const Part& part : parts) {
    if (part.fps_nominal == parts[0].fps_nominal) continue;
    std::ostringstream text;
    text << part.name() << ": has " << part.fps_nominal << " frames a second, and "
         << parts[0].name() << " has " << parts[0].fps_nominal << "; expected takes of one rate";
    throw SetupError(text.str());
  }
}

void RequireDifferentCameras(const std::vector<Part>& parts) {
  std::map<std::string, const Part*> seen;
  for (const Part& part : parts) {
    for (const CameraCalibration& camera : part.cameras) {
      const auto [other, is_new] = seen.emplace(camera.name, &part);
      if (is_new) continue;
      throw SetupError(part.name() + ": its camera " + camera.name + " is in " +
                       other->second->name() + " too; expected takes of different cameras");
    }
  }
}

/// Checks that calibrations of the same camera agree, so the world frame is the same.
void RequireOneCalibration(const std::vector<Part>& parts) {
  std::map<std::string, std::pair<std::string, const Part*>> seen;
  for (const Part& part : parts) {
    const fs::path file = part.layout.Calibration();
    for (const CameraCalibration& camera : part.known) {
      const std::string text = CalibrationText(file, std::span(&camera, 1));
      const auto [other, is_new] = seen.emplace(camera.name, std::pair(text, &part));
      if (is_new || other->second.first == text) continue;
      throw SetupError(file.string() + ": cameras." + camera.name + " differs from that in " +
                       other->second.second->layout.Calibration().string() +
                       "; expected takes of one calibration");
    }
  }
}

/// @return  the time span that all takes cover.
TimeSpan RequireOverlap(const std::vector<Part>& parts) {
  const Part& last_to_begin =
      *std::ranges::max_element(parts, {}, [](const Part& part) { return part.span.first_ns; });
  const Part& first_to_end =
      *std::ranges::min_element(parts, {}, [](const Part& part) { return part.span.last_ns; });
  const TimeSpan common{last_to_begin.span.first_ns, first_to_end.span.last_ns};
  if (common.Length() > 0) return common;
  std::ostringstream text;
  text << first_to_end.name() << ": ends " << -static_cast<double>(common.Length()) / 1e9
       << " s before " << last_to_begin.name()
       << " begins; expected takes of the same time, with synchronized clocks";
  throw SetupError(text.str());
}

TimeSpan WholeSpanOf(const std::vector<Part>& parts) {
  TimeSpan whole = parts[0].span;
  for (const Part& part : parts) {
    whole = {std::min(whole.first_ns, part.span.first_ns),
             std::max(whole.last_ns, part.span.last_ns)};
  }
  return whole;
}

/// Truth and sizes of people, which belong to the studio, not to a camera.
std::vector<fs::path> FilesOfPeople(const Part& part) {
  const fs::path& folder = part.layout.folder;
  std::vector<fs::path> files;
  for (const fs::path& file :
       {part.layout.TruthTable(), part.layout.TruthSizes(), part.layout.Subject()}) {
    if (IsThere(file)) files.push_back(file.lexically_relative(folder));
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.is_directory() || !entry.path().filename().native().starts_with("person-")) continue;
    for (const auto& file : fs::directory_iterator(entry.path())) {
      if (file.is_regular_file()) files.push_back(file.path().lexically_relative(folder));
    }
  }
  return files;
}

bool HoldTheSame(const fs::path& a, const fs::path& b) {
  std::ifstream in_a(a, std::ios::binary), in_b(b, std::ios::binary);
  using Bytes = std::istreambuf_iterator<char>;
  return std::equal(Bytes(in_a), Bytes(), Bytes(in_b), Bytes());
}

/// Source of each file of the new take.
using Sources = std::map<fs::path, fs::path>;

void AddFilesOfPeople(const Part& part, Sources& sources) {
  for (const fs::path& file : FilesOfPeople(part)) {
    const fs::path from = part.layout.folder / file;
    const auto [other, is_new] = sources.emplace(file, from);
    if (is_new || HoldTheSame(from, other->second)) continue;
    throw SetupError(from.string() + ": differs from " + other->second.string() +
                     "; expected takes of the same people");
  }
}

Sources SourcesOf(const std::vector<Part>& parts) {
  Sources sources;
  for (const Part& part : parts) {
    for (const CameraCalibration& camera : part.cameras) {
      const TakeLayout& from = part.layout;
      for (const fs::path& file :
           {from.Video(camera.name), from.Table(camera.name), from.BackgroundVideo(camera.name),
            from.BackgroundTable(camera.name), from.BackgroundUnseen(camera.name),
            from.Mask(camera.name)}) {
        if (IsThere(file)) sources.emplace(file.lexically_relative(from.folder), file);
      }
    }
    AddFilesOfPeople(part, sources);
  }
  return sources;
}

std::vector<CameraCalibration> CamerasOf(const std::vector<Part>& parts) {
  std::vector<CameraCalibration> cameras;
  for (const Part& part : parts)
    cameras.insert(cameras.end(), part.cameras.begin(), part.cameras.end());
  return cameras;
}

/// The keys of take.toml on which the takes agree.
toml::table Agreed(const std::vector<Part>& parts) {
  toml::table agreed;
  std::set<std::string, std::less<>> passed_over = {"name", "fps_nominal", "cameras"};
  for (const Part& part : parts) {
    for (const auto& [key, value] : part.description) {
      const toml::node* other = agreed.get(key);
      if (other && toml::node_view(*other) != toml::node_view(value))
        passed_over.emplace(key.str());
      if (!other) agreed.insert(key, value);
    }
  }
  for (const std::string& key : passed_over) agreed.erase(key);
  return agreed;
}

std::string DescriptionOf(const std::vector<Part>& parts, const std::string& name) {
  std::string cameras, joined;
  for (const Part& part : parts) {
    joined += (joined.empty() ? "" : ", ") + TomlText(part.layout.folder.filename().string());
    for (const CameraCalibration& camera : part.cameras)
      cameras += (cameras.empty() ? "" : ", ") + TomlText(camera.name);
  }
  std::ostringstream text;
  text << "name = " << TomlText(name) << "\nfps_nominal = " << TomlNumber(parts[0].fps_nominal)
       << "\ncameras = [" << cameras << "]\njoined = [" << joined << "]\n"
       << Agreed(parts) << '\n';
  return text.str();
}

void LinkOrCopy(const fs::path& from, const fs::path& to) {
  fs::create_directories(to.parent_path());
  std::error_code error;
  // Tables may be edited by hand, which must not change the original take.
  if (from.extension() == ".mkv") fs::create_hard_link(from, to, error);
  if (from.extension() != ".mkv" || error) fs::copy_file(from, to);
}

void Write(const std::vector<Part>& parts, const Sources& sources, const fs::path& out,
           const fs::path& partial) {
  const TakeLayout layout{partial};
  fs::create_directories(partial);
  WriteText(layout.Description(), DescriptionOf(parts, out.filename().string()));
  WriteCalibration(layout.Calibration(), CamerasOf(parts));
  for (const auto& [file, from] : sources) {
    EndIfStopAsked();
    LinkOrCopy(from, partial / file);
  }
  fs::rename(partial, out);
}

}  // namespace

JoinedTake JoinTakes(std::span<const fs::path> takes, const fs::path& out) {
  const fs::path folder = PlainFolder(out), partial = folder.string() + ".partial";
  RequireNewTake(folder, partial);
  std::vector<Part> parts;
  for (const fs::path& take : takes) parts.push_back(OpenPart(take));
  RequireOneRate(parts);
  RequireDifferentCameras(parts);
  RequireOneCalibration(parts);
  const TimeSpan common = RequireOverlap(parts);
  const Sources sources = SourcesOf(parts);
  try {
    Write(parts, sources, folder, partial);
  } catch (...) {
    std::error_code error;
    fs::remove_all(partial, error);
    throw;
  }
  return {CamerasOf(parts).size(), common.Length(), WholeSpanOf(parts).Length()};
}

}  // namespace mocap
