#include "core/body/landmarks.h"

#include <cctype>
#include <string>

namespace mocap {
namespace {

enum class Side { kMiddle, kLeft, kRight };

/// A landmark by a point of the model, and where networks find it from there: forward, to the side
/// (outwards) and up, at the reference configuration, in thousandths of the stature.
struct Row {
  std::string_view name, other_name;  // Without the side; `other_name` is HALPE's or BlazePose's.
  Side side;
  Point point;
  Vector3 offset;
};

// clang-format off
const std::array<Row, kLandmarkCount> kRows = {{
    {"nose", "", Side::kMiddle, Point::kHead, {43, 0, -24}},
    {"eye", "", Side::kLeft, Point::kHead, {28, 14, -7}},
    {"eye", "", Side::kRight, Point::kHead, {28, 14, -7}},
    {"ear", "", Side::kLeft, Point::kHead, {2, 29, -19}},
    {"ear", "", Side::kRight, Point::kHead, {2, 29, -19}},
    {"mouth", "", Side::kLeft, Point::kHead, {35, 9, -45}},
    {"mouth", "", Side::kRight, Point::kHead, {35, 9, -45}},
    {"head_top", "head", Side::kMiddle, Point::kHead, {0, 0, 65}},
    {"neck", "", Side::kMiddle, Point::kNeck, {0, 0, 0}},
    {"shoulder", "", Side::kLeft, Point::kShoulderL, {-2, -4, -2}},
    {"shoulder", "", Side::kRight, Point::kShoulderR, {-2, -4, -2}},
    {"elbow", "", Side::kLeft, Point::kElbowL, {0, 0, 0}},
    {"elbow", "", Side::kRight, Point::kElbowR, {0, 0, 0}},
    {"wrist", "", Side::kLeft, Point::kWristL, {0, 0, 0}},
    {"wrist", "", Side::kRight, Point::kWristR, {0, 0, 0}},
    {"pinky", "", Side::kLeft, Point::kKnucklesL, {0, 0, 0}},
    {"pinky", "", Side::kRight, Point::kKnucklesR, {0, 0, 0}},
    {"index", "", Side::kLeft, Point::kKnucklesL, {0, 0, 0}},
    {"index", "", Side::kRight, Point::kKnucklesR, {0, 0, 0}},
    {"hip_middle", "hip", Side::kMiddle, Point::kHipL, {8, 0, -19}},
    {"hip", "", Side::kLeft, Point::kHipL, {8, -1, -19}},
    {"hip", "", Side::kRight, Point::kHipR, {8, -1, -19}},
    {"knee", "", Side::kLeft, Point::kKneeL, {-13, 0, -6}},
    {"knee", "", Side::kRight, Point::kKneeR, {-13, 0, -6}},
    {"ankle", "", Side::kLeft, Point::kAnkleL, {6, -2, 11}},
    {"ankle", "", Side::kRight, Point::kAnkleR, {6, -2, 11}},
    {"heel", "", Side::kLeft, Point::kHeelL, {19, -16, 2}},
    {"heel", "", Side::kRight, Point::kHeelR, {19, -16, 2}},
    {"big_toe", "foot_index", Side::kLeft, Point::kToeL, {-22, 8, -9}},
    {"big_toe", "foot_index", Side::kRight, Point::kToeR, {-22, 8, -9}},
    {"small_toe", "", Side::kLeft, Point::kBallL, {0, 0, 0}},
    {"small_toe", "", Side::kRight, Point::kBallR, {0, 0, 0}},
}};
// clang-format on

const Row& RowOf(Landmark landmark) { return kRows[static_cast<int>(landmark)]; }

// In lower case, without anything but letters.
std::string Plain(std::string_view name) {
  std::string plain;
  for (const unsigned char letter : name)
    if (std::isalpha(letter)) plain += static_cast<char>(std::tolower(letter));
  return plain;
}

bool IsCalled(const Row& row, const std::string& plain) {
  for (const std::string_view each : {row.name, row.other_name}) {
    const std::string name = Plain(each);
    if (name.empty()) continue;
    if (row.side == Side::kMiddle) {
      if (plain == name) return true;
      continue;
    }
    const std::string side = row.side == Side::kLeft ? "left" : "right";
    for (const std::string& word : {side, side.substr(0, 1)})
      if (plain == word + name || plain == name + word) return true;
  }
  return false;
}

}  // namespace

std::string NameOf(Landmark landmark) {
  const Row& row = RowOf(landmark);
  const std::string_view suffix = row.side == Side::kMiddle ? ""
                                  : row.side == Side::kLeft ? "_l"
                                                            : "_r";
  return std::string(row.name) + std::string(suffix);
}

std::optional<Landmark> LandmarkNamed(std::string_view name) {
  const std::string plain = Plain(name);
  for (int i = 0; i < kLandmarkCount; ++i)
    if (IsCalled(kRows[i], plain)) return static_cast<Landmark>(i);
  return std::nullopt;
}

Landmark Mirrored(Landmark landmark) {
  const int i = static_cast<int>(landmark);
  const Side side = RowOf(landmark).side;
  return static_cast<Landmark>(side == Side::kLeft ? i + 1 : side == Side::kRight ? i - 1 : i);
}

LandmarkPlaces PlaceLandmarks(const BodyModel& body) {
  LandmarkPlaces places;
  const double thousandth_mm = body.sizes().Stature() / 1000;
  for (int i = 0; i < kLandmarkCount; ++i) {
    const Row& row = kRows[i];
    const Vector3 from_left(1, row.side == Side::kRight ? -1 : 1, 1);
    const Vector3 in_plane(1, row.side == Side::kMiddle ? 0 : 1, 1);
    places[i].carrier = body.CarrierOf(row.point);
    const Vector3 point_T = body.reference_points_T().col(static_cast<int>(row.point));
    places[i].p_T =
        point_T.cwiseProduct(in_plane) + thousandth_mm * row.offset.cwiseProduct(from_left);
  }
  return places;
}

Vector3 PlaceIn(const Posture& posture, const LandmarkPlace& place) {
  return (place.carrier < 0 ? posture.X_WT : posture.X_W[place.carrier]) * place.p_T;
}

}  // namespace mocap
