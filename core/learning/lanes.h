#pragma once

#include <stddef.h>

// Vectors of floats for the kernels, by the compiler's own vector types. Included only by the kernels' translation
// units, which are compiled under different instruction sets: everything has internal linkage and no standard header
// with inline functions comes along, so that the linker never takes code of one set for another.

namespace mrose {
namespace {

template <int N>
struct LanesOf {
    typedef float Type __attribute__((vector_size(N * sizeof(float))));
    typedef float Unaligned __attribute__((vector_size(N * sizeof(float)), aligned(sizeof(float)), may_alias));
};

template <int N>
using Lanes = typename LanesOf<N>::Type;

template <int N>
[[gnu::always_inline]] inline Lanes<N> load(const float* from) {
    return *reinterpret_cast<const typename LanesOf<N>::Unaligned*>(from);
}

template <int N>
[[gnu::always_inline]] inline void store(float* to, Lanes<N> values) {
    *reinterpret_cast<typename LanesOf<N>::Unaligned*>(to) = values;
}

}  // namespace
}  // namespace mrose
