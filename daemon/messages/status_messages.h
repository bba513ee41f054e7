// The status as LCM messages, and back.
#pragma once

#include <cstdint>
#include <mocap/contrast_t.hpp>
#include <mocap/keypoint_senders_t.hpp>
#include <mocap/people_t.hpp>
#include <mocap/service_t.hpp>
#include <mocap/status_t.hpp>

#include "daemon/status/service_report.h"

namespace mocap {

void FillStatus(const ServiceReport& report, std::int64_t utime, status_t& message);
void FillService(const ServiceReport& report, std::int64_t utime, service_t& message);
void FillContrast(const ServiceReport& report, std::int64_t utime, contrast_t& message);
void FillKeypointSenders(const ServiceReport& report, std::int64_t utime,
                         keypoint_senders_t& message);

/// Takes from a message what it tells. Anyone may have sent it: numbers become finite, and texts
/// printable and short.
void TakeStatus(const status_t& message, ServiceReport& report);
/// @pre  the status has been taken, which says what cameras there are.
void TakeService(const service_t& message, ServiceReport& report);
/// At most as many as KeypointInbox has.
void TakeKeypointSenders(const keypoint_senders_t& message, ServiceReport& report);
/// At most kMostPeople.
void TakePeople(const people_t& message, ServiceReport& report);

}  // namespace mocap
