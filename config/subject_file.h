// A person's sizes in a file, so that they need not be measured again.
#pragma once

#include <filesystem>
#include <string>

#include "core/body/body_sizes.h"

namespace mocap {

/// Reads a subject's TOML: [sizes] as in body.toml of a result; other keys are allowed.
/// @throws SetupError  naming file, line and key.
BodySizes LoadSubject(const std::filesystem::path& file);

/// Writes it, in one step: there is the old file or the new one.
/// @throws std::runtime_error  when it cannot be written.
/// @param name  of the person, to be read by people; empty: none.
void SaveSubject(const std::filesystem::path& file, const BodySizes& sizes,
                 const std::string& name = {});

}  // namespace mocap
