#include "foam-cases/farm/guarded_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

constexpr int tick_milliseconds = 100;
constexpr int cannot_start = 127;

volatile std::sig_atomic_t interrupted = 0;

void note_interruption(int /*signal*/) {
    interrupted = 1;
}

// Catches SIGINT and SIGTERM while it lives.
class InterruptionGuard {
  public:
    InterruptionGuard() {
        interrupted = 0;
        struct sigaction action = {};
        action.sa_handler = note_interruption;
        ::sigaction(SIGINT, &action, &old_interrupt_);
        ::sigaction(SIGTERM, &action, &old_terminate_);
    }
    ~InterruptionGuard() {
        ::sigaction(SIGINT, &old_interrupt_, nullptr);
        ::sigaction(SIGTERM, &old_terminate_, nullptr);
    }
    InterruptionGuard(const InterruptionGuard&) = delete;
    InterruptionGuard& operator=(const InterruptionGuard&) = delete;

  private:
    struct sigaction old_interrupt_ = {};
    struct sigaction old_terminate_ = {};
};

int exit_status(int status) {
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

[[noreturn]] void become_worker(char* const* words, const char* output, const char* folder) {
    const int descriptor = ::open(output, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (descriptor < 0 || nothing < 0 || ::dup2(nothing, STDIN_FILENO) < 0 ||
        ::dup2(descriptor, STDOUT_FILENO) < 0 || ::dup2(descriptor, STDERR_FILENO) < 0 ||
        ::chdir(folder) != 0) {
        ::_exit(cannot_start);
    }
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    ::execvp(words[0], words);
    ::_exit(cannot_start);
}

// Becomes the leader of the group. Nothing is written into the pipe: it closes when the starting program
// ends.
[[noreturn]] void become_guardian(int pipe_end, char* const* words, const char* output, const char* folder) {
    ::setpgid(0, 0);
    std::signal(SIGINT, SIG_IGN);
    std::signal(SIGTERM, SIG_IGN);
    const pid_t worker = ::fork();
    if (worker < 0) ::_exit(cannot_start);
    if (worker == 0) become_worker(words, output, folder);
    while (true) {
        pollfd watched = {pipe_end, POLLIN, 0};
        if (::poll(&watched, 1, tick_milliseconds) > 0) ::kill(0, SIGKILL);
        int status = 0;
        if (::waitpid(worker, &status, WNOHANG) == worker) ::_exit(exit_status(status));
    }
}

}  // namespace

std::optional<int> run_guarded(const std::vector<std::string>& words, const std::filesystem::path& output,
                               const std::filesystem::path& folder, const std::function<void()>& tick) {
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);

    std::array<int, 2> ends = {};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
        throw Error(fmt::format("{}: cannot be started: {}", words.front(), std::strerror(errno)));
    }
    const InterruptionGuard guard;
    const pid_t guardian = ::fork();
    if (guardian == 0) {
        ::close(ends[1]);
        become_guardian(ends[0], pointers.data(), output.c_str(), folder.c_str());
    }
    ::close(ends[0]);
    if (guardian < 0) {
        ::close(ends[1]);
        throw Error(fmt::format("{}: cannot be started: {}", words.front(), std::strerror(errno)));
    }

    int status = 0;
    while (::waitpid(guardian, &status, WNOHANG) == 0) {
        if (interrupted != 0) {
            ::close(ends[1]);
            ::waitpid(guardian, &status, 0);
            return std::nullopt;
        }
        tick();
        ::usleep(tick_milliseconds * 1000);
    }
    ::close(ends[1]);
    if (interrupted != 0) return std::nullopt;
    if (exit_status(status) == cannot_start) {
        throw Error(fmt::format("{}: cannot be started; is it installed?", words.front()));
    }
    return exit_status(status);
}

FolderLock::FolderLock(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    descriptor_ = ::open((folder / ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor_ < 0) {
        throw Error(fmt::format("{}: cannot be written: {}", folder.string(), std::strerror(errno)));
    }
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
        ::close(descriptor_);
        throw Error(
            fmt::format("{}: another bake is running there; wait for it to finish, or choose another output",
                        folder.string()));
    }
}

FolderLock::~FolderLock() {
    ::close(descriptor_);
}

}  // namespace samara
