#include "drivers/virtual_studio/rendering/lamps.h"

#include <algorithm>

namespace mocap::simulation {
namespace {

// Hides the cells whose middle is in a triangle.
void HideTriangle(const FloorCells& cells, const std::array<Eigen::Vector2f, 3>& corners,
                  std::uint16_t bit, HiddenCells& hidden) {
  const auto& [a, b, c] = corners;
  // Either half of the closed surface casts the same shadow.
  const float area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  if (area <= 0) return;
  const int low_x = std::max(0, static_cast<int>(std::min({a.x(), b.x(), c.x()})));
  const int low_y = std::max(0, static_cast<int>(std::min({a.y(), b.y(), c.y()})));
  const int high_x = std::min(cells.columns - 1, static_cast<int>(std::max({a.x(), b.x(), c.x()})));
  const int high_y = std::min(cells.rows - 1, static_cast<int>(std::max({a.y(), b.y(), c.y()})));
  if (low_x > high_x || low_y > high_y) return;
  // Twice the areas opposite the corners, linear in x.
  const auto side = [](const Eigen::Vector2f& p, const Eigen::Vector2f& q, float x, float y) {
    return (q.x() - p.x()) * (y - p.y()) - (q.y() - p.y()) * (x - p.x());
  };
  const float step_a = b.y() - c.y(), step_b = c.y() - a.y(), step_c = a.y() - b.y();
  bool any = false;
  for (int y = low_y; y <= high_y; ++y) {
    const float mx = float(low_x) + 0.5f, my = float(y) + 0.5f;
    float at_a = side(b, c, mx, my), at_b = side(c, a, mx, my), at_c = side(a, b, mx, my);
    std::uint16_t* row = &hidden.from[y * cells.columns];
    for (int x = low_x; x <= high_x; ++x, at_a += step_a, at_b += step_b, at_c += step_c) {
      if (std::min({at_a, at_b, at_c}) < 0) continue;
      row[x] |= bit;
      any = true;
    }
  }
  if (!any) return;
  hidden.x0 = std::min(hidden.x0, low_x), hidden.y0 = std::min(hidden.y0, low_y);
  hidden.x1 = std::max(hidden.x1, high_x), hidden.y1 = std::max(hidden.y1, high_y);
}

}  // namespace

void Hide(const FloorCells& cells, const Eigen::Vector3f& lamp_W, std::uint16_t bit,
          const PersonMesh& mesh, const std::vector<Eigen::Vector3f>& p_W, HiddenCells& hidden) {
  hidden.projected.resize(mesh.coarse_vertices.size());
  for (std::size_t i = 0; i < mesh.coarse_vertices.size(); ++i) {
    const Eigen::Vector3f& p = p_W[mesh.coarse_vertices[i]];
    const float t = lamp_W.z() / (lamp_W.z() - std::min(p.z(), lamp_W.z() - 300));
    hidden.projected[i] =
        (lamp_W.head<2>() + t * (p.head<2>() - lamp_W.head<2>()) + cells.corner_mm) / cells.cell_mm;
  }
  const auto is_beyond = [&](std::uint16_t i) {
    return p_W[mesh.coarse_vertices[i]].x() > cells.from_x_W;
  };
  for (const auto& triangle : mesh.coarse_triangles) {
    if (!std::ranges::all_of(triangle, is_beyond)) continue;
    HideTriangle(cells,
                 {hidden.projected[triangle[0]], hidden.projected[triangle[1]],
                  hidden.projected[triangle[2]]},
                 bit, hidden);
  }
}

}  // namespace mocap::simulation
