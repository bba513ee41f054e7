// Independent pieces of work, on some threads.
#pragma once

#include <functional>
#include <vector>

namespace mocap {

/// Does all jobs, in any order, on up to `threads` threads.
/// @throws the first failure, after the jobs that had begun.
void DoAll(const std::vector<std::function<void()>>& jobs, int threads);

}  // namespace mocap
