// Misspelt names: keys, commands, options, cameras, and everything else that is looked up by name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mocap {

/// Finds the name that a misspelt one resembles most: the fewest letters to insert, delete, replace
/// or exchange with their neighbour, at most one, or a quarter of the letters. The beginning of a
/// longer name counts too. Capitals do not matter.
/// @return empty if no name is near.
std::string NearestName(std::string_view typed, const std::vector<std::string>& names);

/// Puts a question with the nearest name before what is wanted: `did you mean fps? Expected …`.
/// Without a near name, returns `wanted` alone.
std::string WithNearestName(std::string_view typed, const std::vector<std::string>& names,
                            std::string wanted);

/// Lists what there is, after the nearest name: `did you mean cam1? Expected one of cam1, cam2`.
std::string ExpectedNames(std::string_view typed, const std::vector<std::string>& names);

/// "a, b, c".
std::string ListedNames(const std::vector<std::string>& names);

}  // namespace mocap
