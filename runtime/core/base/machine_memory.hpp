#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace samara {

/// Bytes of memory that this process can still take: what the machine has left, swap with it, within the
/// limits of the process (ulimit -v, -d) and of its control groups. Infinite where nothing is known.
double available_memory();

/// What the memory controllers of control groups leave: `membership` is the text of /proc/self/cgroup,
/// `root` where the groups are mounted. Of all groups from the process's own to the root the least, not
/// counting the pages of files that they can drop. Infinite without a limit.
double available_in_control_groups(std::string_view membership, const std::filesystem::path& root);

/// Throws Error, "WHAT takes 5.2 GB of memory, and 3.1 GB are free; REMEDY", where more is needed than
/// available_memory(): before hours are spent on what then ends for want of it.
void require_memory(double bytes, const std::string& what, const std::string& remedy);

/// `count` zeros of a plain number type, for arrays of megabytes and more: aligned to cache lines, taken from
/// the system when they are first written, and in large pages where the system has them, which takes several
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
