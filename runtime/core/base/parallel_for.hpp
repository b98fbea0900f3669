#pragma once

#include <cstddef>
#include <functional>

namespace samara {

/// Returns the number of threads that `threads` stands for: itself, or all cores where it is 0.
int thread_count(int threads);

/// Runs work(begin, end) over [0, count) in pieces of `piece`, on `threads` threads (0: all cores), the
/// calling one among them. The pieces are the same for any number of threads, so that the results are bitwise
/// equal where each piece writes only its own data. `progress`, where given, is called with the share done (0
/// to 1), on the calling thread alone. `work` must not throw.
void parallel_for(std::size_t count, std::size_t piece, int threads,
                  const std::function<void(std::size_t begin, std::size_t end)>& work,
                  const std::function<void(double)>& progress = {});

}  // namespace samara
