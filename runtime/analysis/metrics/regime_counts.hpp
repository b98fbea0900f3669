#pragma once

#include <array>

#include "samara/motion/measures.hpp"

namespace samara {

/// The interval (from, to) that holds the probability of an outcome seen `count` times in `samples` with 95 %
/// confidence: Wilson, Probable inference, the law of succession, and statistical inference, JASA 22, 1927.
std::array<double, 2> wilson_interval(int count, int samples);

/// How many falls are of each regime.
struct RegimeCounts {
    std::array<int, static_cast<std::size_t>(Regime::autorotating) + 1> counts =
        {};  ///< in the enumeration's order

    void add(Regime regime) { ++counts[static_cast<std::size_t>(regime)]; }
    [[nodiscard]] int of(Regime regime) const { return counts[static_cast<std::size_t>(regime)]; }
    [[nodiscard]] int total() const;
    /// The regime of most falls; the first in the enumeration of equals.
    [[nodiscard]] Regime commonest() const;
    /// The share of the falls that are of a regime; 0 without falls.
    [[nodiscard]] double share(Regime regime) const;
    /// 95 % interval of the commonest regime's share: see wilson_interval().
    [[nodiscard]] std::array<double, 2> confidence() const;

    bool operator==(const RegimeCounts&) const = default;
};

}  // namespace samara
