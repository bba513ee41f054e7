// Status of the service, for the page.
#pragma once

#include <mocap/service_t.hpp>
#include <mocap/status_t.hpp>
#include <optional>
#include <string>

namespace mocap {

/// @param service  trust and light of the cameras; may be unknown yet.
std::string StatusJson(const status_t& status, const std::optional<service_t>& service);
std::string ServiceJson(const service_t& service);

}  // namespace mocap
