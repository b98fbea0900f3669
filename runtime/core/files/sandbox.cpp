#include "samara/core/files/sandbox.hpp"

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>
#if __has_include(<linux/landlock.h>)
#include <linux/landlock.h>
#endif

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#else
#error "the sandbox does not support this processor"
#endif

// The system calls that computing, threads, memory and reading take, on all processors and on x86-64 alone.
constexpr int allowed_calls[] = {
    SYS_read,
    SYS_readv,
    SYS_pread64,
    SYS_write,
    SYS_writev,
    SYS_close,
    SYS_lseek,
    SYS_fstat,
    SYS_newfstatat,
    SYS_statx,
    SYS_faccessat,
    SYS_readlinkat,
    SYS_getdents64,
    SYS_getcwd,
    SYS_dup,
    SYS_dup3,
    SYS_fstatfs,
    SYS_statfs,
    SYS_mmap,
    SYS_mprotect,
    SYS_munmap,
    SYS_mremap,
    SYS_madvise,
    SYS_brk,
    SYS_futex,
    SYS_set_robust_list,
    SYS_get_robust_list,
    SYS_set_tid_address,
    SYS_membarrier,
    SYS_exit,
    SYS_exit_group,
    SYS_rt_sigaction,
    SYS_rt_sigprocmask,
    SYS_rt_sigreturn,
    SYS_sigaltstack,
    SYS_restart_syscall,
    SYS_sched_yield,
    SYS_sched_getaffinity,
    SYS_sched_getparam,
    SYS_sched_getscheduler,
    SYS_clock_gettime,
    SYS_clock_getres,
    SYS_clock_nanosleep,
    SYS_nanosleep,
    SYS_gettimeofday,
    SYS_times,
    SYS_getrusage,
    SYS_getcpu,
    SYS_getpid,
    SYS_gettid,
    SYS_getppid,
    SYS_getuid,
    SYS_geteuid,
    SYS_getgid,
    SYS_getegid,
    SYS_sysinfo,
    SYS_uname,
    SYS_getrandom,
    SYS_pipe2,
#ifdef SYS_rseq
    SYS_rseq,
#endif
#ifdef SYS_faccessat2
    SYS_faccessat2,
#endif
#if defined(__x86_64__)
    SYS_stat,
    SYS_lstat,
    SYS_access,
    SYS_readlink,
    SYS_dup2,
    SYS_pipe,
    SYS_time,
    SYS_getdents,
#endif
};

// Calls that fail as if they did not exist: the C library then takes older ones, whose arguments a filter can
// see.
constexpr int missing_calls[] = {
#ifdef SYS_clone3
    SYS_clone3,
#endif
#ifdef SYS_openat2
    SYS_openat2,
#endif
};

constexpr int starting_calls[] = {
    SYS_execve,
    SYS_execveat,
#if defined(__x86_64__)
    SYS_fork,
    SYS_vfork,
#endif
};

// A condition on one half of an argument, under a mask.
struct Condition {
    std::size_t
        half;  // 2 n: the lower half of argument n, on little-endian processors; 2 n + 1: the upper one
    std::uint32_t value;
    std::uint32_t mask = std::numeric_limits<std::uint32_t>::max();
};

constexpr std::size_t lower_half(std::size_t argument) {
    return 2 * argument;
}

// A filter is a program of at most 4096 instructions, which the kernel runs on each system call.
class Filter {
  public:
    Filter() {
        load(offsetof(seccomp_data, arch));
        add(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0);
        decide(SECCOMP_RET_KILL_PROCESS);
        load(offsetof(seccomp_data, nr));
    }

    void rule(int call, std::uint32_t decision) {
        add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1);
        decide(decision);
    }

    // Allows the call where all conditions hold; else the rules that follow decide.
    void allow_where(int call, std::initializer_list<Condition> conditions) {
        auto rest = static_cast<std::uint8_t>(3 * conditions.size() + 1);
        add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, rest);
        for (const Condition& condition : conditions) {
            rest = static_cast<std::uint8_t>(rest - 3);
            load(offsetof(seccomp_data, args) + sizeof(std::uint32_t) * condition.half);
            add(BPF_ALU | BPF_AND | BPF_K, condition.mask);
            add(BPF_JMP | BPF_JEQ | BPF_K, condition.value, 0, rest);
        }
        decide(SECCOMP_RET_ALLOW);
        load(offsetof(seccomp_data, nr));
    }

    void decide(std::uint32_t decision) { add(BPF_RET | BPF_K, decision); }

    [[nodiscard]] bool install() {
        sock_fprog program{static_cast<unsigned short>(instructions_.size()), instructions_.data()};
        return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
               ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) == 0;
    }

  private:
    void load(std::size_t offset) { add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)); }
    void add(int code, std::uint32_t value, std::uint8_t if_true = 0, std::uint8_t if_false = 0) {
        instructions_.push_back({static_cast<std::uint16_t>(code), if_true, if_false, value});
    }

    std::vector<sock_filter> instructions_;
};

bool allow_computing_and_reading_alone() {
    constexpr std::uint32_t allow = SECCOMP_RET_ALLOW;
    constexpr std::uint32_t reject = SECCOMP_RET_ERRNO | EPERM;
    constexpr std::uint32_t writing = O_ACCMODE | O_CREAT | O_TRUNC;
    const auto self = static_cast<std::uint32_t>(::getpid());
    Filter filter;
    for (const int call : allowed_calls) filter.rule(call, allow);
    for (const int call : missing_calls) filter.rule(call, SECCOMP_RET_ERRNO | ENOSYS);
    for (const int call : starting_calls) filter.rule(call, SECCOMP_RET_KILL_PROCESS);
    filter.allow_where(SYS_clone, {{lower_half(0), CLONE_THREAD, CLONE_THREAD}});
    filter.rule(SYS_clone, SECCOMP_RET_KILL_PROCESS);
    filter.allow_where(SYS_openat, {{lower_half(2), O_RDONLY, writing}});
#if defined(__x86_64__)
    filter.allow_where(SYS_open, {{lower_half(1), O_RDONLY, writing}});
#endif
    // Excludes those that make a file signal other processes (F_SETOWN, F_SETSIG, O_ASYNC by F_SETFL).
    for (const int command : {F_DUPFD, F_DUPFD_CLOEXEC, F_GETFD, F_SETFD, F_GETFL}) {
        filter.allow_where(SYS_fcntl, {{lower_half(1), static_cast<std::uint32_t>(command)}});
    }
    filter.allow_where(SYS_flock, {{lower_half(1), 0, LOCK_EX}});
    filter.allow_where(SYS_tgkill, {{lower_half(0), self}});
    // Its limits may be read, not set.
    filter.allow_where(SYS_prlimit64, {{lower_half(0), 0}, {lower_half(2), 0}, {lower_half(2) + 1, 0}});
    filter.allow_where(SYS_prctl, {{lower_half(0), PR_SET_NAME}});
    filter.allow_where(SYS_ioctl, {{lower_half(1), TCGETS}});
    filter.decide(reject);
    return filter.install();
}

#ifdef LANDLOCK_ACCESS_FS_EXECUTE
// Best effort: the filter holds without it, but cannot see paths.
void read_beneath(const std::vector<std::filesystem::path>& folders) {
    landlock_ruleset_attr all = {};
    all.handled_access_fs =
        (LANDLOCK_ACCESS_FS_MAKE_SYM << 1U) - 1U;  // the last right of the first version of Landlock
    const auto rules = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &all, sizeof all, 0));
    if (rules < 0) return;
    for (const std::filesystem::path& folder : folders) {
        landlock_path_beneath_attr beneath = {};
        beneath.allowed_access = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
        beneath.parent_fd = ::open(folder.c_str(), O_PATH | O_CLOEXEC | O_DIRECTORY);
        if (beneath.parent_fd < 0) continue;
        ::syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &beneath, 0);
        ::close(beneath.parent_fd);
    }
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0) ::syscall(SYS_landlock_restrict_self, rules, 0);
    ::close(rules);
}
#else
void read_beneath(const std::vector<std::filesystem::path>&) {}
#endif

}  // namespace

void enter_sandbox(const std::vector<std::filesystem::path>& readable) {
    std::vector<std::filesystem::path> folders = readable;
    // For libraries that are loaded late, the number of processors, and what sanitizers look up.
    for (const char* folder : {"/usr", "/lib", "/lib64", "/sys/devices/system/cpu", "/proc/self"}) {
        folders.emplace_back(folder);
    }
    read_beneath(folders);
    if (!allow_computing_and_reading_alone()) {
        throw Error(fmt::format("the sandbox needs seccomp filters, which this system does not support: {}",
                                std::strerror(errno)));
    }
}

}  // namespace samara
