#include "samara/commands/shared/subprocess.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

// A path that cannot be examined, as below a folder that may not be read, is no program.
bool is_program(const std::filesystem::path& path) {
    std::error_code unknown;
    return std::filesystem::is_regular_file(path, unknown) && ::access(path.c_str(), X_OK) == 0;
}

[[noreturn]] void become(std::vector<char*>& words, const char* output, const char* folder) {
    if (output != nullptr) {
        const int descriptor = ::open(output, O_WRONLY | O_CREAT | O_TRUNC, 0666);
        if (descriptor < 0 || ::dup2(descriptor, STDOUT_FILENO) < 0 ||
            ::dup2(descriptor, STDERR_FILENO) < 0) {
            ::_exit(127);
        }
    }
    if (folder != nullptr && ::chdir(folder) != 0) ::_exit(127);
    ::execvp(words.front(), words.data());
    ::_exit(127);
}

}  // namespace

std::optional<std::filesystem::path> find_program(const std::string& name) {
    std::error_code unknown;
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", unknown);
    if (!unknown && is_program(self.parent_path() / name)) return self.parent_path() / name;
    const char* search_path = std::getenv("PATH");
    std::istringstream folders(search_path == nullptr ? "" : search_path);
    for (std::string folder; std::getline(folders, folder, ':');) {
        if (is_program(std::filesystem::path(folder) / name)) return std::filesystem::path(folder) / name;
    }
    return std::nullopt;
}

int run_subprocess(const std::vector<std::string>& words, const std::filesystem::path& output,
                   const std::filesystem::path& folder) {
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);
    const pid_t child = ::fork();
    if (child < 0) throw Error(fmt::format("{}: cannot be started: {}", words.front(), std::strerror(errno)));
    if (child == 0) {
        become(pointers, output.empty() ? nullptr : output.c_str(),
               folder.empty() ? nullptr : folder.c_str());
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0) {
        if (errno != EINTR)
            throw Error(fmt::format("{}: could not be waited for: {}", words.front(), std::strerror(errno)));
    }
    if (WIFSIGNALED(status)) return 128 + WTERMSIG(status);
    const int exit_status = WEXITSTATUS(status);
    if (exit_status == 127) {
        throw Error(fmt::format("{}: cannot be started; is it installed?", words.front()));
    }
    return exit_status;
}

}  // namespace samara
