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

/// The first `count` of N values, count <= N: in few and wide stores.
template <int N>
[[gnu::always_inline]] inline void storeFirst(float* to, Lanes<N> values, int count) {
    if (count == N) return store<N>(to, values);
    if constexpr (N == 8) {
        Lanes<4> rest = __builtin_shufflevector(values, values, 0, 1, 2, 3);
        if (count >= 4) {
            store<4>(to, rest);
            rest = __builtin_shufflevector(values, values, 4, 5, 6, 7);
            to += 4;
        }
        storeFirst<4>(to, rest, count % 4);
    } else {
        for (int i = 0; i < N - 1; ++i)
            if (i < count) to[i] = values[i];
    }
}

/// to[column][row] = from[row][column] of 4 x 4 numbers.
[[gnu::always_inline]] inline void transpose4(const float* from, size_t fromStride, float* to, size_t toStride) {
    const Lanes<4> a = load<4>(from), b = load<4>(from + fromStride);
    const Lanes<4> c = load<4>(from + 2 * fromStride), d = load<4>(from + 3 * fromStride);
    const Lanes<4> ab01 = __builtin_shufflevector(a, b, 0, 4, 1, 5), ab23 = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Lanes<4> cd01 = __builtin_shufflevector(c, d, 0, 4, 1, 5), cd23 = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    store<4>(to, __builtin_shufflevector(ab01, cd01, 0, 1, 4, 5));
    store<4>(to + toStride, __builtin_shufflevector(ab01, cd01, 2, 3, 6, 7));
    store<4>(to + 2 * toStride, __builtin_shufflevector(ab23, cd23, 0, 1, 4, 5));
    store<4>(to + 3 * toStride, __builtin_shufflevector(ab23, cd23, 2, 3, 6, 7));
}

}  // namespace
}  // namespace mrose
