// What an import found, for people and for programs.
#pragma once

#include <string>

#include "daemon/base/json.h"
#include "tools/import/import_take.h"

namespace mocap {

/// Lines for people: one for each camera, and what is doubtful of it below.
std::string ImportText(const ImportedTake& take);

/// One JSON object.
Json ImportJson(const ImportedTake& take);

}  // namespace mocap
