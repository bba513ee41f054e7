// Stores a person's sizes in a file, so that they need not be measured again.
#pragma once

#include <filesystem>
#include <string>

#include "core/body/body_sizes.h"

namespace mocap {

/// Reads a subject's TOML: [sizes] as in a result's body.toml. Other keys are allowed.
/// @throws SetupError  with file, line and key.
BodySizes LoadSubject(const std::filesystem::path& file);

/// Writes the file atomically: there is either the old file or the new one.
/// @throws std::runtime_error  if it cannot be written.
/// @param name  of the person, as a note for readers; empty: none.
void SaveSubject(const std::filesystem::path& file, const BodySizes& sizes,
                 const std::string& name = {});

}  // namespace mocap
