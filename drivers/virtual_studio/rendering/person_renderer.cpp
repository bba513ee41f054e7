#include "drivers/virtual_studio/rendering/person_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace mocap::simulation {
namespace {

using Vector3f = Eigen::Vector3f;

constexpr int kShrinkSteps = 4096;
constexpr float kShrinkMax = 1.5f;  // κ1 ru² far outside any picture.
constexpr float kNearest_mm = 150;

// Two soft lamps, and ambient light that is stronger from above.
const Vector3f kLampA = Vector3f(-0.45f, -0.35f, 0.82f).normalized();
const Vector3f kLampB = Vector3f(0.55f, 0.30f, 0.78f).normalized();

float Shade(const Vector3f& n_W) {
  const float inverse = 1 / std::sqrt(n_W.squaredNorm() + 1e-12f);
  const float a = std::max(0.0f, n_W.dot(kLampA)) * inverse;
  const float b = std::max(0.0f, n_W.dot(kLampB)) * inverse;
  return 0.42f + 0.14f * n_W.z() * inverse + 0.34f * a + 0.26f * b;
}

bool IsCloth(Material material) { return material != kSkin && material != kHair; }

bool IsHidden(Material material, HiddenClothes hidden) {
  const bool is_shirt = material == kShirt || material == kStripe;
  return (hidden == HiddenClothes::kShirts && is_shirt) ||
         (hidden == HiddenClothes::kTrousers && material == kTrousers);
}

std::uint8_t Byte(float v) { return static_cast<std::uint8_t>(std::min(v + 0.5f, 255.0f)); }

// Rounds up without calling the library's function.
int Ceil(float v) {
  const int whole = static_cast<int>(v);
  return whole + (float(whole) < v ? 1 : 0);
}

// Pixels that are skipped together.
constexpr int kBytes = 8;
constexpr int kPlacesTogether = 32;

// Sets the highest bit of each of eight bytes that is not zero.
std::uint64_t FlagsOf(const std::uint8_t* bytes) {
  constexpr std::uint64_t kLowBits = 0x7f7f7f7f7f7f7f7f;
  std::uint64_t word;
  std::memcpy(&word, bytes, kBytes);
  return (((word & kLowBits) + kLowBits) | word) & ~kLowBits;
}

// Figures visible in each of eight pixels.
std::uint64_t WhoOf(const std::uint8_t* pixels) {
  std::uint64_t word;
  std::memcpy(&word, pixels, kBytes);
  return word & FigurePixel::kWhoOfEight;
}

}  // namespace

PersonRenderer::PersonRenderer(const CameraCalibration& camera, const FigureStyle& style)
    : width_px_(camera.width_px),
      height_px_(camera.height_px),
      hidden_(style.hidden),
      lens_(std::get<TsaiLens>(camera.lens)),
      fx_(static_cast<float>(lens_.focal_mm * lens_.sx / lens_.pitch_mm.x())),
      fy_(static_cast<float>(lens_.focal_mm / lens_.pitch_mm.y())),
      cx_(static_cast<float>(lens_.center_px.x())),
      cy_(static_cast<float>(lens_.center_px.y())),
      kappa_(static_cast<float>(lens_.kappa1 * lens_.focal_mm * lens_.focal_mm)),
      nearness_(width_px_, height_px_),
      shades_(width_px_, height_px_),
      figures_(width_px_, height_px_) {
  if (style.contrast > 0) low_contrast_.emplace(style.contrast);
  if (style.soft_shadows) soft_shadows_.emplace(camera);
  // g = rd / ru solves g (1 + q g²) = 1 with q = κ1 ru²: Newton's method from above.
  shrink_.reserve(kShrinkSteps + 2);
  double g = 1;
  for (int i = 0; i <= kShrinkSteps + 1; ++i) {
    const double q = kShrinkMax * i / kShrinkSteps;
    for (int k = 0; k < 20; ++k) g -= (g + q * g * g * g - 1) / (1 + 3 * q * g * g);
    shrink_.push_back(static_cast<float>(g));
  }
}

bool PersonRenderer::ToScreen(const Vector3f& p_C, float& x, float& y) const {
  if (p_C.z() < kNearest_mm) return false;
  const float xn = p_C.x() / p_C.z(), yn = p_C.y() / p_C.z();
  const float q = kappa_ * (xn * xn + yn * yn) * (kShrinkSteps / kShrinkMax);
  if (q >= kShrinkSteps) return false;
  const int i = static_cast<int>(q);
  const float g = shrink_[i] + (q - float(i)) * (shrink_[i + 1] - shrink_[i]);
  x = fx_ * g * xn + cx_;
  y = fy_ * g * yn + cy_;
  return true;
}

PixelBox PersonRenderer::Project(const PersonMesh& mesh, const Skin& skin,
                                 const RigidTransform& X_CW,
                                 std::vector<ScreenVertex>& screen) const {
  const Eigen::Matrix3f R_CW = X_CW.R.cast<float>();
  const Vector3f p_CW = X_CW.p.cast<float>();
  screen.resize(skin.p_W.size());
  float low_x = float(width_px_), low_y = float(height_px_), high_x = -1, high_y = -1;
  for (std::size_t i = 0; i < skin.p_W.size(); ++i) {
    const Vector3f p_C = R_CW * skin.p_W[i] + p_CW;
    ScreenVertex& v = screen[i];
    if (!ToScreen(p_C, v.x, v.y)) {
      v.nearness = 0;
      continue;
    }
    v.nearness = 1 / p_C.z();
    v.shade = Shade(skin.n_W[i]) * mesh.vertices[i].albedo;
    low_x = std::min(low_x, v.x), high_x = std::max(high_x, v.x);
    low_y = std::min(low_y, v.y), high_y = std::max(high_y, v.y);
  }
  // One more pixel on each side for softened edges.
  if (high_x < 0 || high_y < 0 || low_x >= float(width_px_) || low_y >= float(height_px_))
    return {};
  return {std::max(0, static_cast<int>(low_x) - 1), std::max(0, static_cast<int>(low_y) - 1),
          static_cast<int>(std::min(high_x + 3, float(width_px_))),
          static_cast<int>(std::min(high_y + 3, float(height_px_)))};
}

void PersonRenderer::Draw(std::span<const Figure> figures, std::span<const BonePoses> poses,
                          const EmptyView& view, const RigidTransform& X_CW, bool same_view,
                          Image<Bgr>& canvas) {
  if (same_view) {
    for (int y = dirty_.y0; y < dirty_.y1; ++y)
      std::copy_n(view.image.row(y) + dirty_.x0, dirty_.x1 - dirty_.x0, canvas.row(y) + dirty_.x0);
  } else {
    canvas = view.image;
    if (low_contrast_) low_contrast_->SetView(view.image);
    if (soft_shadows_) soft_shadows_->SetView(view, X_CW);
  }
  for (int y = people_.y0; y < people_.y1; ++y)
    std::fill_n(figures_.row(y) + people_.x0, people_.x1 - people_.x0, std::uint8_t{0});
  dirty_ = {};

  skins_.resize(figures.size());
  screens_.resize(figures.size());
  people_ = {};
  for (std::size_t i = 0; i < figures.size(); ++i) {
    SkinMesh(figures[i].mesh, poses[i], skins_[i].p_W, skins_[i].n_W);
    people_.Include(Project(figures[i].mesh, skins_[i], X_CW, screens_[i]));
  }
  soft_shadows_ ? DrawSoftShadows(figures, canvas) : DrawShadow(figures, view, X_CW, canvas);
  if (people_.empty()) return;
  for (int y = people_.y0; y < people_.y1; ++y)
    std::copy_n(view.nearness.row(y) + people_.x0, people_.x1 - people_.x0,
                nearness_.row(y) + people_.x0);
  for (std::size_t i = 0; i < figures.size(); ++i)
    for (const PersonMesh::Triangle& t : figures[i].mesh.triangles)
      DrawTriangle(screens_[i][t.v[0]], screens_[i][t.v[1]], screens_[i][t.v[2]],
                   FigurePixel::Of(i, t.material));
  Compose(figures, view.image, canvas);
  SoftenEdges(canvas);
  dirty_.Include(people_);
}

void PersonRenderer::DrawSoftShadows(std::span<const Figure> figures, Image<Bgr>& canvas) {
  soft_shadows_->Clear();
  for (std::size_t i = 0; i < figures.size(); ++i)
    soft_shadows_->Cast(figures[i].mesh, skins_[i].p_W);
  dirty_.Include(soft_shadows_->Darken(canvas));
}

void PersonRenderer::DrawShadow(std::span<const Figure> figures, const EmptyView& view,
                                const RigidTransform& X_CW, Image<Bgr>& canvas) {
  shadow_.Clear();
  for (std::size_t i = 0; i < figures.size(); ++i) shadow_.Cast(figures[i].mesh, skins_[i].p_W);
  shadow_.Blur();
  Eigen::Vector2f low, high;
  if (!shadow_.Bounds(low, high)) return;
  const Eigen::Matrix3f R_CW = X_CW.R.cast<float>();
  const Vector3f p_CW = X_CW.p.cast<float>();
  // The image of the rim bounds that of the rectangle. If the lens does not see the whole rim, use
  // the whole picture.
  PixelBox box{0, 0, width_px_, height_px_};
  float low_x = 1e9f, low_y = 1e9f, high_x = -1e9f, high_y = -1e9f;
  bool seen = true;
  constexpr int kSteps = 8;
  for (int i = 0; i <= kSteps && seen; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      if (i % kSteps != 0 && j % kSteps != 0) continue;
      const Vector3f p_W(low.x() + (high.x() - low.x()) * float(i) / kSteps,
                         low.y() + (high.y() - low.y()) * float(j) / kSteps, 0);
      float x = 0, y = 0;
      seen = seen && ToScreen(R_CW * p_W + p_CW, x, y);
      low_x = std::min(low_x, x), high_x = std::max(high_x, x);
      low_y = std::min(low_y, y), high_y = std::max(high_y, y);
    }
  if (seen)
    box = {std::max(0, static_cast<int>(low_x) - 2), std::max(0, static_cast<int>(low_y) - 2),
           std::min(width_px_, static_cast<int>(std::min(high_x, 1e5f)) + 3),
           std::min(height_px_, static_cast<int>(std::min(high_y, 1e5f)) + 3)};
  if (box.empty()) return;

  for (int y = box.y0; y < box.y1; ++y)
    for (int x = box.x0; x < box.x1; x += kPlacesTogether)
      Darken(
          {view.floor.row(y) + x, static_cast<std::size_t>(std::min(kPlacesTogether, box.x1 - x))},
          canvas.row(y) + x);
  dirty_.Include(box);
}

void PersonRenderer::Darken(std::span<const FloorPlace> floor, Bgr* pixels) const {
  if (!shadow_.MayFallOn(floor)) return;
  for (std::size_t i = 0; i < floor.size(); ++i) {
    const int light = shadow_.LightAt(floor[i]);
    if (light == 256) continue;
    Bgr& pixel = pixels[i];
    pixel = {static_cast<std::uint8_t>((pixel.b * light) >> 8),
             static_cast<std::uint8_t>((pixel.g * light) >> 8),
             static_cast<std::uint8_t>((pixel.r * light) >> 8)};
  }
}

void PersonRenderer::DrawTriangle(const ScreenVertex& a, const ScreenVertex& b,
                                  const ScreenVertex& c, std::uint8_t pixel) {
  if (a.nearness == 0 || b.nearness == 0 || c.nearness == 0) return;
  // Counter-clockwise seen from outside is clockwise in a picture, where y points down.
  const float area = (c.x - a.x) * (b.y - a.y) - (b.x - a.x) * (c.y - a.y);
  if (area <= 0) return;
  const int x0 = std::max(people_.x0, Ceil(std::min({a.x, b.x, c.x})));
  const int y0 = std::max(people_.y0, Ceil(std::min({a.y, b.y, c.y})));
  const int x1 = std::min(people_.x1 - 1, static_cast<int>(std::max({a.x, b.x, c.x})));
  const int y1 = std::min(people_.y1 - 1, static_cast<int>(std::max({a.y, b.y, c.y})));
  if (x0 > x1 || y0 > y1) return;
  // The barycentric weights of b and c are linear in the picture, and so is 1 / z.
  const float inverse = 1 / area;
  const float vx = -(c.y - a.y) * inverse, vy = (c.x - a.x) * inverse;
  const float wx = (b.y - a.y) * inverse, wy = -(b.x - a.x) * inverse;
  for (int y = y0; y <= y1; ++y) {
    const float dy = float(y) - a.y;
    float v = vx * (float(x0) - a.x) + vy * dy, w = wx * (float(x0) - a.x) + wy * dy;
    float* nearness = nearness_.row(y);
    bool is_within = false;
    for (int x = x0; x <= x1; ++x, v += vx, w += wx) {
      if (v < -1e-5f || w < -1e-5f || v + w > 1.00001f) {
        if (is_within) break;
        continue;
      }
      is_within = true;
      const float near = a.nearness + v * (b.nearness - a.nearness) + w * (c.nearness - a.nearness);
      if (near <= nearness[x]) continue;
      nearness[x] = near;
      shades_(x, y) = a.shade + v * (b.shade - a.shade) + w * (c.shade - a.shade);
      figures_(x, y) = pixel;
    }
  }
}

void PersonRenderer::Compose(std::span<const Figure> figures, const Image<Bgr>& empty,
                             Image<Bgr>& canvas) {
  for (int y = people_.y0; y < people_.y1; ++y)
    for (int x = people_.x0; x < people_.x1; ++x) {
      const std::uint8_t pixel = figures_(x, y);
      if (pixel == 0) {
        while (x + kBytes < people_.x1 && FlagsOf(figures_.row(y) + x + 1) == 0) x += kBytes;
        continue;
      }
      const Material material = FigurePixel::MaterialOf(pixel);
      const float shade = shades_(x, y);
      if (IsHidden(material, hidden_)) {
        canvas(x, y) = empty(x, y);
      } else if (low_contrast_ && IsCloth(material)) {
        canvas(x, y) = low_contrast_->ColorAt(x, y, empty(x, y), shade);
      } else {
        const Bgr color = figures[FigurePixel::FigureOf(pixel)].outfit.colors[material];
        canvas(x, y) = {Byte(float(color.b) * shade), Byte(float(color.g) * shade),
                        Byte(float(color.r) * shade)};
      }
    }
}

// Whether any of eight pixels has a neighbour that shows something else.
bool PersonRenderer::IsOutlineWithin(int x, int y) const {
  const std::uint8_t* const row = figures_.row(y) + x;
  const std::uint64_t here = WhoOf(row);
  return here != WhoOf(row - 1) || here != WhoOf(row + 1) ||
         here != WhoOf(figures_.row(y - 1) + x) || here != WhoOf(figures_.row(y + 1) + x);
}

// Blends both sides of an outline, as a lens does.
void PersonRenderer::SoftenEdges(Image<Bgr>& canvas) {
  soft_.clear();
  const int x1 = std::min(people_.x1, width_px_ - 1), y1 = std::min(people_.y1, height_px_ - 1);
  for (int y = std::max(1, people_.y0); y < y1; ++y)
    for (int x = std::max(1, people_.x0); x < x1; ++x) {
      if (x + kBytes <= x1 && !IsOutlineWithin(x, y)) {
        x += kBytes - 1;
        continue;
      }
      const auto who = [this](int i, int j) { return FigurePixel::FigureOf(figures_(i, j)); };
      const int here = who(x, y);
      if (here == who(x - 1, y) && here == who(x + 1, y) && here == who(x, y - 1) &&
          here == who(x, y + 1))
        continue;
      const Bgr m = canvas(x, y), l = canvas(x - 1, y), r = canvas(x + 1, y), u = canvas(x, y - 1),
                d = canvas(x, y + 1);
      const auto mix = [](int middle, int sum) {
        return static_cast<std::uint8_t>((4 * middle + sum + 4) / 8);
      };
      soft_.push_back({x,
                       y,
                       {mix(m.b, l.b + r.b + u.b + d.b), mix(m.g, l.g + r.g + u.g + d.g),
                        mix(m.r, l.r + r.r + u.r + d.r)}});
    }
  for (const Soft& soft : soft_) canvas(soft.x, soft.y) = soft.color;
}

}  // namespace mocap::simulation
