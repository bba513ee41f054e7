#include "core/reconstruction/carving/floor_shadows.h"

#include <algorithm>
#include <optional>

#include "core/reconstruction/carving/other_views.h"
#include "core/reconstruction/silhouette/bit_filters.h"

namespace mocap {
namespace {

constexpr int kTile_px = Shading::kTile_px;
// Floor farther away than this from a camera does not belong to the studio.
constexpr double kFarthestMm = 12'000;
// A place with less than this share of the shade is bright.
constexpr float kAlike = 0.4f;
constexpr int kBrightWanted = 2;
// Half the width of parts that are too thin to be more than a rim.
constexpr int kThin_px = 2;
// Number of the eight tiles around one.
constexpr int kNeighboursWanted = 3;
constexpr int kRounds = 2;
// Smaller holes are filled. Blobs with a smaller share of the picture are dropped.
constexpr int kSmallestHole_px = 20;
constexpr double kSmallestBlobShare = 0.0005;

int TilesAlong(int pixels) { return (pixels + kTile_px - 1) / kTile_px; }

std::vector<Vector3> TileDirections(const CameraCalibration& camera) {
  std::vector<Vector3> directions;
  for (int row = 0; row < TilesAlong(camera.height_px); ++row) {
    for (int column = 0; column < TilesAlong(camera.width_px); ++column) {
      const Vector2 middle = Vector2(column + 0.5, row + 0.5) * kTile_px - Vector2(0.5, 0.5);
      const std::optional<Vector2> place = NormalizedFromPixel(camera.lens, middle);
      directions.push_back(place ? Vector3(place->x(), place->y(), 1) : Vector3::Zero());
    }
  }
  return directions;
}

// Intersects a ray from a camera with the floor.
std::optional<Vector3> OnFloor(const RigidTransform& X_WC, const Vector3& direction_C) {
  const Vector3 direction_W = X_WC.R * direction_C;
  if (!(direction_W.z() < 0)) return std::nullopt;
  const double depth_mm = -X_WC.p.z() / direction_W.z();
  if (!(depth_mm > 0 && depth_mm < kFarthestMm)) return std::nullopt;
  return X_WC.p + depth_mm * direction_W;
}

// Shade of a place in a camera; empty if somebody may hide it.
std::optional<Shading::Shade> ShadeOf(const ShadedView& view, const Silhouette& people,
                                      const Vector3& place_W) {
  const Vector3 place_C = view.X_CW * place_W;
  if (place_C.z() <= 0) return std::nullopt;
  const SensorPlaneTable::Pixel pixel =
      view.table->Lookup(place_C.x() / place_C.z(), place_C.y() / place_C.z());
  if (pixel.x < 0) return std::nullopt;
  const int column = pixel.x / kTile_px, row = pixel.y / kTile_px;
  const Shading& shading = *view.shading;
  const Shading::Shade shade =
      shading.shades[static_cast<std::size_t>(row) * shading.tile_columns + column];
  if (people.Test(column, row) || shade == Shading::kUnknown) return std::nullopt;
  return shade;
}

// Counts the tiles around one that are set.
int CountAround(const Silhouette& tiles, const Shading::DarkTile& tile) {
  int count = 0;
  for (int row = std::max(tile.row - 1, 0); row <= std::min(tile.row + 1, tiles.height() - 1);
       ++row)
    for (int column = std::max(tile.column - 1, 0);
         column <= std::min(tile.column + 1, tiles.width() - 1); ++column)
      count += tiles.Test(column, row);
  return count;
}

}  // namespace

FloorShadows::FloorShadows(std::span<const CameraCalibration> cameras) {
  for (const CameraCalibration& camera : cameras) directions_C_.push_back(TileDirections(camera));
}

void FloorShadows::Complete(std::span<ShadedView> views) {
  FindPeople(views);
  for (std::size_t i = 0; i < views.size(); ++i) {
    Gather(views, i);
    Trimap& trimap = *views[i].trimap;
    const bool has_clothes = AddClothes(views[i].shading->dark, trimap);
    const bool has_shadows = DropShadows(*views[i].shading, trimap.unknown);
    views[i].has_changed = has_clothes || has_shadows;
  }
}

bool FloorShadows::AddClothes(const Silhouette& dark, Trimap& trimap) {
  if (!added_.BoundingBox()) return false;
  Open();
  if (!opened_.BoundingBox()) return false;
  Silhouette& person = trimap.person;
  Unite(opened_, person);
  cleaner_.Clean(kSmallestHole_px, dark,
                 static_cast<int>(kSmallestBlobShare * person.width() * person.height()), person);
  person.KeepBox();
  Subtract(person, trimap.unknown);
  trimap.unknown.KeepBox();
  return true;
}

// Shadows fade out in the tiles around, except where the camera does not know the floor.
bool FloorShadows::DropShadows(const Shading& shading, Silhouette& unknown) {
  const std::optional<PixelBox> box = unknown.BoundingBox();
  if (!box || !shadows_.BoundingBox()) return false;
  Dilate(shadows_, 1, scratch_);
  std::uint64_t dropped = 0;
  for (int y = box->top; y <= box->bottom; ++y) {
    std::uint64_t* const row = unknown.row(y);
    const Shading::Shade* const shades =
        &shading.shades[static_cast<std::size_t>(y / kTile_px) * shading.tile_columns];
    for (int column = box->left / kTile_px; column <= box->right / kTile_px; ++column) {
      if (!scratch_.Test(column, y / kTile_px) || shades[column] == Shading::kUnknown) continue;
      const std::uint64_t tile = std::uint64_t{0xff} << column % 8 * 8;
      dropped |= row[column / 8] & tile;
      row[column / 8] &= ~tile;
    }
  }
  unknown.KeepBox();
  return dropped != 0;
}

void FloorShadows::FindPeople(std::span<const ShadedView> views) {
  people_.resize(std::max(people_.size(), views.size()));
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Silhouette& silhouette = views[i].trimap->person;
    scratch_.Reset(TilesAlong(silhouette.width()), TilesAlong(silhouette.height()));
    const PixelBox box = silhouette.BoundingBox().value_or(PixelBox{0, 0, -1, -1});
    for (int y = box.top; y <= box.bottom; ++y) {
      const std::uint64_t* const row = silhouette.row(y);
      for (int tile = box.left / kTile_px; tile <= box.right / kTile_px; ++tile)
        if (row[tile / 8] >> tile % 8 * 8 & 0xff) scratch_.Set(tile, y / kTile_px);
    }
    Dilate(scratch_, 1, people_[i]);
  }
}

// Collects the dark pixels of clothes in a view.
void FloorShadows::Gather(std::span<const ShadedView> views, std::size_t view) {
  const Shading& shading = *views[view].shading;
  Vote(views, view);
  added_.Reset(shading.dark.width(), shading.dark.height());
  for (const Shading::DarkTile& tile : shading.dark_tiles) {
    if (!clothes_.Test(tile.column, tile.row)) continue;
    const std::uint64_t mask = std::uint64_t{0xff} << tile.column % 8 * 8;
    const int top = tile.row * kTile_px;
    for (int y = top; y < std::min(top + kTile_px, added_.height()); ++y)
      added_.row(y)[tile.column / 8] |= shading.dark.row(y)[tile.column / 8] & mask;
  }
}

// Decides on a view's dark tiles. Tiles that the other cameras do not decide follow their
// neighbours.
void FloorShadows::Vote(std::span<const ShadedView> views, std::size_t view) {
  const Shading& shading = *views[view].shading;
  for (Silhouette* const tiles : {&clothes_, &shadows_})
    tiles->Reset(people_[view].width(), people_[view].height());
  undecided_.clear();
  const RigidTransform X_WC = views[view].X_CW.Inverse();
  const Vector3* const directions_C =
      directions_C_[static_cast<std::size_t>(views[view].camera)].data();
  for (const Shading::DarkTile& tile : shading.dark_tiles) {
    const auto place_W = OnFloor(X_WC, directions_C[tile.row * shading.tile_columns + tile.column]);
    if (!place_W) continue;
    switch (Judge(views, view, *place_W, tile.shade)) {
      case Cause::kClothes:
        clothes_.Set(tile.column, tile.row);
        break;
      case Cause::kShadow:
        shadows_.Set(tile.column, tile.row);
        break;
      case Cause::kUnknown:
        undecided_.push_back(tile);
    }
  }
  for (int round = 0; round < kRounds; ++round) {
    joining_.clear();
    for (const Shading::DarkTile& tile : undecided_) {
      const int clothes = CountAround(clothes_, tile);
      if (clothes >= kNeighboursWanted && clothes > CountAround(shadows_, tile))
        joining_.push_back(tile);
    }
    for (const Shading::DarkTile& tile : joining_) clothes_.Set(tile.column, tile.row);
  }
}

// Tests how bright the other cameras see the floor at a dark tile.
FloorShadows::Cause FloorShadows::Judge(std::span<const ShadedView> views, std::size_t view,
                                        const Vector3& place_W, Shading::Shade shade) const {
  int bright = 0, dark = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!IsOther(i, view, views.size())) continue;
    const std::optional<Shading::Shade> other = ShadeOf(views[i], people_[i], place_W);
    if (other) ++(static_cast<float>(*other) > kAlike * static_cast<float>(shade) ? bright : dark);
  }
  if (bright >= kBrightWanted && bright > dark) return Cause::kClothes;
  return dark > 0 ? Cause::kShadow : Cause::kUnknown;
}

// Removes thin parts.
void FloorShadows::Open() {
  Erode(added_, kThin_px, scratch_);
  Dilate(scratch_, kThin_px, opened_);
  Intersect(added_, opened_);
}

}  // namespace mocap
