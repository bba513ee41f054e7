// What holds for every camera driver, whatever is behind it.
//
// A driver joins with a type that makes one, and
//   INSTANTIATE_TYPED_TEST_SUITE_P(MyDriver, CameraDriverSuite, MyFactory);
//
//   struct MyFactory {
//     static constexpr bool kEnds = …;       // whether it comes to an end by itself
//     std::string WhySkip();                 // "" when the driver can be tested on this machine
//     std::unique_ptr<CameraDriver> Make();  // a driver that was not started; each has its own
//     state
//   };
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>

#include "drivers/camera_driver.h"
#include "tests/support/images.h"

namespace mocap::testing {

template <typename Factory>
class CameraDriverSuite : public ::testing::Test {
 protected:
  static constexpr std::chrono::milliseconds kTimeout{1000};
  static constexpr int kTries = 20;
  static constexpr int kMostFrames = 10000;
  static constexpr int kFramesWithoutEnd = 30;

  void SetUp() override {
    if (const std::string reason = factory_.WhySkip(); !reason.empty()) GTEST_SKIP() << reason;
    driver_ = factory_.Make();
  }

  // Sits out what weather there may be.
  static GrabStatus GrabNext(CameraDriver& driver, Frame& frame) {
    GrabStatus status = GrabStatus::kTimeout;
    for (int i = 0; i < kTries && status != GrabStatus::kFrame && status != GrabStatus::kEnd; ++i) {
      status = driver.Grab(frame, kTimeout);
    }
    return status;
  }

  Factory factory_;
  std::unique_ptr<CameraDriver> driver_;
};

TYPED_TEST_SUITE_P(CameraDriverSuite);

TYPED_TEST_P(CameraDriverSuite, TimesAndSequenceIncrease) {
  this->driver_->Start();
  Frame before, frame;
  ASSERT_EQ(this->GrabNext(*this->driver_, before), GrabStatus::kFrame);
  for (int i = 0; i < 8; ++i) {
    ASSERT_EQ(this->GrabNext(*this->driver_, frame), GrabStatus::kFrame);
    EXPECT_GT(frame.capture_ns, before.capture_ns);
    EXPECT_GT(frame.sequence, before.sequence);
    before = frame;
  }
}

TYPED_TEST_P(CameraDriverSuite, AllFramesHaveOneSize) {
  this->driver_->Start();
  Frame first, frame;
  ASSERT_EQ(this->GrabNext(*this->driver_, first), GrabStatus::kFrame);
  const int width = first.image.width(), height = first.image.height();
  EXPECT_GT(width, 0);
  EXPECT_GT(height, 0);
  for (int i = 0; i < 4; ++i) {
    ASSERT_EQ(this->GrabNext(*this->driver_, frame), GrabStatus::kFrame);
    EXPECT_EQ(frame.image.width(), width);
    EXPECT_EQ(frame.image.height(), height);
  }
}

TYPED_TEST_P(CameraDriverSuite, PixelsStayUntilTheNextGrab) {
  this->driver_->Start();
  Frame frame;
  ASSERT_EQ(this->GrabNext(*this->driver_, frame), GrabStatus::kFrame);
  const Image<Bgr> copy = CopyOf(frame.image);
  {
    const std::unique_ptr<CameraDriver> other = this->factory_.Make();
    other->Start();
    Frame others;
    for (int i = 0; i < 3; ++i) this->GrabNext(*other, others);
  }
  EXPECT_TRUE(SamePixels<Bgr>(frame.image, copy.view()));
}

TYPED_TEST_P(CameraDriverSuite, EndIsFinalWhereThereIsOne) {
  this->driver_->Start();
  Frame frame;
  int frames = 0;
  const int enough = TypeParam::kEnds ? this->kMostFrames : this->kFramesWithoutEnd;
  while (frames < enough && this->GrabNext(*this->driver_, frame) == GrabStatus::kFrame) ++frames;
  EXPECT_GT(frames, 0);
  if (!TypeParam::kEnds) {
    EXPECT_EQ(frames, enough);
    return;
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(this->driver_->Grab(frame, this->kTimeout), GrabStatus::kEnd);
  }
}

TYPED_TEST_P(CameraDriverSuite, StartsAgainAfterStop) {
  for (int round = 0; round < 3; ++round) {
    this->driver_->Start();
    Frame before, frame;
    ASSERT_EQ(this->GrabNext(*this->driver_, before), GrabStatus::kFrame);
    ASSERT_EQ(this->GrabNext(*this->driver_, frame), GrabStatus::kFrame);
    EXPECT_GT(frame.capture_ns, before.capture_ns);
    this->driver_->Stop();
  }
}

TYPED_TEST_P(CameraDriverSuite, StopsWithoutStart) {
  this->driver_->Stop();
  this->driver_->Start();
  Frame frame;
  EXPECT_EQ(this->GrabNext(*this->driver_, frame), GrabStatus::kFrame);
  this->driver_->Stop();
  this->driver_->Stop();
}

REGISTER_TYPED_TEST_SUITE_P(CameraDriverSuite, TimesAndSequenceIncrease, AllFramesHaveOneSize,
                            PixelsStayUntilTheNextGrab, EndIsFinalWhereThereIsOne,
                            StartsAgainAfterStop, StopsWithoutStart);

}  // namespace mocap::testing
