#include "core/kernels/contacts.h"

#include <algorithm>
#include <cmath>

#include "core/kernels/contacts_reference.h"
#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

class ContactKernels : public ::testing::Test {
 protected:
  static constexpr int kBlocks = 60, kCapsules = 19;

  ContactKernels() {
    Numbers numbers(5);
    const auto vector = [&](float size) {
      const std::vector<float> some = numbers.Floats(3, -size, size);
      return std::array<float, 3>{some[0], some[1], some[2]};
    };
    for (int i = 0; i < kCapsules; ++i) {
      SlimCapsule capsule;
      capsule.a = vector(700);
      capsule.core = i % 6 == 0 ? std::array<float, 3>{} : vector(200);
      for (int axis = 0; axis < 3; ++axis)
        capsule.middle[axis] = capsule.a[axis] + capsule.core[axis] / 2;
      capsule.core_sq = std::max(reference::Dot(capsule.core, capsule.core), 1e-3f);
      capsule.per_core_sq = 1 / capsule.core_sq;
      capsule.radius = 40 + static_cast<float>(i), capsule.taper = static_cast<float>(i % 3) * 7;
      capsule.reach = std::sqrt(capsule.core_sq) / 2 + 80;
      for (int axis = 0; axis < 3; ++axis) {
        const float b = capsule.a[axis] + capsule.core[axis];
        boxes_.low[axis][i] = std::min(capsule.a[axis], b) - 80;
        boxes_.high[axis][i] = std::max(capsule.a[axis], b) + 80;
      }
      // The same capsule twice: the lower index wins.
      if (i % 5 == 4) capsule = capsules_.back();
      capsules_.push_back(capsule);
    }
    for (int b = 0; b < kBlocks; ++b) {
      ContactBlock block;
      const std::array<float, 3> middle = vector(700);
      for (int i = 0; i < ContactBlock::kContacts; ++i) {
        const std::array<float, 3> from = vector(60), outward = vector(0.6f);
        const std::array<float, 3> along = i % 2 == 0 ? std::array<float, 3>{} : vector(90);
        for (int axis = 0; axis < 3; ++axis) {
          block.from[axis][i] = middle[axis] + from[axis];
          block.along[axis][i] = along[axis], block.outward[axis][i] = outward[axis];
        }
        block.along_sq[i] = std::max(reference::Dot(along, along), 1e-3f);
        block.per_along_sq[i] = 1 / block.along_sq[i];
      }
      for (int axis = 0; axis < 3; ++axis)
        block.low[axis] = middle[axis] - 150, block.high[axis] = middle[axis] + 150;
      block.favourites = b % 3 == 0 ? 1u << b % kCapsules : 0;
      blocks_.push_back(block);
    }
    for (int b = 0; b < kBlocks; ++b)
      for (int i = 0; i < kCapsules; ++i) trials_.push_back({b, (i * 7) % kCapsules});
  }

  std::vector<BestCapsules> NoBest() const {
    BestCapsules best;
    best.mismatch.fill(250), best.distance.fill(250), best.capsule.fill(-1);
    return std::vector<BestCapsules>(kBlocks, best);
  }
  template <typename Try>
  std::vector<BestCapsules> Best(const Try& try_all) const {
    std::vector<BestCapsules> bests = NoBest();
    try_all(trials_.data(), static_cast<int>(trials_.size()), blocks_.data(), capsules_.data(),
            bests.data());
    return bests;
  }
  template <typename List>
  std::vector<std::int32_t> Near(const List& list, const std::vector<BestCapsules>& bests) const {
    std::vector<CapsuleTrial> trials(kBlocks * kMostCapsules + 1);
    trials.resize(
        static_cast<std::size_t>(list(3, kBlocks, blocks_.data(), capsules_.data(), boxes_,
                                      (1u << kCapsules) - 1, bests.data(), trials.data())));
    std::vector<std::int32_t> numbers;
    for (const auto& [block, capsule] : trials) numbers.insert(numbers.end(), {block, capsule});
    return numbers;
  }

  std::vector<SlimCapsule> capsules_;
  CapsuleBoxes boxes_;
  std::vector<ContactBlock> blocks_;
  std::vector<CapsuleTrial> trials_;
};

TEST_F(ContactKernels, CapsulesAreComparedContactByContact) {
  const auto numbers_of = [](const std::vector<BestCapsules>& bests) {
    std::vector<float> numbers;
    for (const BestCapsules& best : bests) {
      numbers.insert(numbers.end(), best.mismatch.begin(), best.mismatch.end());
      numbers.insert(numbers.end(), best.distance.begin(), best.distance.end());
      numbers.insert(numbers.end(), best.capsule.begin(), best.capsule.end());
    }
    return numbers;
  };
  ExpectSameBits([&] { return numbers_of(Best(reference::TryCapsules)); },
                 [&] { return numbers_of(Best(TryCapsules)); });
}

TEST_F(ContactKernels, NearCapsulesAreListedContactByContact) {
  for (const auto& bests : {NoBest(), Best(reference::TryCapsules)}) {
    ExpectSameBits([&] { return Near(reference::ListNearCapsules, bests); },
                   [&] { return Near(ListNearCapsules, bests); });
  }
}

}  // namespace
}  // namespace mocap::kernels
