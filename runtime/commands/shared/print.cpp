#include "samara/commands/shared/print.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/text.hpp"

namespace samara {
namespace {

[[noreturn]] void fail_to_print() {
    const int reason = errno;
    throw Error(fmt::format("standard output cannot be written: {}", std::strerror(reason)));
}

}  // namespace

void print_result_text(std::string_view text) {
    const std::string shown = printable_lines(text);
    if (std::fwrite(shown.data(), 1, shown.size(), stdout) != shown.size()) fail_to_print();
}

void print_json(const nlohmann::json& result) {
    print_result("{}\n", result.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
}

void flush_output() {
    if (std::fflush(stdout) != 0) fail_to_print();
}

void write_to_standard_error(std::string_view bytes) noexcept {
    while (!bytes.empty()) {
        const ssize_t written = ::write(STDERR_FILENO, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

void print_note_text(std::string_view text) {
    write_to_standard_error(printable_lines(text));
}

}  // namespace samara
