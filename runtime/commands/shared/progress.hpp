#pragma once

#include <chrono>
#include <string>

namespace samara {

/// Progress on standard error: "baking: 4 of 15 cases, about 40 s left". On a terminal one line that is
/// rewritten; else a line every ten seconds, so that a log stays short. Nothing is printed for work that
/// takes less than a second.
class Progress {
  public:
    /// `what`: the work, as in "baking"; `unit`: what is counted, as in "cases".
    Progress(const std::string& what, std::string unit);
    /// Clears a terminal's line.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void update(double done, double total);

  private:
    using Clock = std::chrono::steady_clock;

    std::string what_;
    std::string unit_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_ = start_;
    bool terminal_;
    bool printed_ = false;
};

}  // namespace samara
