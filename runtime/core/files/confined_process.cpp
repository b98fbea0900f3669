#include "samara/core/files/confined_process.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <new>
#include <string_view>

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "samara/core/base/error.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/sandbox.hpp"

namespace samara {
namespace {

// A message consists of its type, the number of bytes that follow, and the bytes.
enum class MessageType : char { bytes, error, done };

struct Header {
    MessageType type;
    std::uint64_t size;
};

constexpr int left_early = 3;  // exit status where `work` ended the process

double bytes_of_memory() {
    return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

// ---- in the child ----

void send_message(int pipe, MessageType type, std::string_view bytes) {
    Header header{};
    header.type = type;
    header.size = bytes.size();
    const auto write_all = [pipe](const char* data, std::size_t size) {
        while (size > 0) {
            const ssize_t written = ::write(pipe, data, size);
            if (written < 0 && errno == EINTR) continue;
            if (written <= 0) ::_exit(1);  // the parent has gone
            data += written;
            size -= static_cast<std::size_t>(written);
        }
    };
    write_all(reinterpret_cast<const char*>(&header), sizeof header);
    write_all(bytes.data(), bytes.size());
}

void leave_streams_and_files(int pipe) {
    const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
#ifdef SYS_close_range
    const auto kept = static_cast<unsigned int>(pipe);
    if (kept > 3) ::syscall(SYS_close_range, 3U, kept - 1, 0U);
    ::syscall(SYS_close_range, std::max(kept + 1, 3U), ~0U, 0U);
#endif
}

void limit(__rlimit_resource resource, double most, double grace = 0.0) {
    rlimit now{};
    ::getrlimit(resource, &now);
    const double highest = now.rlim_max == RLIM_INFINITY
                               ? most + grace
                               : std::min(most + grace, static_cast<double>(now.rlim_max));
    now.rlim_max = static_cast<rlim_t>(highest);
    now.rlim_cur = static_cast<rlim_t>(std::min(most, highest));
    ::setrlimit(resource, &now);
}

// Returns the data that the process holds already, which the limit adds to: sanitizers map terabytes.
double bytes_of_data_now() {
    std::ifstream stream("/proc/self/statm");
    double pages = 0.0;
    for (int column = 0; column < 6; ++column) stream >> pages;
    return stream ? pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) : 0.0;
}

void enter_limits(const ConfinedLimits& limits) {
    constexpr double grace = 5.0;  // s: from SIGXCPU, which tells this end from others, to SIGKILL
    limit(RLIMIT_CPU, std::ceil(limits.cpu_seconds), grace);
    limit(RLIMIT_DATA, bytes_of_data_now() + limits.memory * bytes_of_memory());
    limit(RLIMIT_FSIZE, 0.0);
    limit(RLIMIT_CORE, 0.0);
    // These signals end the child, whatever handlers this program has set.
    for (const int signal :
         {SIGXCPU, SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGSYS, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
        ::signal(signal, SIG_DFL);
    }
}

[[noreturn]] void run_child(const std::string& label, const ConfinedLimits& limits, int pipe, pid_t parent,
                            const std::function<void(const SendBytes&)>& work) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0);
    if (::getppid() != parent) ::_exit(1);
    // Runs before the handlers that the parent has registered, which must not touch its files from here.
    std::atexit([] { ::_exit(left_early); });
    try {
        leave_streams_and_files(pipe);
        enter_limits(limits);
        try {
            enter_sandbox(limits.readable);
        } catch (const Error& error) {
            throw Error(label + ": " + error.what());
        }
        work([pipe](std::string_view bytes) { send_message(pipe, MessageType::bytes, bytes); });
        send_message(pipe, MessageType::done, {});
    } catch (const Error& error) {
        send_message(pipe, MessageType::error, error.what());
    } catch (const std::bad_alloc&) {
        send_message(pipe, MessageType::error,
                     fmt::format("{}: needs more than {:.1f} GB of memory; simplify it", label,
                                 1e-9 * limits.memory * bytes_of_memory()));
    } catch (const std::exception& error) {
        send_message(pipe, MessageType::error, fmt::format("{}: cannot be read: {}", label, error.what()));
    } catch (...) {
        send_message(pipe, MessageType::error, label + ": cannot be read");
    }
    ::_exit(0);
}

// ---- in the parent ----

// Owns the child process, which ends with this object at the latest.
class Child {
  public:
    explicit Child(pid_t process) : process_(process) {}
    ~Child() {
        if (process_ > 0) {
            ::kill(process_, SIGKILL);
            wait();
        }
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    int wait() {
        int status = 0;
        while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        process_ = 0;
        return status;
    }

    [[nodiscard]] double cpu_seconds() const {
        clockid_t clock{};
        timespec time{};
        if (::clock_getcpuclockid(process_, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return -1.0;
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

  private:
    pid_t process_;
};

// Reads messages until the child has closed its end. Throws Error where it sends more, or takes longer, than
// its limits allow.
class Messages {
  public:
    Messages(int pipe, const Child& child, std::string label, const ConfinedLimits& limits)
        : pipe_(pipe), child_(child), label_(std::move(label)), limits_(limits) {}
    ~Messages() { ::close(pipe_); }
    Messages(const Messages&) = delete;
    Messages& operator=(const Messages&) = delete;

    // Reads one message; false where there is none. `bytes` grows as they arrive, whatever size the message
    // claims.
    bool next(MessageType& type, std::string& bytes) {
        Header header{};
        bytes.clear();
        if (!fill(sizeof header)) return false;
        std::memcpy(&header, read_.data(), sizeof header);
        read_.erase(0, sizeof header);
        if (header.size > may_send_) {
            throw Error(fmt::format(
                "{}: its reader returned more than {:.3g} MB; the file may be damaged: make it again", label_,
                1e-6 * static_cast<double>(limits_.sent_bytes)));
        }
        may_send_ -= header.size;
        if (!fill(header.size)) return false;
        type = header.type;
        bytes = read_.substr(0, header.size);
        read_.erase(0, header.size);
        return true;
    }

  private:
    bool fill(std::uint64_t size) {
        char block[1U << 16U];
        while (read_.size() < size) {
            wait();
            const ssize_t count = ::read(pipe_, block, sizeof block);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) return false;
            read_.append(block, static_cast<std::size_t>(count));
        }
        return true;
    }

    // Waits until there is something to read. Bytes that trickle in do not count as work, and work that
    // trickles has a limit.
    void wait() {
        using Clock = std::chrono::steady_clock;
        constexpr double least_work = 1e-3;  // s
        constexpr double busiest = 20.0;     // the most processes at work on each processor
        const double longest = limits_.idle_seconds + busiest * limits_.cpu_seconds;
        for (bool is_ready = false; !is_ready;) {
            pollfd waiting{pipe_, POLLIN, 0};
            const int pause = static_cast<int>(std::min(1000.0, 250.0 * limits_.idle_seconds));
            const Clock::time_point start = Clock::now();
            is_ready = ::poll(&waiting, 1, std::max(pause, 1)) > 0;
            const std::chrono::duration<double> waited = Clock::now() - start;
            idle_ += waited.count();
            in_all_ += waited.count();
            const double cpu = child_.cpu_seconds();
            if (cpu < 0.0 || cpu > cpu_ + least_work) {
                cpu_ = cpu;
                idle_ = 0.0;
            }
            if (idle_ > limits_.idle_seconds) {
                throw Error(fmt::format(
                    "{}: its reader waited for {:.0f} s without computing; give a regular file, not a pipe",
                    label_, limits_.idle_seconds));
            }
            if (in_all_ > longest)
                throw Error(fmt::format("{}: needs more than {:.0f} s; simplify it", label_, longest));
        }
    }

    int pipe_;
    const Child& child_;
    std::string label_;
    ConfinedLimits limits_;
    std::uint64_t may_send_ = limits_.sent_bytes;
    double cpu_ = 0.0;     // s: the child's CPU time when work was last seen
    double idle_ = 0.0;    // s: the waiting time since
    double in_all_ = 0.0;  // s: the waiting time in all
    std::string read_;
};

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

[[noreturn]] void fail_by(int status, const std::string& label, const ConfinedLimits& limits) {
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGSYS) {
        throw Error(label + ": tries to start a program, which is not allowed in a file; do not use it");
    }
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
        throw Error(
            fmt::format("{}: needs more than {:.0f} s of CPU time; simplify it", label, limits.cpu_seconds));
    }
    if (WIFSIGNALED(status)) {
        const int signal = WTERMSIG(status);
        throw Error(
            fmt::format("{}: cannot be read: the reader was ended by signal {} ({}); the file may be "
                        "damaged: make it again",
                        label, signal, ::strsignal(signal)));
    }
    throw Error(label + ": ended its reader before the end of the file; do not use it");
}

ConfinedLimits limits_for(const InputFile& input) {
    ConfinedLimits limits;
    // The folder of the name and, where that is a link, of the file.
    for (const auto& file :
         {std::filesystem::absolute(input.path()), std::filesystem::canonical(input.path())}) {
        limits.readable.push_back(file.parent_path());
    }
    limits.cpu_seconds = 10.0 + static_cast<double>(input.size()) / 20e6;
    limits.idle_seconds = 30.0;
    limits.memory = 0.25;
    limits.sent_bytes = 64U << 10U;  // a type, or an error
    return limits;
}

}  // namespace

void run_confined(const std::string& label, const ConfinedLimits& limits,
                  const std::function<void(const SendBytes& send)>& work,
                  const std::function<void(std::string_view bytes)>& receive) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) {
        throw Error(fmt::format("{}: the reader process cannot be started: {}", label, std::strerror(errno)));
    }
    const pid_t parent = ::getpid();
    const pid_t process = ::fork();
    if (process == 0) run_child(label, limits, ends[1], parent, work);
    const int reason = errno;
    ::close(ends[1]);
    if (process < 0) {
        ::close(ends[0]);
        throw Error(
            fmt::format("{}: the reader process cannot be started: {}", label, std::strerror(reason)));
    }
    Child child(process);
    Messages messages(ends[0], child, label, limits);
    MessageType type{};
    for (std::string bytes; messages.next(type, bytes);) {
        if (type == MessageType::error) throw Error(first_line(bytes));
        if (type == MessageType::done) return;
        receive(bytes);
    }
    fail_by(child.wait(), label, limits);
}

std::string check_confined(const InputFile& input, const std::function<std::string()>& read) {
    std::string found;
    run_confined(
        input.path().string(), limits_for(input),
        [&](const SendBytes& send) {
            Hdf5Reader::set_check(nullptr);  // the child itself does the check
            send(read());
        },
        [&](std::string_view bytes) { found = bytes; });
    return found;
}

// A system with filters reads the filter from its address, which is null, and fails with EFAULT.
bool offers_confinement() {
    return ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, nullptr, 0, 0) != 0 && errno == EFAULT;
}

}  // namespace samara
