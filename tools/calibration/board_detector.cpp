#include "tools/calibration/board_detector.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/quantile.h"
#include "tools/calibration/board_rectifier.h"
#include "tools/calibration/marker_board.h"
#include "tools/calibration/shown_board.h"
#include "tools/calibration/wand.h"

namespace mocap {
namespace {

constexpr int kWidestCorner_px = 6;
constexpr double kFarthestCorner_px = 1.5;
const cv::TermCriteria kCornerPrecision(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 40, 1e-3);
constexpr double kWideEdge_px = 4, kWideEdgeShare = 0.45;

// Width of an edge between two squares, relative to the widest edge that counts as sharp.
double EdgeExcess(const cv::Mat& gray, const cv::Point2f& from, const cv::Point2f& to) {
  const double length_px = cv::norm(to - from);
  constexpr int kSteps = 24;
  double last = 0, steepest = 1e-9, first = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const cv::Point2f at = from + (to - from) * (static_cast<float>(i) / kSteps);
    const int x = std::clamp(static_cast<int>(at.x), 0, gray.cols - 2);
    const int y = std::clamp(static_cast<int>(at.y), 0, gray.rows - 2);
    const double u = std::clamp(at.x - x, 0.f, 1.f), v = std::clamp(at.y - y, 0.f, 1.f);
    const auto pixel = [&](int dx, int dy) {
      return static_cast<double>(gray.at<std::uint8_t>(y + dy, x + dx));
    };
    const double value = (1 - v) * ((1 - u) * pixel(0, 0) + u * pixel(1, 0)) +
                         v * ((1 - u) * pixel(0, 1) + u * pixel(1, 1));
    if (i == 0) first = value;
    if (i > 0) steepest = std::max(steepest, std::abs(value - last) * kSteps / length_px);
    last = value;
  }
  const double width_px = std::abs(last - first) / steepest;
  return width_px / std::max(kWideEdge_px, kWideEdgeShare * length_px);
}

}  // namespace

class BoardDetector::Impl {
 public:
  explicit Impl(const Board& board) : board_(board) {}

  std::optional<BoardCorners> Detect(ImageView<const Bgr> image, Effort effort) const {
    if (board_.kind == BoardKind::kWand) return DetectLights(image);
    const cv::Mat gray = Gray(image);
    return board_.HasMarkers() ? DetectMarkerBoard(gray, board_) : DetectChessboard(gray, effort);
  }

  std::optional<BoardMismatch> WhyNot(ImageView<const Bgr> image) const {
    if (board_.kind == BoardKind::kWand) return std::nullopt;
    const cv::Mat gray = Gray(image);
    // Chessboards are found on ChArUco boards too, sharp or not.
    for (const auto why : {&Impl::OtherMarkers, &Impl::WhyBlurred, &Impl::OtherChessboard,
                           &Impl::WhyMirrored, &Impl::WhyNegative}) {
      if (auto mismatch = (this->*why)(gray)) return mismatch;
    }
    return std::nullopt;
  }

  std::optional<BoardMismatch> WhyNotAfterAll(ImageView<const Bgr> image) const {
    if (board_.kind != BoardKind::kChessboard) return std::nullopt;
    const cv::Mat gray = Gray(image);
    for (const auto why : {&Impl::OtherMarkers, &Impl::OtherChessboard, &Impl::WhyNegative}) {
      const auto other = (this->*why)(gray);
      if (other && other->corners_seen >= board_.corners()) return other;
    }
    return std::nullopt;
  }

 private:
  cv::Mat Gray(ImageView<const Bgr> image) const {
    const cv::Mat view(image.height(), image.width(), CV_8UC3, const_cast<Bgr*>(image.row(0)),
                       image.stride() * sizeof(Bgr));
    cv::Mat gray;
    cv::cvtColor(view, gray, cv::COLOR_BGR2GRAY);
    if (board_.inverted) cv::bitwise_not(gray, gray);
    return gray;
  }

  std::optional<BoardMismatch> Other(const std::optional<Board>& shown) const {
    if (!shown || MayBe(*shown, board_)) return std::nullopt;
    return BoardMismatch{LooksLikeText(*shown, board_), shown->corners()};
  }

  std::optional<BoardMismatch> OtherMarkers(const cv::Mat& gray) const {
    return Other(FindShownMarkerBoard(gray, board_));
  }

  std::optional<BoardMismatch> OtherChessboard(const cv::Mat& gray) const {
    return Other(FindShownChessboard(gray, board_));
  }

  // Markers are read neither in a mirror nor as a negative.
  std::optional<BoardMismatch> WhyMirrored(const cv::Mat& gray) const {
    cv::Mat mirrored;
    cv::flip(gray, mirrored, 1);
    const auto shown = FindShownMarkerBoard(mirrored, board_);
    if (!shown) return std::nullopt;
    return BoardMismatch{
        "shows the board mirrored; switch mirroring off, or print the board unmirrored",
        shown->corners()};
  }

  std::optional<BoardMismatch> WhyNegative(const cv::Mat& gray) const {
    cv::Mat negative;
    cv::bitwise_not(gray, negative);
    auto shown = FindShownMarkerBoard(negative, board_);
    if (!shown) return std::nullopt;
    shown->inverted = !board_.inverted;
    if (auto other = Other(shown); other) return other;
    return BoardMismatch{board_.inverted
                             ? "shows the board black on white; leave :inverted out of --board"
                             : "shows the board white on black; add :inverted to --board",
                         shown->corners()};
  }

  std::optional<BoardMismatch> WhyBlurred(const cv::Mat& gray) const {
    std::vector<cv::Point2f> corners;
    if (board_.HasMarkers() || !cv::findChessboardCornersSB(gray, {board_.columns, board_.rows},
                                                            corners, cv::CALIB_CB_NORMALIZE_IMAGE))
      return std::nullopt;
    return BoardMismatch{"shows the board blurred; hold it still, focus, or shorten the exposure",
                         board_.corners()};
  }

  // All lights: only motion shows which two are the wand's.
  static std::optional<BoardCorners> DetectLights(ImageView<const Bgr> image) {
    BoardCorners lights;
    lights.pixels = FindSpots(image);
    lights.ids.resize(lights.pixels.size());
    std::iota(lights.ids.begin(), lights.ids.end(), 0);
    return lights.ids.size() < 2 ? std::nullopt : std::optional(lights);
  }

  std::optional<BoardCorners> DetectChessboard(const cv::Mat& gray, Effort effort) const {
    const cv::Size size(board_.columns, board_.rows);
    std::vector<cv::Point2f> corners;
    int flags = cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_ACCURACY;
    if (effort == Effort::kThorough) flags |= cv::CALIB_CB_EXHAUSTIVE;
    if (!cv::findChessboardCornersSB(gray, size, corners, flags)) {
      if (effort == Effort::kQuick) return std::nullopt;
      corners = FindRectifiedChessboard(gray, size);
      if (corners.empty()) return std::nullopt;
    }
    // In blurred pictures corners are found, but at wrong places.
    if (IsBlurred(gray, corners)) return std::nullopt;
    RefineCorners(gray, corners);
    BoardCorners found;
    for (int id = 0; id < board_.corners(); ++id) {
      found.ids.push_back(id);
      found.pixels.emplace_back(corners[id].x, corners[id].y);
    }
    MakeUnmirrored(found);
    if (!board_.LooksSameTurned()) BeginAtDarkSquare(gray, found);
    return found;
  }

  // The detector finds boards that nothing else finds, but is biased by 0.05 to 0.1 pixels to one
  // side. For a board on the floor this means millimetres: without it, errors of points in the room
  // fell from 2.5 to 1.1 mm. The intersection of the edges at a corner is unbiased.
  static void RefineCorners(const cv::Mat& gray, std::vector<cv::Point2f>& corners) {
    const std::vector<cv::Point2f> found = corners;
    for (std::size_t i = 0; i < found.size(); ++i) {
      double nearest_px = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < found.size(); ++j)
        if (j != i) nearest_px = std::min(nearest_px, cv::norm(found[j] - found[i]));
      // Keep other corners out of the window.
      const int half_px = std::clamp(static_cast<int>(nearest_px / 2), 2, kWidestCorner_px);
      std::vector<cv::Point2f> refined{found[i]};
      cv::cornerSubPix(gray, refined, {half_px, half_px}, {-1, -1}, kCornerPrecision);
      if (cv::norm(refined[0] - found[i]) < kFarthestCorner_px) corners[i] = refined[0];
    }
  }

  // With an odd and an even side, the corners are dark at one end and light at the other; both
  // orders are possible.
  void BeginAtDarkSquare(const cv::Mat& gray, BoardCorners& found) const {
    const auto brightness = [&](int row, int column) {
      const int id = row * board_.columns + column;
      const Vector2 middle =
          (found.pixels[id] + found.pixels[id + 1] + found.pixels[id + board_.columns] +
           found.pixels[id + board_.columns + 1]) /
          4;
      const int x = std::clamp(static_cast<int>(std::lround(middle.x())), 0, gray.cols - 1);
      const int y = std::clamp(static_cast<int>(std::lround(middle.y())), 0, gray.rows - 1);
      return static_cast<int>(gray.at<std::uint8_t>(y, x));
    };
    int contrast = 0;
    for (int row = 0; row + 1 < board_.rows; ++row) {
      for (int column = 0; column + 1 < board_.columns; ++column)
        contrast += ((row + column) % 2 == 0 ? 1 : -1) * brightness(row, column);
    }
    if (contrast > 0) std::reverse(found.pixels.begin(), found.pixels.end());
  }

  // Whether edges are wide relative to the squares, along rows or columns.
  bool IsBlurred(const cv::Mat& gray, const std::vector<cv::Point2f>& corners) const {
    const auto middle = [&](int row, int column) {
      const int id = row * board_.columns + column;
      return (corners[id] + corners[id + 1] + corners[id + board_.columns] +
              corners[id + board_.columns + 1]) /
             4;
    };
    for (const auto& [down, across] : {std::pair(0, 1), std::pair(1, 0)}) {
      std::vector<double> excess;
      for (int row = 0; row + 1 + down < board_.rows; ++row) {
        for (int column = 0; column + 1 + across < board_.columns; ++column)
          excess.push_back(
              EdgeExcess(gray, middle(row, column), middle(row + down, column + across)));
      }
      if (MedianOf(excess) > 1) return true;
    }
    return false;
  }

  // On the printed side, x is to the right when y is down.
  void MakeUnmirrored(BoardCorners& found) const {
    const Vector2 across = found.pixels[board_.columns - 1] - found.pixels[0];
    const Vector2 down = found.pixels[(board_.rows - 1) * board_.columns] - found.pixels[0];
    if (across.x() * down.y() - across.y() * down.x() > 0) return;
    std::vector<Vector2> turned(found.pixels.size());
    for (int id = 0; id < board_.corners(); ++id) {
      const int column = board_.columns - 1 - id % board_.columns;
      turned[id] = found.pixels[id / board_.columns * board_.columns + column];
    }
    found.pixels = turned;
  }

  Board board_;
};

BoardDetector::BoardDetector(const Board& board) : impl_(std::make_unique<Impl>(board)) {}
BoardDetector::~BoardDetector() = default;
BoardDetector::BoardDetector(BoardDetector&&) noexcept = default;

std::optional<BoardMismatch> BoardDetector::WhyNot(ImageView<const Bgr> image) const {
  return impl_->WhyNot(image);
}

std::optional<BoardMismatch> BoardDetector::WhyNotAfterAll(ImageView<const Bgr> image) const {
  return impl_->WhyNotAfterAll(image);
}

std::optional<BoardCorners> BoardDetector::Detect(ImageView<const Bgr> image, Effort effort) const {
  return impl_->Detect(image, effort);
}

}  // namespace mocap
