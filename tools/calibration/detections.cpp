#include "tools/calibration/detections.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/errors.h"
#include "tools/calibration/board_flatness.h"
#include "tools/calibration/wand.h"

namespace mocap {
namespace {

// Beyond this many intervals, frames do not determine the motion between them.
constexpr double kLongestGaps = 1.8;
constexpr int kFramesToDiagnose = 10, kViewsToDoubt = 3;

class MeanPicture {
 public:
  void Add(ImageView<const Bgr> view) {
    if (sums_.empty()) {
      width_ = view.width();
      sums_.assign(3u * view.width() * view.height(), 0);
    }
    std::size_t i = 0;
    for (int y = 0; y < view.height(); ++y) {
      for (int x = 0; x < view.width(); ++x) {
        const Bgr pixel = view(x, y);
        for (const std::uint8_t value : {pixel.b, pixel.g, pixel.r}) sums_[i++] += value;
      }
    }
    ++count_;
  }

  Image<Bgr> Get() const {
    Image<Bgr> mean(width_, static_cast<int>(sums_.size()) / 3 / width_);
    std::size_t i = 0;
    const auto next = [&] { return static_cast<std::uint8_t>((sums_[i++] + count_ / 2) / count_); };
    for (Bgr& pixel : mean.pixels()) {
      pixel.b = next();
      pixel.g = next();
      pixel.r = next();
    }
    return mean;
  }

  bool empty() const { return count_ == 0; }

 private:
  int width_ = 0;
  std::uint32_t count_ = 0;
  std::vector<std::uint32_t> sums_;
};

const Vector2* Find(const BoardCorners& corners, int id) {
  const auto place = std::find(corners.ids.begin(), corners.ids.end(), id);
  return place == corners.ids.end()
             ? nullptr
             : &corners.pixels[static_cast<std::size_t>(place - corners.ids.begin())];
}

// Fits a parabola at times -before_s, 0 and after_s; a line if one point is missing.
CornerMotion MotionThrough(const Vector2* before, double before_s, const Vector2& now,
                           const Vector2* after, double after_s) {
  CornerMotion motion;
  if (before != nullptr) motion.velocity = (now - *before) / before_s;
  if (after == nullptr) return motion;
  const Vector2 ahead = (*after - now) / after_s;
  if (before == nullptr) return {ahead, Vector2::Zero()};
  motion.acceleration = 2 * (ahead - motion.velocity) / (before_s + after_s);
  motion.velocity = (motion.velocity * after_s + ahead * before_s) / (before_s + after_s);
  return motion;
}

// Detections of one camera from `first` on, in order of capture time.
void MeasureMotions(std::vector<BoardDetection>& detections, std::size_t first,
                    const std::vector<double>& times_s, double longest_gap_s) {
  for (std::size_t i = first; i < detections.size(); ++i) {
    BoardDetection& now = detections[i];
    const double before_s = i > first ? times_s[i - first] - times_s[i - first - 1] : HUGE_VAL;
    const double after_s =
        i + 1 < detections.size() ? times_s[i - first + 1] - times_s[i - first] : HUGE_VAL;
    for (std::size_t k = 0; k < now.corners.ids.size(); ++k) {
      const int id = now.corners.ids[k];
      now.motions.push_back(MotionThrough(
          before_s < longest_gap_s ? Find(detections[i - 1].corners, id) : nullptr, before_s,
          now.corners.pixels[k],
          after_s < longest_gap_s ? Find(detections[i + 1].corners, id) : nullptr, after_s));
    }
  }
}

// Searches some frames of a camera again for the reason of failure; the frame that shows most of it
// counts. Empty if nothing similar to a board is visible.
std::string WhyUnseen(const FootageCamera& camera, const BoardDetector& detector) {
  std::string reason;
  int most_seen = 0;
  const int step = std::max(1, static_cast<int>(camera.frames.size()) / kFramesToDiagnose);
  camera.ForEach([&](int frame, ImageView<const Bgr> view) {
    if (frame % step != 0) return;
    const auto why = detector.WhyNot(view);
    if (!why || why->corners_seen <= most_seen) return;
    most_seen = why->corners_seen;
    reason = camera.frames[frame].name + " " + why->text;
  });
  return reason;
}

[[noreturn]] void RefuseUnseen(const Footage& footage, const FootageCamera& camera,
                               const Board& board, const BoardDetector& detector) {
  if (const std::string reason = WhyUnseen(camera, detector); !reason.empty())
    throw SetupError(footage.folder.string() + ": " + camera.name + ": " + reason);
  throw SetupError(footage.folder.string() + ": " + camera.name + " sees no board in its " +
                   std::to_string(camera.frames.size()) + " frames; expected a " + board.Text() +
                   ": compare that with the board, show all of it, sharp and evenly lit");
}

// Where one camera would do: refuses if none sees the board and one sees why.
void RefuseUnseenByAll(const Footage& footage, const BoardDetector& detector) {
  for (const FootageCamera& camera : footage.cameras) {
    if (const std::string reason = WhyUnseen(camera, detector); !reason.empty())
      throw SetupError(footage.folder.string() + ": " + camera.name + ": " + reason);
  }
}

// What the first views of a camera are of, if that is another board.
class FirstViews {
 public:
  void Look(const BoardDetector& detector, ImageView<const Bgr> view, const std::string& frame) {
    // One that is of the board is enough.
    if (looked_at_ > others_ || looked_at_ >= kViewsToDoubt) return;
    ++looked_at_;
    const auto why = detector.WhyNotAfterAll(view);
    if (!why) return;
    ++others_;
    if (reason_.empty()) reason_ = frame + " " + why->text;
  }

  void RefuseOther(const Footage& footage, const FootageCamera& camera) const {
    if (others_ > 0 && others_ == looked_at_)
      throw SetupError(footage.folder.string() + ": " + camera.name + ": " + reason_);
  }

 private:
  int looked_at_ = 0, others_ = 0;
  std::string reason_;
};

std::vector<int> MomentsOfFrames(const std::vector<FootageMoment>& moments, std::size_t camera,
                                 std::size_t frames) {
  std::vector<int> moment_of(frames, -1);
  for (std::size_t m = 0; m < moments.size(); ++m) {
    if (moments[m].frames[camera] >= 0) moment_of[moments[m].frames[camera]] = static_cast<int>(m);
  }
  return moment_of;
}

// Removes lights that are not the wand's from a camera's detections.
void KeepWandsFrom(std::size_t first, BoardDetections& detections, std::vector<double>& times_s) {
  const auto begin = detections.detections.begin() + static_cast<std::ptrdiff_t>(first);
  std::vector<BoardDetection> of_camera(begin, detections.detections.end());
  KeepWands(of_camera);
  detections.detections.erase(begin, detections.detections.end());
  times_s.clear();
  for (BoardDetection& s : of_camera) {
    times_s.push_back(s.time_s);
    detections.detections.push_back(std::move(s));
  }
}

double MeanInterval(const FootageCamera& camera) {
  return 1e-9 * static_cast<double>(camera.frames.back().time_ns - camera.frames.front().time_ns) /
         std::max<double>(1, static_cast<double>(camera.frames.size()) - 1);
}

// Decides views whose markers fit both layouts. In the older one, they are a column farther left.
void SettleOpenLayouts(BoardDetections& detections, std::size_t first, bool older) {
  for (std::size_t s = first; s < detections.detections.size(); ++s) {
    BoardCorners& corners = detections.detections[s].corners;
    if (!corners.layout_open) continue;
    corners.layout_open = false;
    corners.older_layout = older;
    for (int& id : corners.ids) id -= older ? 1 : 0;
  }
}

// How many views show the older layout, less those that show the newer.
int CountOlderLayouts(const BoardDetections& detections, std::size_t first) {
  int count = 0;
  for (std::size_t s = first; s < detections.detections.size(); ++s) {
    const BoardCorners& corners = detections.detections[s].corners;
    if (!corners.layout_open) count += corners.older_layout ? 1 : -1;
  }
  return count;
}

/// Searches the pictures of one camera after the other.
class BoardSearch {
 public:
  BoardSearch(const Footage& footage, const Board& board, const DetectionOptions& options)
      : footage_(footage), options_(options), detector_(board), moments_(MatchMoments(footage)) {
    result_.board = board;
    result_.moments = options.still ? 1 : static_cast<int>(moments_.size());
    result_.timed = std::all_of(footage.cameras.begin(), footage.cameras.end(),
                                [](const FootageCamera& camera) { return camera.timed; });
  }

  BoardDetections Run() {
    for (std::size_t c = 0; c < footage_.cameras.size(); ++c) SearchCamera(c);
    if (result_.detections.empty()) RefuseUnseenByAll(footage_, detector_);
    result_.board.older_layout = CountOlderLayouts(result_, 0) > 0;
    SettleOpenLayouts(result_, 0, result_.board.older_layout);
    return std::move(result_);
  }

 private:
  void SearchCamera(std::size_t c) {
    const FootageCamera& camera = footage_.cameras[c];
    const double interval_s = MeanInterval(camera);
    const int total = static_cast<int>(moments_.size());
    const int stride = std::max(1, (total + options_.most_frames - 1) / options_.most_frames);
    result_.interval_s = c == 0 ? interval_s : std::min(result_.interval_s, interval_s);
    result_.cameras.push_back({camera.name, camera.width_px, camera.height_px, 0, ""});
    first_ = result_.detections.size();
    first_views_ = {};
    times_s_.clear();
    if (options_.still) {
      SearchMean(camera);
    } else {
      SearchFrames(camera, MomentsOfFrames(moments_, c, camera.frames.size()), stride, total);
    }
    first_views_.RefuseOther(footage_, camera);
    if (result_.board.kind == BoardKind::kWand) KeepWandsFrom(first_, result_, times_s_);
    // Before motions, which compare corners of one number.
    if (const int older = CountOlderLayouts(result_, first_); older != 0)
      SettleOpenLayouts(result_, first_, older > 0);
    if (!options_.still && result_.timed)
      MeasureMotions(result_.detections, first_, times_s_, kLongestGaps * stride * interval_s);
    if (found() == 0 && options_.all_must_see)
      RefuseUnseen(footage_, camera, result_.board, detector_);
    RefuseUneven(footage_.folder.string() + ": " + camera.name, result_, first_);
  }

  void SearchMean(const FootageCamera& camera) {
    MeanPicture mean;
    camera.ForEach([&](int, ImageView<const Bgr> view) { mean.Add(view); });
    if (mean.empty()) return;
    result_.cameras.back().frames = 1;
    result_.still_pictures.push_back(mean.Get());
    Search(camera, result_.still_pictures.back().view(), Effort::kThorough, 0, 0);
  }

  void SearchFrames(const FootageCamera& camera, const std::vector<int>& moment_of, int stride,
                    int total) {
    camera.ForEach([&](int frame, ImageView<const Bgr> view) {
      // The same moments for all cameras.
      if (moment_of[frame] % stride != 0) return;
      ++result_.cameras.back().frames;
      Search(camera, view, options_.effort, frame, moment_of[frame]);
      if (options_.progress)
        options_.progress(camera.name, moment_of[frame] + 1, total, found(),
                          CoverageOf(result_, id()).Hint());
    });
  }

  void Search(const FootageCamera& camera, ImageView<const Bgr> view, Effort effort, int frame,
              int moment) {
    std::optional<BoardCorners> corners = detector_.Detect(view, effort);
    if (!corners) return;
    first_views_.Look(detector_, view, camera.frames[frame].name);
    const FootageFrame& f = camera.frames[frame];
    const auto seconds_since = [](std::int64_t to_ns, std::int64_t from_ns) {
      return 1e-9 * static_cast<double>(to_ns - from_ns);
    };
    const double late_s = result_.timed ? seconds_since(f.time_ns, moments_[moment].time_ns) : 0;
    times_s_.push_back(seconds_since(f.time_ns, moments_[0].time_ns));
    result_.detections.push_back(
        {id(), moment, std::move(*corners), f.angles, f.name, times_s_.back(), late_s, {}});
  }

  int id() const { return static_cast<int>(result_.cameras.size()) - 1; }
  int found() const { return static_cast<int>(result_.detections.size() - first_); }

  const Footage& footage_;
  const DetectionOptions& options_;
  const BoardDetector detector_;
  const std::vector<FootageMoment> moments_;
  BoardDetections result_;
  // Of the camera that is searched.
  std::size_t first_ = 0;
  FirstViews first_views_;
  std::vector<double> times_s_;
};

}  // namespace

int BoardDetections::CountOf(int camera) const {
  return static_cast<int>(
      std::count_if(detections.begin(), detections.end(),
                    [camera](const BoardDetection& s) { return s.camera == camera; }));
}

BoardDetections CollectDetections(const Footage& footage, const Board& board,
                                  const DetectionOptions& options) {
  return BoardSearch(footage, board, options).Run();
}

void MatchAgain(const std::vector<double>& lateness_s, BoardDetections& detections) {
  MOCAP_CHECK(detections.timed && lateness_s.size() == detections.cameras.size());
  const auto time_of = [&](const BoardDetection& s) { return s.time_s + lateness_s[s.camera]; };
  std::vector<BoardDetection*> order;
  for (BoardDetection& s : detections.detections) order.push_back(&s);
  std::stable_sort(
      order.begin(), order.end(),
      [&](const BoardDetection* a, const BoardDetection* b) { return time_of(*a) < time_of(*b); });
  int moment = -1;
  double moment_s = 0;
  std::vector<bool> seen;
  for (BoardDetection* s : order) {
    if (moment < 0 || time_of(*s) - moment_s > detections.interval_s / 2 || seen[s->camera]) {
      ++moment;
      moment_s = time_of(*s);
      seen.assign(detections.cameras.size(), false);
    }
    seen[s->camera] = true;
    s->moment = moment;
    s->late_s = s->time_s - moment_s;
  }
  detections.moments = moment + 1;
}

Coverage CoverageOf(const BoardDetections& detections, int camera) {
  Coverage coverage;
  const DetectionCamera& c = detections.cameras[camera];
  for (const BoardDetection& detection : detections.detections) {
    if (detection.camera != camera) continue;
    for (const Vector2& pixel : detection.corners.pixels) {
      const int x = static_cast<int>(pixel.x() * Coverage::kColumns / c.width_px);
      const int y = static_cast<int>(pixel.y() * Coverage::kRows / c.height_px);
      ++coverage.counts[std::clamp(y, 0, Coverage::kRows - 1)]
                       [std::clamp(x, 0, Coverage::kColumns - 1)];
    }
  }
  int covered = 0;
  for (const auto& row : coverage.counts) {
    for (const int count : row) covered += count > 0;
  }
  coverage.share = static_cast<double>(covered) / (Coverage::kColumns * Coverage::kRows);
  return coverage;
}

std::string Coverage::Hint() const {
  std::string hint;
  for (int third_row = 0; third_row < 2; ++third_row) {
    for (int third = 0; third < 3; ++third) {
      int seen = 0;
      for (int y = 0; y < kRows / 2; ++y) {
        for (int x = 0; x < kColumns / 3; ++x)
          seen += counts[third_row * kRows / 2 + y][third * kColumns / 3 + x];
      }
      if (seen > 0) continue;
      static constexpr const char* kPlaces[2][3] = {{"upper left", "upper middle", "upper right"},
                                                    {"lower left", "lower middle", "lower right"}};
      hint += (hint.empty() ? "nothing in the " : ", ") + std::string(kPlaces[third_row][third]);
    }
  }
  return hint;
}

}  // namespace mocap
