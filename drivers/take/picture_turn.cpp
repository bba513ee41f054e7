#include "drivers/take/picture_turn.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace mocap {
namespace {

constexpr double kOne = 65536;
// Tolerance for the cosine of 90 degrees.
constexpr double kTolerance = 1e-3;

std::optional<int> Whole(std::int32_t number) {
  const double value = number / kOne;
  if (std::abs(value - std::round(value)) > kTolerance || std::abs(value) > 1.5)
    return std::nullopt;
  return static_cast<int>(std::lround(value));
}

/// By quarters to the right.
constexpr std::array<PictureTurn, 4> kQuarterTurns = {
    {{}, {0, 1, -1, 0}, {-1, 0, 0, -1}, {0, -1, 1, 0}}};

}  // namespace

std::optional<std::string> TurnInDegrees(const PictureTurn& turn) {
  const auto found = std::ranges::find(kQuarterTurns, turn);
  if (found == kQuarterTurns.end()) return std::nullopt;
  return std::to_string(90 * (found - kQuarterTurns.begin()));
}

std::optional<PictureTurn> TurnFromDegrees(std::string_view text) {
  int degrees = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), degrees);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  if (!is_number || degrees % 90 != 0) return std::nullopt;
  return kQuarterTurns[static_cast<std::size_t>((degrees / 90 % 4 + 4) % 4)];
}

std::string PictureTurn::Text() const {
  if (IsNone()) return "not turned";
  if (*this == PictureTurn{0, 1, -1, 0}) return "turned right by 90 degrees";
  if (*this == PictureTurn{0, -1, 1, 0}) return "turned left by 90 degrees";
  if (*this == PictureTurn{-1, 0, 0, -1}) return "turned by 180 degrees";
  return "mirrored";
}

std::optional<PictureTurn> TurnFromDisplayMatrix(const std::array<std::int32_t, 9>& matrix) {
  const auto a = Whole(matrix[0]), b = Whole(matrix[1]), c = Whole(matrix[3]), d = Whole(matrix[4]);
  if (!a || !b || !c || !d) return std::nullopt;
  const bool is_turn = std::abs(*a * *d - *b * *c) == 1 && (*a == 0) == (*d == 0) &&
                       (*b == 0) == (*c == 0) && (*a == 0) != (*b == 0);
  if (!is_turn) return std::nullopt;
  return PictureTurn{*a, *b, *c, *d};
}

void Turn(const PictureTurn& turn, ImageView<const Bgr> in, ImageView<Bgr> out) {
  // Moves negative coordinates into the picture.
  const int x_offset = turn.a + turn.c < 0 ? out.width() - 1 : 0;
  const int y_offset = turn.b + turn.d < 0 ? out.height() - 1 : 0;
  for (int y = 0; y < in.height(); ++y) {
    for (int x = 0; x < in.width(); ++x)
      out(turn.a * x + turn.c * y + x_offset, turn.b * x + turn.d * y + y_offset) = in(x, y);
  }
}

}  // namespace mocap
