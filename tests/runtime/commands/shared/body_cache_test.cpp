#include "samara/commands/shared/body_cache.hpp"

#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "samara/commands/shared/scene_bodies.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/known_bodies.hpp"
#include "support/program_run.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using test::run_program_in;
using test::TemporaryFolder;

/// While it lives, a variable of the environment has another value; null: none.
class Variable {
  public:
    Variable(const char* name, const char* value) : name_(name) {
        const char* before = std::getenv(name);
        if (before != nullptr) before_ = before;
        set(value);
    }
    ~Variable() { set(before_ ? before_->c_str() : nullptr); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    void set(const char* value) const {
        if (value == nullptr) {
            ::unsetenv(name_);
        } else {
            ::setenv(name_, value, 1);
        }
    }

    const char* name_;
    std::optional<std::string> before_;
};

std::vector<std::filesystem::path> entries_in(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> entries;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) entries.push_back(entry.path());
    return entries;
}

mode_t rights_of(const std::filesystem::path& path) {
    struct stat status = {};
    ::stat(path.c_str(), &status);
    return status.st_mode & 0777U;
}

TEST(BodyCache, KeepsABodyUnderAKeyInAFolderOfTheUsersOwn) {
    const TemporaryFolder folder;
    const Variable here("SAMARA_CACHE", (folder / "cache").c_str());
    const BodyCache cache;
    EXPECT_FALSE(cache.find("a").has_value());
    const Body body = test::rubber_ellipsoid();
    cache.keep("a", body);
    EXPECT_EQ(rights_of(folder / "cache"), 0700U);
    const auto kept = cache.find("a");
    ASSERT_TRUE(kept.has_value());
    EXPECT_EQ(kept->surface.vertices, body.surface.vertices);
    EXPECT_EQ(kept->kirchhoff->matrix, body.kirchhoff->matrix);
    EXPECT_FALSE(cache.find("b").has_value());
}

TEST(BodyCache, LiesInTheUsersCacheUnlessItIsOff) {
    const TemporaryFolder folder;
    const Variable no_choice("SAMARA_CACHE", nullptr);
    const Variable home("HOME", (folder / "home").c_str());
    {
        const Variable common("XDG_CACHE_HOME", (folder / "common").c_str());
        BodyCache().keep("a", test::rubber_ellipsoid());
        EXPECT_EQ(entries_in(folder / "common/samara").size(), 1U);
    }
    {
        const Variable none("XDG_CACHE_HOME", nullptr);
        BodyCache().keep("a", test::rubber_ellipsoid());
        EXPECT_EQ(entries_in(folder / "home/.cache/samara").size(), 1U);
        const Variable off("SAMARA_CACHE", "off");
        EXPECT_FALSE(BodyCache().find("a").has_value());
    }
}

TEST(BodyCache, DoesWithoutAPlaceThatIsMissingOrOpenToOthers) {
    const TemporaryFolder folder;
    (void)folder.file("file", "");
    std::filesystem::create_directory(folder / "open");
    std::filesystem::permissions(folder / "open", std::filesystem::perms(0755));
    for (const char* place : {"file", "file/below", "open"}) {
        const Variable here("SAMARA_CACHE", (folder / place).c_str());
        const BodyCache cache;
        cache.keep("a", test::rubber_ellipsoid());
        EXPECT_FALSE(cache.find("a").has_value()) << place;
    }
    EXPECT_TRUE(entries_in(folder / "open").empty());
    const Variable no_choice("SAMARA_CACHE", nullptr);
    const Variable no_common("XDG_CACHE_HOME", nullptr);
    const Variable no_home("HOME", nullptr);
    BodyCache().keep("a", test::rubber_ellipsoid());
    EXPECT_FALSE(BodyCache().find("a").has_value());
}

TEST(BodyCache, MakesDamagedEntriesAnew) {
    const TemporaryFolder folder;
    const Variable here("SAMARA_CACHE", (folder / "cache").c_str());
    const BodyCache cache;
    cache.keep("a", test::rubber_ellipsoid());
    const std::filesystem::path entry = entries_in(folder / "cache").front();
    const std::string bytes = read_bytes(entry);
    std::string turned = bytes;
    turned[bytes.size() / 2] = static_cast<char>(turned[bytes.size() / 2] ^ 0x55);
    for (const std::string& damage : {std::string(), bytes.substr(0, bytes.size() / 2), turned}) {
        std::ofstream(entry, std::ios::binary) << damage;
        EXPECT_FALSE(cache.find("a").has_value());
        EXPECT_FALSE(std::filesystem::exists(entry)) << "it is gone";
        cache.keep("a", test::rubber_ellipsoid());
        EXPECT_TRUE(cache.find("a").has_value());
    }
}

TEST(BodyCache, RemovesWhatWasLongestNotUsed) {
    const TemporaryFolder folder;
    const Variable here("SAMARA_CACHE", (folder / "cache").c_str());
    BodyCache().keep("a", test::rubber_ellipsoid());
    const auto bytes = std::filesystem::file_size(entries_in(folder / "cache").front());
    const BodyCache cache(5 * bytes / 2);
    using namespace std::chrono_literals;
    const auto age = [&](const char* key) {
        const auto entry = folder / "cache" / (content_hash(key) + ".body.h5");
        std::filesystem::last_write_time(entry, std::filesystem::file_time_type::clock::now() - 1h);
    };
    cache.keep("b", test::rubber_ellipsoid());
    age("a");
    age("b");
    EXPECT_TRUE(cache.find("a").has_value()) << "which is a use";
    cache.keep("c", test::rubber_ellipsoid());
    EXPECT_TRUE(cache.find("a").has_value());
    EXPECT_FALSE(cache.find("b").has_value());
    EXPECT_TRUE(cache.find("c").has_value());
}

TEST(BodyCache, TellsFilesApartByNameAndBytesAndLeavesOutScriptsThatLookElsewhere) {
    const TemporaryFolder folder;
    const auto key = [&](const char* name, const char* text) { return body_key(folder.file(name, text)); };
    EXPECT_EQ(key("a/leaf.stl", "solid"), key("b/leaf.stl", "solid"));
    EXPECT_NE(key("a/leaf.stl", "solid"), key("a/leaf.stl", "solid "));
    EXPECT_NE(key("a/leaf.stl", "solid"), key("a/seed.stl", "solid"));
    EXPECT_TRUE(key("plain.geo", "// Gmsh project\nDefineConstant[ r = 1 ];\nSphere(1) = {0, 0, 0, r};"));
    for (const char* script : {"Include \"parts.geo\";", "Merge 'a.stl';", "ShapeFromFile('a.step');",
                               "r = Rand(1);", "If(FileExists('a')) EndIf", "Field[1].FileName = 'sizes';",
                               "s = GetEnv('SIZE');", "Printf(Today);", "Call Str('Incl');"}) {
        EXPECT_FALSE(key("script.geo", script)) << script;
        EXPECT_FALSE(key("script.GEO", script)) << script;
    }
}

TEST(BodyCache, ServesTheNextRunOfASceneToTheLastByte) {
    const TemporaryFolder folder;
    Body body = test::rubber_ellipsoid();
    body.kirchhoff.reset();
    write_body_file(folder / "bare.body.h5", body);
    (void)folder.file("scene.toml",
                      "[scene]\nduration = 0.1\n[[body]]\nname = \"bare\"\nshape = \"bare.body.h5\"\n"
                      "density = 1200\nloads = \"surface\"\n");
    const auto flown = [&](const std::string& environment) {
        const auto run =
            run_program_in(folder, {"samara", "simulate", "scene.toml", "-o", "motion.h5"}, environment);
        EXPECT_EQ(run.status, 0) << run.error;
        return file_content_hash(folder / "motion.h5");
    };
    const std::string without = flown("SAMARA_CACHE=off");
    EXPECT_EQ(flown("SAMARA_CACHE=cache"), without);
    ASSERT_EQ(entries_in(folder / "cache").size(), 1U);
    EXPECT_EQ(flown("SAMARA_CACHE=cache"), without);
    EXPECT_EQ(entries_in(folder / "cache").size(), 1U);
}

TEST(SceneBodies, OfOneProcessAreReadAndPreparedOnceAsLongAsTheFileStays) {
    const TemporaryFolder folder;
    write_body_file(folder / "rubber.body.h5", test::rubber_ellipsoid());
    Scene scene;
    SceneBody body = test::scene_body(1200.0);
    body.shape = folder / "rubber.body.h5";
    scene.bodies = {body, body};
    const auto first = load_scene_bodies(scene, "");
    const auto second = load_scene_bodies(scene, "");
    EXPECT_EQ(first[0].body, first[1].body);
    EXPECT_EQ(first[0].body, second[0].body);
    EXPECT_EQ(first[0].prepared, second[0].prepared);
    Body other = test::rubber_ellipsoid();
    other.source = "another";
    write_body_file(folder / "rubber.body.h5", other);
    EXPECT_EQ(load_scene_bodies(scene, "")[0].body->source, "another");
}

}  // namespace
}  // namespace samara
