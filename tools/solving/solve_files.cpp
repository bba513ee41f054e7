#include "tools/solving/solve_files.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "config/body_size_fields.h"
#include "core/errors.h"
#include "drivers/take/text_file.h"
#include "tools/solving/bytes.h"

namespace mocap {
namespace {

std::vector<char> BytesOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void Write(const std::filesystem::path& file, const std::vector<char>& bytes,
           std::ios::openmode mode) {
  std::ofstream out(file, std::ios::binary | mode);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

std::vector<SizeMember> AllSizes() {
  std::vector<SizeMember> sizes(kDrapeSizes.begin(), kDrapeSizes.end());
  for (const BodySizeField& field : kBodySizeFields) sizes.push_back(field.value);
  return sizes;
}

void AddPose(const PoseState& pose, BytesOut& out) {
  out.AddAll(pose.X_WT.R.data(), 9);
  out.AddAll(pose.X_WT.p.data(), 3);
  out.Add(static_cast<std::uint32_t>(pose.theta.size()));
  out.AddAll(pose.theta.data(), static_cast<std::size_t>(pose.theta.size()));
}

PoseState TakePose(BytesIn& in) {
  PoseState pose;
  in.TakeAll(pose.X_WT.R.data(), 9);
  in.TakeAll(pose.X_WT.p.data(), 3);
  const auto joints = in.Take<std::uint32_t>();
  if (joints > kMaxJoints) throw std::runtime_error("is damaged");
  pose.theta.resize(joints);
  in.TakeAll(pose.theta.data(), joints);
  return pose;
}

void AddPoses(const std::vector<std::optional<PoseState>>& poses, BytesOut& out) {
  out.Add(static_cast<std::uint64_t>(poses.size()));
  for (const std::optional<PoseState>& pose : poses) {
    out.Add(pose.has_value());
    if (pose) AddPose(*pose, out);
  }
}

std::vector<std::optional<PoseState>> TakePoses(BytesIn& in) {
  std::vector<std::optional<PoseState>> poses;
  for (auto left = in.Take<std::uint64_t>(); left > 0; --left)
    poses.push_back(in.Take<bool>() ? std::optional(TakePose(in)) : std::nullopt);
  return poses;
}

std::vector<PathStep> TakeSteps(BytesIn& in) {
  std::vector<PathStep> steps;
  for (auto left = in.Take<std::uint64_t>(); left > 0; --left) {
    PathStep& step = steps.emplace_back();
    if (in.Take<bool>()) step.pose = TakePose(in);
    step.things = Things(in.Take<std::uint64_t>());
    step.jumps = in.Take<bool>();
    step.probability = in.Take<double>();
  }
  return steps;
}

}  // namespace

SolveFiles::SolveFiles(const std::filesystem::path& folder, const std::string& mark)
    : folder_(folder) {
  const std::filesystem::path file = folder / "mark";
  const std::vector<char> before = BytesOf(file);
  if (std::string(before.begin(), before.end()) == mark) return;
  // Nobody's files are removed but those of another solve.
  if (before.empty() && std::filesystem::exists(folder) && !std::filesystem::is_empty(folder))
    throw SetupError(folder.string() + ": is not an unfinished solve; expected nothing there");
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  ReplaceText(file, mark);
}

std::filesystem::path SolveFiles::PathFile(int number) const {
  return folder_ / ("path-" + std::to_string(number));
}

std::optional<FirstPass> SolveFiles::LoadFirstPass(const BodyTable& table) const {
  const std::vector<char> bytes = BytesOf(folder_ / "tracks");
  if (bytes.empty()) return std::nullopt;
  BytesIn in(bytes);
  FirstPass pass;
  for (auto left = in.Take<std::uint64_t>(); left > 0; --left) {
    pass.index.offset.push_back(in.Take<std::int64_t>());
    pass.index.capture_ns.push_back(in.Take<std::int64_t>());
  }
  for (auto left = in.Take<std::uint64_t>(); left > 0; --left) {
    const int number = in.Take<int>();
    BodySizes sizes;
    for (const SizeMember size : AllSizes()) sizes.*size = in.Take<double>();
    const int first = in.Take<int>();
    pass.tracks.emplace(number, PersonTrack{BodyModel(table, sizes), first, TakePoses(in)});
  }
  return pass;
}

void SolveFiles::Save(const FirstPass& pass) const {
  std::vector<char> bytes;
  BytesOut out(bytes);
  out.Add(static_cast<std::uint64_t>(pass.index.offset.size()));
  for (std::size_t i = 0; i < pass.index.offset.size(); ++i) {
    out.Add(pass.index.offset[i]);
    out.Add(pass.index.capture_ns[i]);
  }
  out.Add(static_cast<std::uint64_t>(pass.tracks.size()));
  for (const auto& [number, track] : pass.tracks) {
    out.Add(number);
    for (const SizeMember size : AllSizes()) out.Add(track.body.sizes().*size);
    out.Add(track.first);
    AddPoses(track.poses, out);
  }
  // Renamed when it is whole: half of it is none.
  const std::filesystem::path partial = folder_ / "tracks.partial";
  Write(partial, bytes, std::ios::trunc);
  std::filesystem::rename(partial, folder_ / "tracks");
}

std::vector<std::vector<PathStep>> SolveFiles::LoadPath(int number) const {
  const std::vector<char> bytes = BytesOf(PathFile(number));
  BytesIn in(bytes);
  std::vector<std::vector<PathStep>> parts;
  std::size_t whole = 0;
  // Each part follows its length, so that one that was cut off is noticed, and found again.
  while (in.left() >= sizeof(std::uint64_t)) {
    if (const auto length = in.Take<std::uint64_t>(); length > in.left()) break;
    parts.push_back(TakeSteps(in));
    whole = bytes.size() - in.left();
  }
  if (whole < bytes.size()) std::filesystem::resize_file(PathFile(number), whole);
  return parts;
}

void SolveFiles::AppendPath(int number, std::span<const PathStep> part) const {
  std::vector<char> steps, bytes;
  BytesOut out(steps);
  out.Add(static_cast<std::uint64_t>(part.size()));
  for (const PathStep& step : part) {
    out.Add(step.pose.has_value());
    if (step.pose) AddPose(*step.pose, out);
    out.Add(static_cast<std::uint64_t>(step.things.to_ullong()));
    out.Add(step.jumps);
    out.Add(step.probability);
  }
  BytesOut(bytes).Add(static_cast<std::uint64_t>(steps.size()));
  bytes.insert(bytes.end(), steps.begin(), steps.end());
  Write(PathFile(number), bytes, std::ios::app);
}

}  // namespace mocap
