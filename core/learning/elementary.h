#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

// Elementary functions of our own, from + - * / and comparisons alone: the same bits on every machine, for float and
// for vectors of it. Everything has internal linkage, because this header is compiled under several instruction sets.

namespace mrose {
namespace {

/// a < b ? a : b, lane by lane: b if either is NaN. In one instruction, which compilers do not find for vectors.
template <class T>
[[gnu::always_inline]] inline T lesser(T a, T b) {
#if defined(__SSE2__)
    if constexpr (sizeof(T) == 16) return (T)_mm_min_ps(a, b);
#endif
#if defined(__AVX__)
    if constexpr (sizeof(T) == 32) return (T)_mm256_min_ps(a, b);
#endif
#if defined(__AVX512F__)
    // the masked form: the plain one warns in GCC 12
    if constexpr (sizeof(T) == 64) return (T)_mm512_maskz_min_ps(0xffff, a, b);
#endif
    return a < b ? a : b;
}

/// a > b ? a : b, likewise.
template <class T>
[[gnu::always_inline]] inline T greater(T a, T b) {
#if defined(__SSE2__)
    if constexpr (sizeof(T) == 16) return (T)_mm_max_ps(a, b);
#endif
#if defined(__AVX__)
    if constexpr (sizeof(T) == 32) return (T)_mm256_max_ps(a, b);
#endif
#if defined(__AVX512F__)
    if constexpr (sizeof(T) == 64) return (T)_mm512_maskz_max_ps(0xffff, a, b);
#endif
    return a > b ? a : b;
}

/// x between -limit and limit; NaN stays NaN.
template <class T>
[[gnu::always_inline]] inline T clamped(T x, float limit) {
    const T bound = T{} + limit;
    return greater(-bound, lesser(bound, x));
}

/// tanh for T = float or a GCC vector of floats. Odd, exact at 0, absolute error below 3.5e-7, +-1 from |x| = 8.991 on,
/// NaN for NaN. A rational minimax fit x P(x^2) / Q(x^2) of degrees 4 and 4 on |x| <= 9.01 (own fit, error 1.9e-8
/// before rounding), summed in Estrin's order: short chains matter when one robot is predicted alone.
template <class T>
[[gnu::always_inline]] inline T rationalTanh(T x) {
    const T z = clamped(x, 8.99004555f);  // where the fit rounds to 1
    const T u = z * z;
    const T uu = u * u;
    const T p = (0.9999999053863491f + 0.1337252806012036f * u) +
                uu * ((3.4857893363450902e-3f + 2.0458882324010427e-5f * u) + 1.3166426038200584e-8f * uu);
    const T q = (1.0f + 0.46705824569364335f * u) +
                uu * ((2.5838957117087745e-2f + 3.27009349977713e-4f * u) + 7.69535056711818e-7f * uu);
    return clamped(z * p / q, 1.0f);
}

}  // namespace
}  // namespace mrose
