#include "samara/command/progress.hpp"

#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace samara {

Progress::Progress(std::string what, std::string unit)
    : what_(std::move(what)), unit_(std::move(unit)), terminal_(::isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
    if (printed_ && terminal_) fmt::print(stderr, "\r\033[K");
}

void Progress::update(double done, double total) {
    const Clock::time_point now = Clock::now();
    const std::chrono::duration<double> elapsed = now - start_;
    const std::chrono::duration<double> since_last = now - last_;
    if (elapsed.count() < 1.0 || since_last.count() < (terminal_ ? 0.2 : 10.0)) return;
    last_ = now;
    std::string line = fmt::format("{}: {:.0f} of {:.0f} {}", what_, std::floor(done), total, unit_);
    if (done > 0.0) line += fmt::format(", about {:.0f} s left", elapsed.count() * (total - done) / done);
    fmt::print(stderr, "{}{}{}", terminal_ ? "\r\033[K" : "", line, terminal_ ? "" : "\n");
    std::fflush(stderr);
    printed_ = true;
}

}  // namespace samara
