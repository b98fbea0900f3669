// What a process that reads untrusted files can do to the machine: nothing.

#include "samara/core/files/confined_process.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "samara/core/base/error.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

using Work = std::function<void(const SendBytes&)>;

std::vector<std::string> received_from(const Work& work, const ConfinedLimits& limits = {}) {
    std::vector<std::string> texts;
    run_confined("file", limits, work, [&](std::string_view bytes) { texts.emplace_back(bytes); });
    return texts;
}

std::string error_of(const Work& work, const ConfinedLimits& limits = {}) {
    const std::string error = test::error_of([&] { received_from(work, limits); });
    EXPECT_THAT(error, StartsWith("file: "));
    EXPECT_THAT(error, ::testing::Not(HasSubstr("\n")));
    return error;
}

// What the confined process got of a call: its errno, 0 where it succeeded.
template <typename Call>
int errno_of(const Call& call, const ConfinedLimits& limits = {}) {
    const auto texts = received_from(
        [&](const SendBytes& send) {
            errno = 0;
            call();
            send(std::to_string(errno));
        },
        limits);
    return std::stoi(texts.at(0));
}

TEST(ConfinedProcess, SendsTextsOfAnySizeInOrder) {
    const std::string large(3'000'000, 'x');
    EXPECT_THAT(received_from([&](const SendBytes& send) {
                    send("one");
                    send("");
                    send(large);
                }),
                ElementsAre("one", "", large));
}

TEST(ConfinedProcess, AnErrorOfTheWorkPassesOnAsItIs) {
    EXPECT_EQ(error_of([](const SendBytes&) { throw Error("file: line 7: a fault"); }),
              "file: line 7: a fault");
    EXPECT_EQ(error_of([](const SendBytes&) { throw std::runtime_error("surprise"); }),
              "file: cannot be read: surprise");
}

TEST(ConfinedProcess, MayNotStartAProgram) {
    const test::TemporaryFolder folder;
    const std::string command = "touch " + (folder / "made").string();
    const auto expected = HasSubstr("tries to start a program");
    EXPECT_THAT(error_of([&](const SendBytes&) { (void)std::system(command.c_str()); }), expected);
    EXPECT_THAT(error_of([&](const SendBytes&) { (void)::popen(command.c_str(), "r"); }), expected);
    EXPECT_THAT(error_of([&](const SendBytes&) { (void)::fork(); }), expected);
    EXPECT_THAT(error_of([&](const SendBytes&) { ::execl("/bin/true", "true", nullptr); }), expected);
    EXPECT_EQ(folder.file_count(), 0);
}

TEST(ConfinedProcess, MayNotTouchFilesNetworkOrOtherProcesses) {
    const test::TemporaryFolder folder;
    const std::string there = folder.file("there", "untouched").string();
    const std::string fresh = (folder / "fresh").string();
    ConfinedLimits limits;
    limits.readable = {folder.path()};
    EXPECT_NE(errno_of([&] { ::open(fresh.c_str(), O_WRONLY | O_CREAT, 0600); }, limits), 0);
    EXPECT_NE(errno_of([&] { ::open(there.c_str(), O_WRONLY | O_TRUNC); }, limits), 0);
    EXPECT_NE(errno_of([&] { ::open(there.c_str(), O_RDWR); }, limits), 0);
    EXPECT_NE(errno_of([&] { ::mkdir(fresh.c_str(), 0700); }, limits), 0);
    EXPECT_NE(errno_of([&] { ::unlink(there.c_str()); }, limits), 0);
    EXPECT_NE(errno_of([&] { ::rename(there.c_str(), fresh.c_str()); }, limits), 0);
    EXPECT_NE(errno_of([&] { ::symlink(there.c_str(), fresh.c_str()); }, limits), 0);
    EXPECT_NE(errno_of([&] { ::link(there.c_str(), fresh.c_str()); }, limits), 0);
    EXPECT_NE(errno_of([&] { ::chmod(there.c_str(), 0777); }, limits), 0);
    EXPECT_NE(errno_of([&] { ::truncate(there.c_str(), 0); }, limits), 0);
    EXPECT_NE(errno_of([] { ::socket(AF_INET, SOCK_STREAM, 0); }), 0);
    EXPECT_NE(errno_of([] { ::socket(AF_UNIX, SOCK_STREAM, 0); }), 0);
    EXPECT_NE(errno_of([] { ::kill(::getppid(), 0); }), 0);
    std::string text;
    std::getline(std::ifstream(there), text);
    EXPECT_EQ(text, "untouched");
    EXPECT_EQ(folder.file_count(), 1);
}

TEST(ConfinedProcess, MayHaveNoFileSignalOtherProcesses) {
    int ends[2];
    const auto rejected = [&](const auto& call) {
        return errno_of([&] {
                   if (::pipe(ends) == 0) (void)call(ends[0]);
               }) == EPERM;
    };
    EXPECT_TRUE(rejected([](int file) { return ::fcntl(file, F_SETOWN, ::getppid()); }));
    EXPECT_TRUE(rejected([](int file) { return ::fcntl(file, F_SETSIG, SIGTERM); }));
    EXPECT_TRUE(rejected([](int file) { return ::fcntl(file, F_SETFL, O_ASYNC); }));
    EXPECT_TRUE(rejected([](int file) {
        const f_owner_ex owner = {F_OWNER_PID, ::getppid()};
        return ::fcntl(file, F_SETOWN_EX, &owner);
    }));
    EXPECT_TRUE(rejected([](int file) {
        int on = 1;
        return ::ioctl(file, FIOASYNC, &on);
    }));
    EXPECT_TRUE(rejected([](int file) { return ::fcntl(file, F_NOTIFY, DN_ACCESS); }));
    EXPECT_TRUE(rejected([](int file) { return ::fcntl(file, F_SETLEASE, F_RDLCK); }));
    EXPECT_TRUE(rejected([](int) { return ::syscall(SYS_tgkill, ::getppid(), ::getppid(), 0); }));
    EXPECT_TRUE(rejected([](int) { return ::syscall(SYS_io_uring_setup, 1, nullptr); }));
    EXPECT_TRUE(rejected([](int) {
        timer_t timer{};
        return ::timer_create(CLOCK_MONOTONIC, nullptr, &timer);
    }));
    EXPECT_FALSE(rejected([](int file) { return ::fcntl(file, F_GETFD); }));
    EXPECT_FALSE(rejected([](int file) { return ::fcntl(file, F_DUPFD_CLOEXEC, 10); }));
}

TEST(ConfinedProcess, MayNotRaiseItsLimits) {
    rlimit limit{};
    EXPECT_EQ(errno_of([&] { ::getrlimit(RLIMIT_DATA, &limit); }), 0);
    EXPECT_EQ(errno_of([&] {
                  limit.rlim_cur = limit.rlim_max = RLIM_INFINITY;
                  ::setrlimit(RLIMIT_DATA, &limit);
              }),
              EPERM);
}

TEST(ConfinedProcess, SendsNoMoreThanItsShare) {
    ConfinedLimits limits;
    limits.sent_bytes = 1000;
    const auto expected = HasSubstr("returned more than 0.001 MB");
    EXPECT_THAT(error_of([](const SendBytes& send) { send(std::string(1001, 'x')); }, limits), expected);
    EXPECT_THAT(error_of(
                    [](const SendBytes& send) {
                        for (;;) send("some more");
                    },
                    limits),
                expected);
    EXPECT_THAT(error_of([](const SendBytes&) { throw Error(std::string(2000, 'x')); }, limits), expected);
    EXPECT_THAT(received_from([](const SendBytes& send) { send("little"); }, limits), ElementsAre("little"));
}

TEST(ConfinedProcess, TextsThatTrickleInAreNoWork) {
    ConfinedLimits limits;
    limits.idle_seconds = 0.5;
    EXPECT_THAT(error_of(
                    [](const SendBytes& send) {
                        for (;;) {
                            send("x");
                            std::this_thread::sleep_for(std::chrono::milliseconds(100));
                        }
                    },
                    limits),
                HasSubstr("without computing"));
}

TEST(ConfinedProcess, AnErrorIsOneLine) {
    EXPECT_EQ(error_of([](const SendBytes&) { throw Error("file: a fault\nand more of it"); }),
              "file: a fault");
}

TEST(ConfinedProcess, ReadsItsFolderAndWhereTheKernelHasLandlockNoOther) {
    const test::TemporaryFolder readable;
    const test::TemporaryFolder other;
    const std::string mine = readable.file("a", "mine").string();
    const std::string secret = other.file("b", "secret").string();
    ConfinedLimits limits;
    limits.readable = {readable.path()};
    const auto texts = received_from(
        [&](const SendBytes& send) {
            std::string text;
            std::getline(std::ifstream(mine), text);
            send(text);
            std::string nothing;
            std::getline(std::ifstream(secret), nothing);
            send(nothing);
        },
        limits);
    EXPECT_EQ(texts.at(0), "mine");
    constexpr unsigned int ask_for_version = 1;
    if (::syscall(SYS_landlock_create_ruleset, nullptr, 0, ask_for_version) < 1) {
        GTEST_SKIP() << "this kernel has no Landlock";
    }
    EXPECT_EQ(texts.at(1), "");
}

TEST(ConfinedProcess, MayComputeInThreads) {
    EXPECT_THAT(received_from([](const SendBytes& send) {
                    int result = 0;
                    std::thread([&] { result = 42; }).join();
                    send(std::to_string(result));
                }),
                ElementsAre("42"));
}

TEST(ConfinedProcess, ACrashIsOneLine) {
    EXPECT_THAT(error_of([](const SendBytes&) { ::raise(SIGSEGV); }), HasSubstr("ended by signal 11"));
    EXPECT_THAT(error_of([](const SendBytes&) { ::raise(SIGFPE); }), HasSubstr("ended by signal 8"));
    EXPECT_THAT(error_of([](const SendBytes&) { std::abort(); }), HasSubstr("ended by signal 6"));
}

TEST(ConfinedProcess, LeavingEarlyIsAError) {
    EXPECT_THAT(error_of([](const SendBytes&) { std::exit(0); }), HasSubstr("before the end of the file"));
    EXPECT_THAT(error_of([](const SendBytes&) { ::_exit(0); }), HasSubstr("before the end of the file"));
    EXPECT_THAT(error_of([](const SendBytes& send) {
                    send("part");
                    std::exit(0);
                }),
                HasSubstr("before the end of the file"));
}

TEST(ConfinedProcess, HasAnEnd) {
    ConfinedLimits limits;
    limits.cpu_seconds = 1.0;
    EXPECT_THAT(error_of(
                    [](const SendBytes&) {
                        for (volatile bool forever = true; forever;) {
                        }
                    },
                    limits),
                HasSubstr("needs more than 1 s of CPU time; simplify it"));
    limits.idle_seconds = 0.2;
    EXPECT_THAT(
        error_of([](const SendBytes&) { std::this_thread::sleep_for(std::chrono::hours(1)); }, limits),
        HasSubstr("without computing"));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these end where memory is denied
TEST(ConfinedProcess, WantsNoMoreMemoryThanItsShare) {
    ConfinedLimits limits;
    limits.memory = 0.01;
    EXPECT_THAT(error_of(
                    [](const SendBytes& send) {
                        const std::string large(std::size_t{64} << 30U, 'x');
                        send(large);
                    },
                    limits),
                HasSubstr("GB of memory"));
}
#endif

TEST(ConfinedProcess, ShowsNothingOnTheTerminal) {
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    received_from([](const SendBytes&) {
        (void)::write(STDOUT_FILENO, "out\n", 4);
        (void)::write(STDERR_FILENO, "\033[2J\n", 5);
    });
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace samara
