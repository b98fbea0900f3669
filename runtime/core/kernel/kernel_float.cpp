#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "samara/core/kernel/kernel_float.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for each target.
#include <hwy/highway.h>

#include "samara/core/kernel/blocks-inl.h"
#include "samara/core/kernel/kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

BatchReport advance_float_blocks(const FlightConstants<float>& constants, const kernel::BlockSteps& steps,
                                 FlightBlock<float>* blocks, std::size_t count) {
    return advance_all(constants, steps, blocks, count);
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace samara {

HWY_EXPORT(advance_float_blocks);

BatchReport kernel::advance_blocks(const FlightConstants<float>& constants, const BlockSteps& steps,
                                   FlightBlock<float>* blocks, std::size_t count) noexcept {
    return HWY_DYNAMIC_DISPATCH(advance_float_blocks)(constants, steps, blocks, count);
}

}  // namespace samara
#endif
