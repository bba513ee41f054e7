#include "tools/kinematics/rest_body.h"

#include <algorithm>

#include "config/body_size_fields.h"
#include "config/builtin_body_tables.h"
#include "config/load_config.h"

namespace mocap {
namespace {

constexpr double kAverageStature_mm = 1750;

/// Left along the hips, up towards the spine's joint.
Matrix3 HipAxes(const BodyPoints& points) {
  const auto at = [&](Point point) { return points.col(static_cast<int>(point)); };
  const Vector3 left = (at(Point::kHipL) - at(Point::kHipR)).normalized();
  const Vector3 to_spine = at(Point::kTorso) - (at(Point::kHipL) + at(Point::kHipR)) / 2;
  const Vector3 forward = left.cross(to_spine).normalized();
  Matrix3 R;
  R << forward, left, forward.cross(left);
  return R;
}

BodyTable TableOf(const BodyRecord& body) {
  const bool is_builtin = std::ranges::any_of(
      BuiltinBodyTables(), [&](const BuiltinBodyTable& table) { return table.name == body.model; });
  return LoadBodyTable(is_builtin ? body.model : Trackers().front().body);
}

BodySizes SizesOf(const BodyRecord& body) {
  const bool is_whole = std::ranges::all_of(
      kBodySizeFields, [&](const BodySizeField& field) { return body.sizes.*field.value > 0; });
  return is_whole ? body.sizes : AverageSizes(kAverageStature_mm);
}

}  // namespace

RestBody::RestBody(const BodyRecord& body) : table_(TableOf(body)), sizes_(SizesOf(body)) {
  places_T_ = ReferencePoints(sizes_, table_.placement);
  R_rest_ = HipAxes(places_T_.leftCols<kPointCount>());
}

Matrix3 RestBody::PelvisRotation(const PoseRow& row) const {
  return HipAxes(row.points_W) * R_rest_.transpose();
}

}  // namespace mocap
