#include "tools/solving/set_spool.h"

#include <stdexcept>

#include "tools/solving/bytes.h"
#include "tools/stop_on_signals.h"

namespace mocap {
namespace {

void AddGrid(const VoxelGrid& grid, BytesOut& out) {
  out.AddVector<int>(grid.first_voxel());
  out.AddVector<int>(grid.size());
  out.Add(grid.voxel_mm());
  out.AddAll(grid.words().data(), grid.words().size());
}

void TakeGrid(BytesIn& in, VoxelGrid& grid) {
  const Eigen::Vector3i first = in.TakeVector<int>(), size = in.TakeVector<int>();
  grid.Reset(first, size, in.Take<double>());
  if (!grid.words().empty()) in.TakeAll(grid.row(0, 0), grid.words().size());
}

// The rays of a camera have the same eye and time. Single precision is a thousandth of a pixel.
void AddOutline(const Outline& outline, BytesOut& out) {
  out.Add(static_cast<std::uint32_t>(outline.size()));
  if (outline.empty()) return;
  out.AddVector<double>(outline.front().eye_W);
  out.Add(outline.front().after_s);
  for (const GrazingRay& ray : outline) {
    out.AddVector<float>(ray.direction_W.cast<float>());
    out.AddVector<float>(ray.outward_W.cast<float>());
    out.Add(ray.rank);
  }
}

void TakeOutline(BytesIn& in, Outline& outline) {
  outline.resize(in.Take<std::uint32_t>());
  if (outline.empty()) return;
  const Vector3 eye_W = in.TakeVector<double>();
  const auto after_s = in.Take<double>();
  for (GrazingRay& ray : outline) {
    ray.eye_W = eye_W;
    ray.after_s = after_s;
    ray.direction_W = in.TakeVector<float>().cast<double>();
    ray.outward_W = in.TakeVector<float>().cast<double>();
    ray.rank = in.Take<SpreadRank>();
  }
}

}  // namespace

SetSpoolWriter::SetSpoolWriter(const std::filesystem::path& file)
    : file_(file), out_(file, std::ios::binary | std::ios::trunc) {
  if (!out_) throw std::runtime_error(file.string() + ": cannot be written");
}

void SetSpoolWriter::Add(const RecordedSet& set) {
  BytesOut out(bytes_);
  out.Add(set.frame);
  out.AddVector<double>(set.person_box_W.min());
  out.AddVector<double>(set.person_box_W.max());
  AddGrid(set.grid, out);
  out.Add(static_cast<std::uint32_t>(set.doubtful.size()));
  for (const Eigen::Vector3i& cell : set.doubtful) out.AddVector<int>(cell);
  out.Add(static_cast<std::uint32_t>(set.outlines.size()));
  for (const Outline& outline : set.outlines) AddOutline(outline, out);
  index_.offset.push_back(out_.tellp());
  index_.capture_ns.push_back(set.capture_ns);
  if (!out_.write(bytes_.data(), static_cast<std::streamsize>(bytes_.size())))
    throw std::runtime_error(file_.string() + ": cannot be written");
}

SpoolIndex SetSpoolWriter::Finish() {
  out_.close();
  if (!out_) throw std::runtime_error(file_.string() + ": cannot be written");
  return std::move(index_);
}

SetSpoolReader::SetSpoolReader(const std::filesystem::path& file, const SpoolIndex& index)
    : file_(file), in_(file, std::ios::binary), index_(index) {
  if (!in_) throw std::runtime_error(file.string() + ": cannot be read");
}

void SetSpoolReader::Read(int set, RecordedSet& recorded) {
  EndIfStopAsked();
  const auto i = static_cast<std::size_t>(set);
  const std::int64_t end = i + 1 < index_.offset.size()
                               ? index_.offset[i + 1]
                               : static_cast<std::int64_t>(std::filesystem::file_size(file_));
  bytes_.resize(static_cast<std::size_t>(end - index_.offset[i]));
  in_.seekg(index_.offset[i]);
  if (!in_.read(bytes_.data(), static_cast<std::streamsize>(bytes_.size())))
    throw std::runtime_error(file_.string() + ": cannot be read");
  BytesIn in(bytes_);
  recorded.frame = in.Take<std::int64_t>();
  recorded.capture_ns = index_.capture_ns[i];
  const Vector3 low_W = in.TakeVector<double>();
  recorded.person_box_W = {low_W, in.TakeVector<double>()};
  TakeGrid(in, recorded.grid);
  recorded.doubtful.resize(in.Take<std::uint32_t>());
  for (Eigen::Vector3i& cell : recorded.doubtful) cell = in.TakeVector<int>();
  recorded.outlines.resize(in.Take<std::uint32_t>());
  for (Outline& outline : recorded.outlines) TakeOutline(in, outline);
}

}  // namespace mocap
