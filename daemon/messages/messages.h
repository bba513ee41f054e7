// Converts the pipeline's values to LCM messages.
#pragma once

#include <cstdint>
#include <mocap/body_t.hpp>
#include <mocap/people_t.hpp>
#include <mocap/person_details_t.hpp>
#include <mocap/pose_t.hpp>
#include <mocap/voxels_t.hpp>
#include <span>

#include "daemon/messages/voxel_labels.h"
#include "daemon/pipeline/pose_sink.h"

namespace mocap {

/// Fills all fields but publish_utime. While searching there is no pose: its numbers are 0.
/// @param cameras  number in the studio. The message's memory is reused.
void FillPose(const TrackedSet& set, int cameras, pose_t& message);

/// Likewise for all people.
void FillPeople(const TrackedSet& set, int cameras, people_t& message);

/// Fills what people_t does not tell of one of the set's people.
/// @param place  of the person in the set.
void FillDetails(const TrackedSet& set, std::size_t place, person_details_t& message);

void FillBody(const BodyModel& body, std::int64_t utime, body_t& message);

/// Fills all fields but the labels.
void FillVoxelGrid(const VoxelGrid& grid, std::int64_t capture_ns, std::int64_t frame,
                   voxels_t& message);
/// Adds the labels of the parts of all bodies.
void FillVoxels(const VoxelGrid& grid, std::int64_t capture_ns, std::int64_t frame,
                std::span<const BodyInPlace> bodies, voxels_t& message);
void FillVoxels(const TrackedSet& set, voxels_t& message);

}  // namespace mocap
