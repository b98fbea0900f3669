#pragma once

#include <cstddef>
#include <functional>

namespace samara {

/// Returns the number of threads that `threads` stands for: itself, or all cores where it is 0.
int thread_count(int threads);

/// Work on a range of numbers, without a copy of what it refers to.
struct RangeWork {
    void (*call)(const void* work, std::size_t begin, std::size_t end);
    const void* work;
};
/// parallel_for() of a RangeWork.
void parallel_for_range(std::size_t count, std::size_t piece, int threads, const RangeWork& work,
                        const std::function<void(double)>& progress);

/// Runs work(begin, end) over [0, count) in pieces of `piece`, on `threads` threads (0: all cores), the
/// calling one among them. The pieces are the same for any number of threads, so that the results are bitwise
/// equal where each piece writes only its own data. `progress`, where given, is called with the share done (0
/// to 1), on the calling thread alone. `work` must not throw. Allocates only to start other threads.
template <typename Work>
void parallel_for(std::size_t count, std::size_t piece, int threads, const Work& work,
                  const std::function<void(double)>& progress = {}) {
    const auto call = [](const void* given, std::size_t begin, std::size_t end) {
        (*static_cast<const Work*>(given))(begin, end);
    };
    parallel_for_range(count, piece, threads, {call, &work}, progress);
}

}  // namespace samara
