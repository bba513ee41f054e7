// Capsules and places within a box of 600 mm around the origin, the same in each run.
#pragma once

#include <gtest/gtest.h>

#include <random>

#include "core/body/body_shape.h"

namespace mocap {

class RandomCapsules : public ::testing::Test {
 protected:
  Vector3 Place() { return 300 * Vector3(unit_(random_), unit_(random_), unit_(random_)); }
  PosedCapsule Capsule() {
    return {Place(), Place(), 40 + 20 * unit_(random_), 40 + 20 * unit_(random_)};
  }

 private:
  std::mt19937 random_{11};
  std::uniform_real_distribution<double> unit_{-1, 1};
};

}  // namespace mocap
