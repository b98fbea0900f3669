#include "samara/core/base/parallel_for.hpp"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace samara {

int thread_count(int threads) {
    // Asked once: the answer comes from a file of the system.
    static const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    return threads > 0 ? threads : cores;
}

void parallel_for_range(std::size_t count, std::size_t piece, int threads, const RangeWork& work,
                        const std::function<void(double)>& progress) {
    std::atomic<std::size_t> next = 0;
    const auto take_piece = [&] {
        const std::size_t begin = next.fetch_add(piece);
        if (begin >= count) return false;
        work.call(work.work, begin, std::min(begin + piece, count));
        return true;
    };
    const std::size_t pieces = (count + piece - 1) / piece;
    const std::size_t helpers = std::min(static_cast<std::size_t>(thread_count(threads)), pieces);
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < helpers; ++i) {
        others.emplace_back([&] {
            while (take_piece()) {
            }
        });
    }
    while (take_piece()) {
        if (progress)
            progress(static_cast<double>(std::min(next.load(), count)) / static_cast<double>(count));
    }
}

}  // namespace samara
