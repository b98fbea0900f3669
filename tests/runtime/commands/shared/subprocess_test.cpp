#include "samara/commands/shared/subprocess.hpp"

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "support/temporary_folder.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

/// The environment's PATH begins with a folder, and ends with one that holds the program "wanted".
class Search : public testing::Test {
  protected:
    Search() {
        fs::permissions(wanted_, fs::perms::owner_all | fs::perms::group_exec | fs::perms::others_all);
    }
    ~Search() override { ::setenv("PATH", usual_.c_str(), 1); }
    Search(const Search&) = delete;
    Search& operator=(const Search&) = delete;

    [[nodiscard]] std::optional<fs::path> found_after(const fs::path& first) const {
        ::setenv("PATH", (first.string() + ":" + wanted_.parent_path().string()).c_str(), 1);
        return find_program("wanted");
    }

    const std::string usual_ = std::getenv("PATH");
    const test::TemporaryFolder folder_;
    const fs::path wanted_ = folder_.file("bin/wanted", "#!/bin/sh\n");
};

TEST_F(Search, FindsTheProgramInALaterFolder) {
    EXPECT_EQ(found_after(folder_ / "nowhere"), wanted_);
    EXPECT_EQ(found_after(""), wanted_);
    EXPECT_EQ(find_program("no such program"), std::nullopt);
}

TEST_F(Search, PassesOverFilesThatAreNoPrograms) {
    EXPECT_EQ(found_after(folder_.file("other/wanted", "text").parent_path()), wanted_);
    EXPECT_EQ(found_after(wanted_), wanted_);
    fs::create_directories(folder_ / "third/wanted");
    EXPECT_EQ(found_after(folder_ / "third"), wanted_);
}

TEST_F(Search, PassesOverFoldersThatCannotBeLookedAt) {
    fs::create_symlink("loop", folder_ / "loop");
    EXPECT_EQ(found_after(folder_ / "loop"), wanted_);
    EXPECT_EQ(found_after("/" + std::string(300, 'x')), wanted_);
    std::string longest;
    for (int i = 0; i < 3000; ++i) longest += "/x";
    EXPECT_EQ(found_after(longest), wanted_);

    // Root may look everywhere.
    const fs::path closed = folder_.file("closed/wanted", "#!/bin/sh\n").parent_path();
    fs::permissions(folder_.path(), fs::perms::all);
    fs::permissions(closed, fs::perms::none);
    const uid_t user = ::geteuid();
    constexpr uid_t nobody = 65534;
    if (user == 0) {
        ASSERT_EQ(::seteuid(nobody), 0);
    }
    EXPECT_EQ(found_after(closed), wanted_);
    if (user == 0) {
        ASSERT_EQ(::seteuid(user), 0);
    }
    fs::permissions(closed, fs::perms::owner_all);
}

}  // namespace
}  // namespace samara
