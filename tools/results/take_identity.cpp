#include "tools/results/take_identity.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "config/take_header.h"
#include "core/errors.h"
#include "core/quantile.h"
#include "drivers/quoted.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/take_table.h"
#include "tools/checksum.h"

namespace mocap {
namespace {

constexpr std::size_t kLargestCalibration = 16 << 20;
/// Frame rates that differ by more are those of different takes.
constexpr double kSameRate = 1.2;

/// Median time from one frame set to the next; 0: not known.
double SetIntervalNs(const std::vector<PoseRow>& rows) {
  std::vector<double> apart_ns;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto sets = static_cast<double>(rows[i].frame - rows[i - 1].frame);
    apart_ns.push_back(static_cast<double>(rows[i].timestamp_ns - rows[i - 1].timestamp_ns) / sets);
  }
  return apart_ns.empty() ? 0 : MedianOf(apart_ns);
}

TakeMark MarkWith(const TakeHeader& header, const std::filesystem::path& take) {
  const std::string calibration =
      ReadWholeFile(TakeLayout{take}.Calibration(), "a calibration", kLargestCalibration);
  return {header.name, fmt::format("{:016x}", Fnv1a(calibration))};
}

}  // namespace

TakeMark MarkOf(const std::filesystem::path& take) { return MarkWith(ReadTakeHeader(take), take); }

TakeIdentity::TakeIdentity(const std::filesystem::path& take) : take_(take) {
  const TakeLayout layout{take};
  const TakeHeader header = ReadTakeHeader(take);
  mark_ = MarkWith(header, take);
  for (const std::string& camera : header.cameras) {
    const std::filesystem::path file = layout.Table(camera);
    if (!IsThere(file) || HoldsNoRows(file)) continue;
    const TakeTable table = ReadTakeTable(file);
    const std::int64_t interval_ns = UsualIntervalNs(table);
    const Times own{table.rows.front().timestamp_ns, table.rows.back().timestamp_ns, interval_ns,
                    interval_ns};
    if (!times_) times_ = own;
    times_->first_ns = std::min(times_->first_ns, own.first_ns);
    times_->last_ns = std::max(times_->last_ns, own.last_ns);
    times_->shortest_ns = std::min(times_->shortest_ns, interval_ns);
    times_->longest_ns = std::max(times_->longest_ns, interval_ns);
  }
}

void TakeIdentity::Require(const std::filesystem::path& folder_or_log, Result& result) const {
  const std::string name = folder_or_log.string();
  if (result.take && result.take->name != mark_.name) {
    throw SetupError(
        fmt::format("{}: is a result of the take {}, but {} is the take {}; expected "
                    "a result of the same take",
                    name, Quoted(result.take->name), take_.string(), Quoted(mark_.name)));
  }
  if (result.take && result.take->calibration != mark_.calibration) {
    result.remarks.push_back(
        fmt::format("{}: was tracked with another calibration than that in {}: track it again",
                    name, take_.string()));
  }
  CompareTimes(folder_or_log, result);
}

void TakeIdentity::CompareTimes(const std::filesystem::path& folder_or_log, Result& result) const {
  const std::vector<PoseRow>& rows = result.poses;
  if (!times_ || rows.empty()) return;
  const auto outside = std::ranges::count_if(rows, [this](const PoseRow& row) {
    return row.timestamp_ns < times_->first_ns - times_->longest_ns ||
           row.timestamp_ns > times_->last_ns + times_->longest_ns;
  });
  const std::string spans =
      fmt::format("{}: its poses are of {} to {} ns, the frames of {} of {} to {} ns",
                  folder_or_log.string(), rows.front().timestamp_ns, rows.back().timestamp_ns,
                  take_.string(), times_->first_ns, times_->last_ns);
  const bool is_log = !std::filesystem::is_directory(folder_or_log);
  if (outside == std::ssize(rows)) {
    if (!is_log) throw SetupError(spans + "; expected a result of that take");
    result.remarks.push_back(spans + "; check that it was made of this take");
  }
  if (is_log) return;
  if (outside > 0) result.remarks.push_back(spans + "; check that it is of this take");
  const double interval_ns = SetIntervalNs(rows);
  const auto longest_ns = static_cast<double>(times_->longest_ns);
  const auto shortest_ns = static_cast<double>(times_->shortest_ns);
  const bool is_slower = interval_ns > kSameRate * longest_ns;
  const bool is_of_other_rate = is_slower || kSameRate * interval_ns < shortest_ns;
  if (interval_ns == 0 || longest_ns == 0 || !is_of_other_rate) return;
  result.remarks.push_back(fmt::format(
      "{}: its frames are {:.1f} ms apart, those of {} {:.1f} ms; check that it is of this take",
      folder_or_log.string(), interval_ns / 1e6, take_.string(),
      (is_slower ? longest_ns : shortest_ns) / 1e6));
}

}  // namespace mocap
