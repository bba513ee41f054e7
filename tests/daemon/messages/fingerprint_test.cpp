// Types of messages that clients of older versions decode.
#include <gtest/gtest.h>

#include <cstdint>

#include "daemon/messages/decode_message.h"

namespace mocap {
namespace {

TEST(Fingerprint, NoTypeThatClientsKnowHasChanged) {
  struct KnownType {
    const char* name;
    std::int64_t fingerprint;
    std::uint64_t published;
  };
  for (const KnownType& type : {
           KnownType{"body_t", body_t::getHash(), 0x939e9ca9c25759a6},
           KnownType{"contrast_t", contrast_t::getHash(), 0x1fa1443a9d6a9fae},
           KnownType{"keypoint_senders_t", keypoint_senders_t::getHash(), 0xcb3776b137c27414},
           KnownType{"keypoints_t", keypoints_t::getHash(), 0x67a38e772b2d12ec},
           KnownType{"look_request_t", look_request_t::getHash(), 0x9d75c85c9d354dab},
           KnownType{"look_t", look_t::getHash(), 0x0b0bb8c6a228b561},
           KnownType{"people_t", people_t::getHash(), 0xf2b68569f7063383},
           KnownType{"person_body_t", person_body_t::getHash(), 0xc3f0ddc818400a9e},
           KnownType{"person_details_t", person_details_t::getHash(), 0x9d1147c28bf2b6b3},
           KnownType{"pose_t", pose_t::getHash(), 0x86cb66c1989d71c0},
           KnownType{"preview_t", preview_t::getHash(), 0xf39037e2481e11cf},
           KnownType{"service_t", service_t::getHash(), 0x05ac1d843ba41169},
           KnownType{"status_t", status_t::getHash(), 0x1ed0e6c1ecdfab75},
           KnownType{"studio_t", studio_t::getHash(), 0x0a2aa0a6a07542e3},
           KnownType{"unknown_t", unknown_t::getHash(), 0xf6b3a8dd1a0238de},
           KnownType{"voxels_t", voxels_t::getHash(), 0x8ff51dacbcb26f6c},
       }) {
    EXPECT_EQ(static_cast<std::uint64_t>(type.fingerprint), type.published)
        << type.name << ": older clients cannot decode it; new fields go into a new type";
  }
}

}  // namespace
}  // namespace mocap
