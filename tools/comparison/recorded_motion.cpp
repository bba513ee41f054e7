#include "tools/comparison/recorded_motion.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/quantile.h"

namespace mocap {
namespace {

struct LengthUnit {
  std::string_view name;
  double mm;
};
/// The first four are those that files without a unit have.
constexpr std::array kLengthUnits = {
    LengthUnit{"mm", 1},          LengthUnit{"cm", 10},          LengthUnit{"m", 1000},
    LengthUnit{"in", 25.4},       LengthUnit{"dm", 100},         LengthUnit{"ft", 304.8},
    LengthUnit{"millimeters", 1}, LengthUnit{"millimeter", 1},   LengthUnit{"centimeters", 10},
    LengthUnit{"centimeter", 10}, LengthUnit{"meters", 1000},    LengthUnit{"meter", 1000},
    LengthUnit{"millimetres", 1}, LengthUnit{"centimetres", 10}, LengthUnit{"metres", 1000},
    LengthUnit{"inches", 25.4},   LengthUnit{"inch", 25.4},      LengthUnit{"feet", 304.8}};
constexpr std::size_t kUnstatedUnits = 4;

template <typename Tracks>
auto FindNamed(const Tracks& tracks, std::string_view name) {
  const auto track =
      std::ranges::find_if(tracks, [&](const auto& one) { return one.name == name; });
  return track == tracks.end() ? nullptr : &*track;
}

/// Root mean square distance of a frame's points from their middle; NaN: too few are seen.
double SpreadIn(const RecordedMotion& motion, std::size_t frame) {
  Vector3 sum = Vector3::Zero();
  double squares = 0;
  int count = 0;
  for (const PointTrack& track : motion.points) {
    const Vector3& p = track.p_mm[frame];
    if (!p.allFinite()) continue;
    sum += p;
    squares += p.squaredNorm();
    ++count;
  }
  if (count < 3) return kUnmeasured;
  return std::sqrt(std::max(0.0, squares / count - (sum / count).squaredNorm()));
}

/// The median over at most some hundred frames.
double SpreadOf(const RecordedMotion& motion) {
  const std::size_t step = std::max<std::size_t>(1, motion.time_s.size() / 200);
  std::vector<double> spreads;
  for (std::size_t i = 0; i < motion.time_s.size(); i += step) {
    const double spread = SpreadIn(motion, i);
    if (spread > 0) spreads.push_back(spread);
  }
  return spreads.empty() ? 0 : MedianOf(spreads);
}

}  // namespace

const PointTrack* RecordedMotion::FindPoint(std::string_view name) const {
  return FindNamed(points, name);
}
const AngleCurve* RecordedMotion::FindAngle(std::string_view name) const {
  return FindNamed(angles, name);
}

double RecordedMotion::Period() const {
  if (time_s.size() < 2) return 0;
  std::vector<double> apart;
  for (std::size_t i = 1; i < time_s.size(); ++i) apart.push_back(time_s[i] - time_s[i - 1]);
  return MedianOf(apart);
}

FrameFinder::FrameFinder(const RecordedMotion& motion)
    // Less than a missing frame, and more than the jitter of capture times.
    : motion_(motion), longest_s_(1.6 * motion.Period()) {}

std::optional<FramePlace> FrameFinder::Find(double time_s) const {
  // Offsets are hardly found more exactly.
  constexpr double kSame_s = 1e-5;
  const std::vector<double>& times = motion_.time_s;
  const auto next = std::ranges::upper_bound(times, time_s + kSame_s);
  if (next == times.begin()) return {};
  const auto before = static_cast<std::size_t>(next - times.begin() - 1);
  const double since_s = time_s - times[before];
  if (std::abs(since_s) <= kSame_s) return FramePlace{before, 0};
  if (next == times.end() || *next - times[before] > longest_s_) return {};
  return FramePlace{before, since_s / (*next - times[before])};
}

Vector3 PointAt(const std::vector<Vector3>& track, const FramePlace& place) {
  const std::size_t i = place.before;
  const double u = place.share;
  if (u == 0) return track[i];
  const Vector3 line = (1 - u) * track[i] + u * track[i + 1];
  if (i == 0 || i + 2 >= track.size()) return line;
  const Vector3 &before = track[i - 1], &after = track[i + 2];
  if (!before.allFinite() || !after.allFinite()) return line;
  // Lagrange's polynomial through the frames -1, 0, 1 and 2.
  return -u * (u - 1) * (u - 2) / 6 * before + (u + 1) * (u - 1) * (u - 2) / 2 * track[i] -
         (u + 1) * u * (u - 2) / 2 * track[i + 1] + (u + 1) * u * (u - 1) / 6 * after;
}

double AngleAt(const std::vector<double>& track, const FramePlace& place) {
  if (place.share == 0) return track[place.before];
  return (1 - place.share) * track[place.before] + place.share * track[place.before + 1];
}

std::vector<double> AxisOf(const std::vector<Vector3>& points, int axis) {
  std::vector<double> values;
  for (const Vector3& p : points) values.push_back(p[axis]);
  return values;
}

void Unwrap(std::vector<double>& deg) {
  double last = kUnmeasured;
  for (double& angle : deg) {
    if (!std::isfinite(angle)) continue;
    if (std::isfinite(last)) angle = last + std::remainder(angle - last, 360);
    last = angle;
  }
}

std::string_view ScaleLike(const RecordedMotion& other, RecordedMotion& motion) {
  const double wanted = SpreadOf(other), given = SpreadOf(motion);
  const LengthUnit* best = &kLengthUnits[1];
  if (wanted > 0 && given > 0) {
    const auto error = [&](const LengthUnit& unit) {
      return std::abs(std::log(unit.mm * given / wanted));
    };
    best = &*std::ranges::min_element(kLengthUnits.begin(), kLengthUnits.begin() + kUnstatedUnits,
                                      {}, error);
  }
  for (PointTrack& track : motion.points)
    for (Vector3& p : track.p_mm) p *= best->mm;
  motion.has_unit = true;
  return best->name;
}

std::optional<double> UnitInMm(std::string_view unit) {
  std::string small;
  for (const char c : unit)
    if (std::isalpha(static_cast<unsigned char>(c)))
      small += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto found = std::ranges::find(kLengthUnits, std::string_view(small), &LengthUnit::name);
  if (found == kLengthUnits.end()) return {};
  return found->mm;
}

}  // namespace mocap
