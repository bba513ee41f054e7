#include "drivers/take/keypoint_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "drivers/take/take_layout.h"
#include "drivers/take/text_table.h"

namespace mocap {
namespace {

const std::array<std::string, 7> kKeypointColumns = {"camera", "timestamp_ns", "person", "name",
                                                     "x_px",   "y_px",         "score"};
enum KeypointColumn : std::size_t { kCamera, kTime, kPerson, kName, kX, kY, kScore };

/// No picture is as large, and what is farther outside of one says nothing.
constexpr float kFarthest_px = 1e5f;

std::string KeypointHeader() {
  std::string header;
  for (const std::string& column : kKeypointColumns) header += (header.empty() ? "" : ",") + column;
  return header;
}

/// Which view a row belongs to.
using ViewKey = std::tuple<std::string, std::int64_t, int>;

ViewKey KeyOf(const TableRow& row) {
  const std::string camera(row.Text(kCamera));
  if (!IsCameraName(camera)) row.Fail(kCamera, "the name of a camera");
  const auto time_ns = row.Number<std::int64_t>(kTime);
  const auto person = row.Number<int>(kPerson);
  if (person < 0) row.Fail(kPerson, "a number from 0");
  return {camera, time_ns, person};
}

float PixelIn(const TableRow& row, std::size_t column) {
  const auto px = row.Number<float>(column);
  if (std::abs(px) > kFarthest_px) row.Fail(column, "a pixel of a picture");
  return px;
}

Keypoint KeypointOf(const TableRow& row) {
  const std::optional<Landmark> landmark = LandmarkNamed(row.Text(kName));
  if (!landmark) row.Fail(kName, "a landmark such as shoulder_l");
  const auto score = row.Number<float>(kScore);
  if (score < 0 || score > 1) row.Fail(kScore, "a number from 0 to 1");
  return {*landmark, {PixelIn(row, kX), PixelIn(row, kY)}, score};
}

}  // namespace

void WriteKeypoints(std::ostream& out, std::span<const KeypointView> views) {
  out << KeypointHeader() << '\n';
  std::array<char, 96> figures{};
  for (const KeypointView& view : views) {
    const std::string of_view = view.camera + ',' + std::to_string(view.capture_ns) + ',' +
                                std::to_string(view.person) + ',';
    for (const Keypoint& point : view.points) {
      std::snprintf(figures.data(), figures.size(), ",%.3f,%.3f,%.3f\n", double{point.px.x()},
                    double{point.px.y()}, double{point.score});
      out << of_view << NameOf(point.landmark) << figures.data();
    }
  }
}

std::vector<KeypointView> ReadKeypoints(const std::filesystem::path& file) {
  TextLines lines(file, "a table of keypoints");
  RequireHeader(lines, std::array{KeypointHeader()}, KeypointHeader());
  std::vector<KeypointView> views;
  std::map<ViewKey, std::size_t> places;
  std::string_view line;
  while (lines.NextRow(line)) {
    const TableRow row(line, kKeypointColumns, lines);
    const ViewKey key = KeyOf(row);
    const auto [place, is_new] = places.emplace(key, views.size());
    if (is_new) views.push_back({std::get<0>(key), std::get<1>(key), std::get<2>(key), {}});
    std::vector<Keypoint>& points = views[place->second].points;
    const Keypoint point = KeypointOf(row);
    if (std::ranges::find(points, point.landmark, &Keypoint::landmark) != points.end())
      row.Fail(kName, "each landmark once in a view");
    points.push_back(point);
  }
  std::ranges::stable_sort(views, {}, &KeypointView::capture_ns);
  return views;
}

}  // namespace mocap
