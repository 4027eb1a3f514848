#pragma once

// Elementary functions of our own, from + - * / and comparisons alone: the same bits on every machine, for float and
// for vectors of it. Everything has internal linkage, because this header is compiled under several instruction sets.

namespace mrose {
namespace {

/// tanh for T = float or a GCC vector of floats. Odd, exact at 0, absolute error below 3.5e-7, +-1 from |x| = 8.991 on,
/// NaN for NaN. A rational minimax fit x P(x^2) / Q(x^2) of degrees 4 and 4 on |x| <= 9.01 (own fit, error 1.9e-8
/// before rounding), summed in Estrin's order: short chains matter when one robot is predicted alone.
template <class T>
[[gnu::always_inline]] inline T rationalTanh(T x) {
    const T limit = T{} + 8.99004555f, one = T{} + 1.0f;
    // beyond this limit, at which the fit rounds to 1, it stays there
    T z = x > limit ? limit : x;
    z = z < -limit ? -limit : z;
    const T u = z * z;
    const T uu = u * u;
    const T p = (0.9999999053863491f + 0.1337252806012036f * u) +
                uu * ((3.4857893363450902e-3f + 2.0458882324010427e-5f * u) + 1.3166426038200584e-8f * uu);
    const T q = (1.0f + 0.46705824569364335f * u) +
                uu * ((2.5838957117087745e-2f + 3.27009349977713e-4f * u) + 7.69535056711818e-7f * uu);
    T t = z * p / q;
    t = t > one ? one : t;
    return t < -one ? -one : t;
}

}  // namespace
}  // namespace mrose
