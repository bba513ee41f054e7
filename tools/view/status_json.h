// How the service does, as the page shows it.
#pragma once

#include <mocap/service_t.hpp>
#include <mocap/status_t.hpp>
#include <optional>
#include <string>

namespace mocap {

/// @param service  tells of the cameras' trust and light; may not be known yet.
std::string StatusJson(const status_t& status, const std::optional<service_t>& service);
std::string ServiceJson(const service_t& service);

}  // namespace mocap
