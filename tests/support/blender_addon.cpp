#include "support/blender_addon.hpp"

#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/temporary_folder.hpp"

namespace samara::test {

namespace {

nlohmann::json found_by(const std::vector<std::string>& blender, const std::vector<std::string>& task) {
    const TemporaryFolder folder;
    std::string modules = folder.file("python/samara/__init__.py", "").parent_path().parent_path().string();
    if (const char* others = std::getenv("PYTHONPATH")) modules += fmt::format(":{}", others);
    std::vector<std::string> words = {"env", fmt::format("PYTHONPATH={}", modules),
                                      fmt::format("BLENDER_USER_SCRIPTS={}", (folder / "scripts").string()),
                                      fmt::format("BLENDER_USER_CONFIG={}", (folder / "config").string()),
                                      fmt::format("TMPDIR={}", folder.path().string())};
    words.insert(words.end(), blender.begin(), blender.end());
    const std::string script = SAMARA_SOURCE_DIRECTORY "/tests/tools/use_addon.py";
    const std::vector<std::string> options = {
        "--factory-startup", "--python-exit-code", "3", "--python", script, "--", SAMARA_BLENDER_ZIP};
    words.insert(words.end(), options.begin(), options.end());
    words.insert(words.end(), task.begin(), task.end());
    const int status = run_subprocess(words, folder / "log");
    const std::string log = read_bytes(folder / "log");
    EXPECT_EQ(status, 0) << log;
    EXPECT_EQ(log.find("Traceback"), std::string::npos) << log;
    const std::size_t place = log.find("\nFOUND ");
    if (place == std::string::npos) {
        ADD_FAILURE() << "Blender found nothing:\n" << log;
        return {};
    }
    return nlohmann::json::parse(log.substr(place + 7, log.find('\n', place + 7) - place - 7));
}

}  // namespace

nlohmann::json use_addon(const std::vector<std::string>& task) {
    return found_by({"blender", "-b"}, task);
}

nlohmann::json use_addon_in_window(const std::vector<std::string>& task) {
    return found_by({"xvfb-run", "-a", "-s", "-screen 0 640x480x24 -nolisten tcp", "blender",
                     "--enable-event-simulate", "--window-geometry", "0", "0", "640", "480"},
                    task);
}

}  // namespace samara::test
