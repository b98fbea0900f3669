// Included once for each instruction set (Highway), hence no plain include guard.
#if defined(SAMARA_INVERSE_ROOT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SAMARA_INVERSE_ROOT_INL_H
#undef SAMARA_INVERSE_ROOT_INL_H
#else
#define SAMARA_INVERSE_ROOT_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

/// Returns 1 / sqrt(x) for x from about 1e-30 to 1e30, to about 1e-13: the single-precision estimate (at
/// least 11 bits) and two Newton steps, several times as fast as a division and a root. With one step to
/// 3e-7.
template <int newton_steps = 2, class Tag>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<Tag> inverse_root(Tag tag, hwy::HWY_NAMESPACE::Vec<Tag> x) {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::Rebind<float, Tag> single;
    const auto half = hn::Mul(hn::Set(tag, 0.5), x);
    auto root = hn::PromoteTo(tag, hn::ApproximateReciprocalSqrt(hn::DemoteTo(single, x)));
    for (int i = 0; i < newton_steps; ++i) {
        root = hn::Mul(root, hn::NegMulAdd(half, hn::Mul(root, root), hn::Set(tag, 1.5)));
    }
    return root;
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
