#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace samara {

/// Returns the memory (bytes) that this process can still take: what the machine has left, swap included,
/// within the limits of the process (ulimit -v, -d) and of its control groups. Infinite where nothing is
/// known.
double available_memory();

/// Returns the memory (bytes) that the memory controllers of control groups leave: the least of all groups
/// from the process's own to the root, where pages of files that a group can drop count as free. `membership`
/// is the text of /proc/self/cgroup, `root` where the groups are mounted. Infinite without a limit.
double available_in_control_groups(std::string_view membership, const std::filesystem::path& root);

/// Throws Error, "WHAT takes 5.2 GB of memory, and 3.1 GB are free; REMEDY", where `bytes` exceeds
/// available_memory(), so that a computation of hours does not end for want of memory.
void require_memory(double bytes, const std::string& what, const std::string& remedy);

/// An array of `count` numbers, zero at first, for megabytes and more: aligned to cache lines, taken from the
/// system when they are first written, and in large pages where the system has them, which takes several
/// times less time. Throws std::bad_alloc.
template <typename Number>
class LargeArray {
  public:
    LargeArray() = default;
    explicit LargeArray(std::size_t count);

    [[nodiscard]] Number* data() const { return numbers_.get(); }
    [[nodiscard]] std::size_t bytes() const { return numbers_.get_deleter().bytes; }

  private:
    struct Release {
        std::size_t bytes = 0;
        void operator()(Number* numbers) const;
    };
    std::unique_ptr<Number, Release> numbers_;
};

extern template class LargeArray<float>;
extern template class LargeArray<double>;

}  // namespace samara
