#include "foam-cases/farm/guarded_process.hpp"

#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

// Whether the process of that id still runs (a zombie does not).
bool runs(const std::string& id) {
    const fs::path status = fs::path("/proc") / id / "stat";
    std::error_code unknown;
    if (!fs::exists(status, unknown)) return false;
    try {
        const std::string text = read_bytes(status);
        return text[text.rfind(')') + 2] != 'Z';
    } catch (const Error&) {
        return false;
    }
}

bool comes_true(const std::function<bool()>& condition) {
    for (int i = 0; i < 500; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
}

const std::vector<std::string> script_with_a_child = {"sh", "-c",
                                                      "sleep 60 & echo $! > child; mv child child.id; wait"};

std::string child_id(const fs::path& folder) {
    std::string id = read_bytes(folder / "child.id");
    id.pop_back();
    return id;
}

TEST(GuardedProcess, ReturnsTheExitStatusAndKeepsTheOutput) {
    const test::TemporaryFolder folder;
    const auto status =
        run_guarded({"sh", "-c", "pwd; echo fault >&2; exit 7"}, folder.path() / "log", folder.path(), [] {});
    EXPECT_EQ(status, 7);
    EXPECT_EQ(read_bytes(folder.path() / "log"), folder.path().string() + "\nfault\n");
}

TEST(GuardedProcess, OfAProgramThatIsNotThereIsAnError) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(run_guarded({"no-such-program"}, folder.path() / "log", folder.path(), [] {}), Error);
}

TEST(GuardedProcess, EndsWithAllItsChildrenOnAnInterruption) {
    const test::TemporaryFolder folder;
    bool sent = false;
    const auto status = run_guarded(script_with_a_child, folder.path() / "log", folder.path(), [&] {
        if (!sent && fs::exists(folder.path() / "child.id")) {
            sent = true;
            ::raise(SIGINT);
        }
    });
    EXPECT_EQ(status, std::nullopt);
    EXPECT_TRUE(comes_true([&] { return !runs(child_id(folder.path())); }));
}

TEST(GuardedProcess, EndsWithAllItsChildrenWhenItsParentIsKilled) {
    const test::TemporaryFolder folder;
    const pid_t parent = ::fork();
    if (parent == 0) {
        run_guarded(script_with_a_child, folder.path() / "log", folder.path(), [] {});
        ::_exit(0);
    }
    ASSERT_TRUE(comes_true([&] { return fs::exists(folder.path() / "child.id"); }));
    const std::string id = child_id(folder.path());
    EXPECT_TRUE(runs(id));
    ::kill(parent, SIGKILL);
    ::waitpid(parent, nullptr, 0);
    EXPECT_TRUE(comes_true([&] { return !runs(id); }));
}

TEST(FolderLock, KeepsOthersOutWhileItLives) {
    const test::TemporaryFolder folder;
    {
        const FolderLock lock(folder.path());
        EXPECT_THROW(FolderLock second(folder.path()), Error);
    }
    EXPECT_NO_THROW(FolderLock third(folder.path()));
}

}  // namespace
}  // namespace samara
