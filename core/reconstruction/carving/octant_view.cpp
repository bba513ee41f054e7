#include "core/reconstruction/carving/octant_view.h"

#include <bit>

#include "core/reconstruction/carving/sample_bits.h"

namespace mocap {
namespace {

// The lowest bit of each byte.
constexpr std::uint64_t kEach = 0x0101010101010101;

OctantDecisions Unpack(kernels::OctantBits bits) {
  return {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8),
          static_cast<std::uint8_t>(bits >> 16), static_cast<std::uint8_t>(bits >> 24)};
}

}  // namespace

void OctantView::Set(const CarvingView& view, const Vector3& origin_W, const WindowMap& windows) {
  const Vector3 p = view.X_CW * origin_W;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      camera_.R[row][column] = static_cast<float>(view.X_CW.R(row, column));
    camera_.p[row] = static_cast<float>(p[row]);
  }
  camera_.table = view.table->nodes();
  camera_.planes = windows.planes();
}

OctantDecisions OctantView::Project(const Eigen::Vector3f& middle, float spread, float half,
                                    OctantFrames& frames, std::uint8_t& framed) const {
  const std::uint32_t bits =
      kernels::ProjectOctants(camera_, {middle.x(), middle.y(), middle.z()}, spread, half, frames);
  framed = 0;
  for (int i = 0; i < OctantFrames::kLanes; ++i)
    if (frames.error[i] < kGoodFrame_px) framed |= static_cast<std::uint8_t>(1 << i);
  return Unpack(bits);
}

OctantDecisions OctantView::JudgeByFrame(const OctantFrames& frames, int lane,
                                         const Eigen::Vector3f& middle, float spread,
                                         float half) const {
  return Unpack(kernels::JudgeOctants(camera_.planes, frames, lane,
                                      {middle.x(), middle.y(), middle.z()}, spread, half));
}

SampleDecisions OctantView::JudgeSamplesByFrame(const OctantFrames& frames, int lane,
                                                const Eigen::Vector3f& middle, float voxel_spread,
                                                float sample_spread, std::uint8_t asked) const {
  const std::array<float, 3> p = {middle.x(), middle.y(), middle.z()};
  SampleDecisions decisions;
  if (kernels::JudgeSamples(camera_.planes, frames, lane, p, voxel_spread, sample_spread, asked,
                            decisions))
    return decisions;
  const OctantDecisions voxels =
      Unpack(kernels::JudgeOctants(camera_.planes, frames, lane, p, voxel_spread, sample_spread));
  decisions = {kEach * voxels.inside, kEach * voxels.outside, kEach * voxels.unseen, 0};
  unsigned open = asked & ~(voxels.inside | voxels.outside | voxels.unseen);
  for (; open != 0; open &= open - 1) {
    const int voxel = std::countr_zero(open);
    const OctantDecisions samples =
        Unpack(kernels::JudgeOctants(camera_.planes, frames, lane,
                                     {p[0] + kernels::kOctantX[voxel] * voxel_spread,
                                      p[1] + kernels::kOctantY[voxel] * voxel_spread,
                                      p[2] + kernels::kOctantZ[voxel] * voxel_spread},
                                     sample_spread, 0));
    decisions.inside |= SpreadBits(samples.inside) << voxel;
    decisions.outside |= SpreadBits(samples.outside) << voxel;
    decisions.unseen |= SpreadBits(samples.unseen) << voxel;
    decisions.unknown |= SpreadBits(samples.unknown) << voxel;
  }
  return decisions;
}

}  // namespace mocap
