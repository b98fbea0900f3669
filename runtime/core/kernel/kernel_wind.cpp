#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "samara/core/kernel/kernel_wind.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for each target.
#include <hwy/highway.h>

#include "samara/core/kernel/wind-inl.h"
#include "samara/core/kernel/wind_constants.hpp"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

/// Loads and stores numbers of the lanes from `first` on.
template <class V>
struct WindLanes;
template <>
struct WindLanes<double> {
    static HWY_INLINE double load(const double* row) { return *row; }
    static HWY_INLINE void store(double value, double* row) { *row = value; }
};
template <class Tag>
struct WindLanes<Lanes<Tag>> {
    static HWY_INLINE Lanes<Tag> load(const double* row) { return hn::Load(Tag(), row); }
    static HWY_INLINE void store(Lanes<Tag> value, double* row) { hn::Store(value.raw, Tag(), row); }
};

template <class V>
HWY_INLINE void blow_lanes(const WindConstants& wind, double time, std::size_t first, WindBlock& block) {
    using At = WindLanes<V>;
    const Triple<V> place{At::load(block.place[0] + first), At::load(block.place[1] + first),
                          At::load(block.place[2] + first)};
    const WindThere<V> there = wind_at(wind, place, V(time));
    const auto keep = [&](const Triple<V>& from, double(*to)[WindBlock::size]) HWY_ATTR {
        At::store(from.x, to[0] + first);
        At::store(from.y, to[1] + first);
        At::store(from.z, to[2] + first);
    };
    keep(there.velocity, block.velocity);
    keep(there.gradient.x, block.gradient);
    keep(there.gradient.y, block.gradient + 3);
    keep(there.gradient.z, block.gradient + 6);
    keep(there.rate, block.rate);
}

void blow_block(const WindConstants& wind, double time, std::size_t count, WindBlock& block) {
    if (count == 1) return blow_lanes<double>(wind, time, 0, block);
    using Tag = hn::CappedTag<double, WindBlock::size>;
    for (std::size_t first = 0; first < count; first += hn::Lanes(Tag())) {
        blow_lanes<Lanes<Tag>>(wind, time, first, block);
    }
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace samara {

HWY_EXPORT(blow_block);

void kernel::blow(const WindConstants& wind, double time, std::size_t count, WindBlock& block) noexcept {
    HWY_DYNAMIC_DISPATCH(blow_block)(wind, time, count, block);
}

}  // namespace samara
#endif
