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

/// Returns 1 / sqrt(x) in single precision, to about 3e-7: the processor's estimate (at least 11 bits) and
/// one Newton step, several times as fast as a division and a root.
template <class Tag>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<Tag> inverse_root(Tag tag, hwy::HWY_NAMESPACE::Vec<Tag> x) {
    namespace hn = hwy::HWY_NAMESPACE;
    const auto guess = hn::ApproximateReciprocalSqrt(x);
    const auto half = hn::Mul(hn::Set(tag, 0.5F), x);
    return hn::Mul(guess, hn::NegMulAdd(half, hn::Mul(guess, guess), hn::Set(tag, 1.5F)));
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
