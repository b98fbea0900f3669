#include "samara/core/base/large_array.hpp"

#include <limits>
#include <new>

#include <sys/mman.h>

namespace samara {

template <typename Number>
LargeArray<Number>::LargeArray(std::size_t count) {
    if (count == 0) return;
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(Number)) throw std::bad_alloc();
    const std::size_t bytes = count * sizeof(Number);
    // Anonymous pages are zero and start at page boundaries.
    void* place = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (place == MAP_FAILED) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    madvise(place, bytes, MADV_HUGEPAGE);  // where it is refused the array is slower, and right
#endif
    numbers_ = std::unique_ptr<Number, Release>(static_cast<Number*>(place), Release{bytes});
}

template <typename Number>
void LargeArray<Number>::Release::operator()(Number* numbers) const {
    munmap(numbers, bytes);
}

template class LargeArray<float>;
template class LargeArray<double>;

}  // namespace samara
