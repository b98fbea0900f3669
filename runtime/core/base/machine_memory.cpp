#include "samara/core/base/machine_memory.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <new>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Returns the number behind a key in a text of lines "KEY NUMBER", such as /proc/meminfo.
std::optional<double> number_of(const std::filesystem::path& file, std::string_view key) {
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line, '\n');) {
        std::istringstream words(line);
        std::string name;
        double number = 0.0;
        if (words >> name >> number && name == key) return number;
    }
    return std::nullopt;
}

/// Returns the number that a file holds alone; nothing where it is missing or says "max".
std::optional<double> number_in(const std::filesystem::path& file) {
    std::ifstream stream(file);
    double number = 0.0;
    if (stream >> number) return number;
    return std::nullopt;
}

double available_in_machine() {
    constexpr double kibibyte = 1024.0;
    const auto available = number_of("/proc/meminfo", "MemAvailable:");
    if (!available) return unlimited;
    return kibibyte * (*available + number_of("/proc/meminfo", "SwapFree:").value_or(0.0));
}

/// Returns the bytes that a resource limit leaves to a process that holds `pages` pages.
double available_within(int resource, double pages) {
    rlimit limit = {};
    if (::getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
    const auto page = static_cast<double>(::sysconf(_SC_PAGESIZE));
    return std::max(0.0, static_cast<double>(limit.rlim_cur) - page * pages);
}

double available_to_process() {
    std::ifstream stream("/proc/self/statm");
    double size = 0.0;
    double skipped = 0.0;
    double data = 0.0;
    if (!(stream >> size >> skipped >> skipped >> skipped >> skipped >> data)) return unlimited;
    return std::min(available_within(RLIMIT_AS, size), available_within(RLIMIT_DATA, data));
}

/// The names of the files of one version of the memory controller.
struct Controller {
    const char* limit;
    const char* used;
    const char* of_files;  ///< key in memory.stat: pages of files
};

double available_in(const std::filesystem::path& group, const Controller& controller) {
    const auto limit = number_in(group / controller.limit);
    const auto used = number_in(group / controller.used);
    if (!limit || !used) return unlimited;
    const double of_files = number_of(group / "memory.stat", controller.of_files).value_or(0.0);
    return std::max(0.0, *limit - *used + of_files);
}

}  // namespace

double available_in_control_groups(std::string_view membership, const std::filesystem::path& root) {
    constexpr Controller first = {"memory.limit_in_bytes", "memory.usage_in_bytes", "total_cache"};
    constexpr Controller second = {"memory.max", "memory.current", "file"};
    double least = unlimited;
    std::istringstream lines{std::string(membership)};
    for (std::string line; std::getline(lines, line, '\n');) {  // NUMBER:CONTROLLERS:/GROUP
        const std::size_t begin = line.find(':');
        const std::size_t end = line.find(':', begin + 1);
        if (begin == std::string::npos || end == std::string::npos) continue;
        const std::string controllers = ',' + line.substr(begin + 1, end - begin - 1) + ',';
        const bool unified = controllers == ",,";
        if (!unified && controllers.find(",memory,") == std::string::npos) continue;
        const std::filesystem::path mount = unified ? root : root / "memory";
        // Within a container the group's own path may not be mounted: those above it are.
        for (std::filesystem::path group = line.substr(end + 1);; group = group.parent_path()) {
            least = std::min(least, available_in(mount / group.relative_path(), unified ? second : first));
            if (!group.has_relative_path()) break;
        }
    }
    return least;
}

double available_memory() {
    std::ifstream stream("/proc/self/cgroup");
    std::ostringstream membership;
    membership << stream.rdbuf();
    return std::min({available_in_machine(), available_to_process(),
                     available_in_control_groups(membership.str(), "/sys/fs/cgroup")});
}

void require_memory(double bytes, const std::string& what, const std::string& remedy) {
    constexpr double negligible = 64e6;
    if (bytes < negligible) return;
    const double available = available_memory();
    if (bytes <= available) return;
    throw Error(fmt::format("{} needs {:.3g} GB of memory, but {:.3g} GB are free; {}", what, 1e-9 * bytes,
                            1e-9 * available, remedy));
}

template <typename Number>
LargeArray<Number>::LargeArray(std::size_t count) {
    if (count == 0) return;
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(Number)) throw std::bad_alloc();
    const std::size_t bytes = count * sizeof(Number);
    // Anonymous pages are zero and start at page boundaries.
    void* place = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (place == MAP_FAILED) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    madvise(place, bytes, MADV_HUGEPAGE);  // where the system rejects it the array is slower but correct
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
