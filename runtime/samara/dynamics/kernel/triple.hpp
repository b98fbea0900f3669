#pragma once

#include <hwy/base.h>

/// Of the kernel's functions: all are inlined into one that keeps its numbers in registers. Not under
/// sanitizers, whose checks would make that one too large to compile.
#ifdef SAMARA_SANITIZED
#define SAMARA_INLINE inline
#else
#define SAMARA_INLINE HWY_INLINE
#endif

namespace samara {

/// Three numbers: a vector whose components are plain numbers, or as many lanes of them as the machine holds.
template <class Number>
struct Triple {
    Number x, y, z;
};

/// A 3x3 matrix by its rows.
template <class Number>
struct Square {
    Triple<Number> x, y, z;
};

}  // namespace samara
