#pragma once

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "paths.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/program_run.hpp"
#include "support/temporary_folder.hpp"

namespace samara::test {

/// A folder for bakes: out.body.h5 with its cases in out.cases.
class BakeFolder : public testing::Test {
  protected:
    using Path = std::filesystem::path;

    const TemporaryFolder temporary_;
    const Path folder_ = temporary_.path();
    const Path output_ = folder_ / "out.body.h5";
    const Path cases_ = folder_ / "out.cases";

    Path write_body(const Body& body) {
        const Path file = folder_ / (body.name + ".body.h5");
        write_body_file(file, body);
        return file;
    }

    /// `words`: the command line without the program, words separated by spaces.
    [[nodiscard]] ProgramRun bake(const std::string& words, const std::string& environment = "") const {
        std::istringstream stream(words);
        std::vector<std::string> list = {"samara-bake"};
        for (std::string word; stream >> word;) list.push_back(word);
        return run_program_in(temporary_, list, environment);
    }

    /// When each of the meshes or cases was made or solved, by the records of that name.
    [[nodiscard]] std::map<std::string, std::filesystem::file_time_type> made(
        const std::string& record) const {
        std::map<std::string, std::filesystem::file_time_type> found;
        if (!std::filesystem::exists(cases_)) return found;
        for (const auto& entry : std::filesystem::directory_iterator(cases_)) {
            const Path file = entry.path() / record;
            std::error_code missing;
            const auto time = std::filesystem::last_write_time(file, missing);
            if (!missing) found[entry.path().filename()] = time;
        }
        return found;
    }
    [[nodiscard]] auto solved() const { return made("provenance.json"); }

    /// Starts a bake of the body at smoke quality, one case at once, and waits until the condition holds. Its
    /// standard error goes to the file stderr.
    [[nodiscard]] pid_t start_until(const Path& body, const std::function<bool()>& condition,
                                    const std::vector<std::string>& more = {}) const {
        std::vector<std::string> words = {(Path(SAMARA_PROGRAMS) / "samara-bake").string(),
                                          body.string(),
                                          "-o",
                                          output_.string(),
                                          "--quality",
                                          "smoke",
                                          "--jobs",
                                          "1"};
        words.insert(words.end(), more.begin(), more.end());
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        const std::string log = (folder_ / "stderr").string();
        const pid_t child = ::fork();
        if (child == 0) {
            if (std::freopen(log.c_str(), "w", stderr) == nullptr) ::_exit(1);
            ::execv(pointers[0], pointers.data());
            ::_exit(1);
        }
        for (int i = 0; i < 6000 && !condition(); ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return child;
    }
    [[nodiscard]] pid_t start_until_first_case(const Path& body) const {
        return start_until(body, [&] { return !solved().empty(); });
    }

    /// A hash of the baked file's bytes, but for what tells how it came about and what the body weighs: bakes
    /// with the same tables have the same.
    [[nodiscard]] std::string data_of(const Path& baked) const {
        Body body = read_body_file(baked);
        body.tables->provenance = "[]";
        body.mass.reset();
        const Path file = folder_ / "data.body.h5";
        write_body_file(file, body);
        return content_hash(read_bytes(file));
    }
};

}  // namespace samara::test
