#include "samara/commands/shared/progress.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "samara/commands/shared/print.hpp"
#include "samara/core/base/text.hpp"

namespace samara {

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
