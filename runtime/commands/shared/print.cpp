#include "samara/commands/shared/print.hpp"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>

#include <fmt/format.h>
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

Progress::Progress(const std::string& what, std::string unit)
    : what_(printable(what)), unit_(std::move(unit)), terminal_(::isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
    if (printed_ && terminal_) write_to_standard_error("\r\033[K");
}

void Progress::update(double done, double total) {
    const Clock::time_point now = Clock::now();
    const std::chrono::duration<double> elapsed = now - start_;
    const std::chrono::duration<double> since_last = now - last_;
    if (elapsed.count() < 1.0 || since_last.count() < (terminal_ ? 0.2 : 10.0)) return;
    last_ = now;
    std::string line = fmt::format("{}: {:.0f} of {:.0f} {}", what_, std::floor(done), total, unit_);
    if (done > 0.0) line += fmt::format(", about {:.0f} s left", elapsed.count() * (total - done) / done);
    write_to_standard_error(fmt::format("{}{}{}", terminal_ ? "\r\033[K" : "", line, terminal_ ? "" : "\n"));
    printed_ = true;
}

}  // namespace samara
