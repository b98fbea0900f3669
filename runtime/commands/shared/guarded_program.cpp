#include "samara/commands/shared/guarded_program.hpp"

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "samara/commands/shared/print.hpp"

namespace samara {
namespace {

/// Reads of standard input find an end, and writes to standard output fail, as with the closed streams.
void open_closed_streams() {
    constexpr int as_closed[] = {O_RDONLY, O_RDONLY, O_WRONLY};
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
        // The lowest number that is free is given: this one, since those below are open.
        if (::fcntl(stream, F_GETFD) < 0) (void)::open("/dev/null", as_closed[stream]);
    }
}

/// A handler rather than SIG_IGN, since programs that are started would inherit that.
void make_errors_of(int signal) {
    struct sigaction action = {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) return;
    action.sa_handler = [](int) {};
    action.sa_flags = SA_RESTART;
    ::sigaction(signal, &action, nullptr);
}

std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
    return text;
}

/// What is wrong, for people.
std::string error_of(const std::exception& error) {
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) {
        return "out of memory; use fewer triangles, bodies, frames or runs";
    }
    if (dynamic_cast<const std::length_error*>(&error) != nullptr) {
        return "more numbers are asked for than any memory holds; is a count or unit wrong?";
    }
    if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error)) {
        return fmt::format("{}: cannot be used: {}", file->path1().string(), file->code().message());
    }
    return one_line(error.what());
}

/// Where standard output cannot be written, standard error says so.
void print_as_json(const std::string& error) noexcept {
    try {
        print_json({{"error", error}});
        flush_output();
    } catch (const std::exception&) {
        return;
    }
}

}  // namespace

int run_guarded(const std::string& program, const std::function<void()>& work, bool as_json) {
    open_closed_streams();
    make_errors_of(SIGPIPE);
    make_errors_of(SIGXFSZ);
    try {
        work();
        flush_output();
        return 0;
    } catch (const std::exception& error) {
        const std::string text = error_of(error);
        std::fflush(stdout);
        if (as_json) print_as_json(text);
        print_note("{}: {}\n", program, text);
        return 1;
    }
}

}  // namespace samara
