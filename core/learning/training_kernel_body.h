#pragma once

#include "learning/elementary.h"
#include "learning/lanes.h"
#include "learning/training_kernel.h"

// The training kernels, for N lanes. Lanes are patterns; tiles of sums stay in registers: `Rows` x `Vectors` of them.
// The order of sums is part of their contract, the same for every number of lanes:
//   of a pattern: bias, then the products with inputs (units, outputs on the way back) 0, 1, 2, ... added in order;
//   over patterns, of the gradient and the squared error: 16 partial sums, of the patterns 0, 16, 32, ...; 1, 17, 33,
//   ...; and so on, each in order. Where N is less, 16 / N passes make N of them each: tiles stay in the registers;
//   over patterns, of the Gram matrix: in order.
// Multiplications and additions round separately: compile with -ffp-contract=off.

namespace mrose {
namespace {

constexpr int kPartialSums = 16;

/// Sizes of the tiles of sums: as many as the registers hold.
template <int N>
struct TileSize {
    static constexpr int rows = N == 4 ? 3 : 6, vectors = N == 8 ? 2 : 4;
    static constexpr int dotRows = N == 16 ? 4 : 3, dotColumns = N == 16 ? 5 : 3;
};

/// One operand of a product by the broadcast of its elements: a(m, k) = data[m * row + k * column].
struct Broadcast {
    const float* data;
    size_t row, column;
    [[gnu::always_inline]] Broadcast from(int m) const { return {data + m * row, row, column}; }
};

struct Identity {
    template <class T>
    [[gnu::always_inline]] T operator()(T sum, const float*) const {
        return sum;
    }
};

struct Tanh {
    template <class T>
    [[gnu::always_inline]] T operator()(T sum, const float*) const {
        return rationalTanh(sum);
    }
};

/// out[m][p] = f(start[m] + sum over k of a(m, k) b[k][p]) for a tile of Rows x (Vectors * N). `start` may be null (0).
template <int N, int Rows, int Vectors, class F>
[[gnu::always_inline]] inline void multiplyTile(Broadcast a, const float* start, const float* b, size_t bStride,
                                                int depth, float* out, size_t outStride, F f) {
    Lanes<N> sum[Rows][Vectors];
    for (int m = 0; m < Rows; ++m)
        for (int v = 0; v < Vectors; ++v) sum[m][v] = Lanes<N>{} + (start ? start[m] : 0.0f);
    for (int k = 0; k < depth; ++k, b += bStride, a.data += a.column)
        for (int m = 0; m < Rows; ++m)
            for (int v = 0; v < Vectors; ++v) sum[m][v] += load<N>(b + v * N) * a.data[m * a.row];
    for (int m = 0; m < Rows; ++m)
        for (int v = 0; v < Vectors; ++v) {
            float* to = out + m * outStride + v * N;
            store<N>(to, f(sum[m][v], to));
        }
}

template <int N, int Rows, class F>
void multiplyRows(Broadcast a, const float* start, const float* b, size_t bStride, int depth, float* out,
                  size_t outStride, int columns, F f) {
    constexpr int kVectors = TileSize<N>::vectors;
    int p = 0;
    for (; p + kVectors * N <= columns; p += kVectors * N)
        multiplyTile<N, Rows, kVectors>(a, start, b + p, bStride, depth, out + p, outStride, f);
    for (; p < columns; p += N) multiplyTile<N, Rows, 1>(a, start, b + p, bStride, depth, out + p, outStride, f);
}

/// out[rows][columns] = f(start + a b), b [depth][columns].
template <int N, int Rows, class F>
void multiply(Broadcast a, const float* start, const float* b, size_t bStride, int depth, float* out, size_t outStride,
              int rows, int columns, F f) {
    int m = 0;
    const auto at = [start](int row) { return start ? start + row : start; };
    for (; m + Rows <= rows; m += Rows)
        multiplyRows<N, Rows>(a.from(m), at(m), b, bStride, depth, out + m * outStride, outStride, columns, f);
    if constexpr (Rows > 1)
        multiply<N, Rows - 1>(a.from(m), at(m), b, bStride, depth, out + m * outStride, outStride, rows - m, columns,
                              f);
}

/// One pass: the partial sums of the patterns that `a` and `b` begin with.
template <int N, int Rows, int Columns>
[[gnu::always_inline]] inline void dotPass(const float* a, size_t aStride, const float* b, size_t bStride, int columns,
                                           float* lanes, size_t laneStride) {
    Lanes<N> sum[Rows][Columns];
    for (int m = 0; m < Rows; ++m)
        for (int k = 0; k < Columns; ++k) sum[m][k] = load<N>(lanes + m * laneStride + k * kPartialSums);
    for (int p = 0; p < columns; p += kPartialSums) {
        Lanes<N> left[Rows];
        for (int m = 0; m < Rows; ++m) left[m] = load<N>(a + m * aStride + p);
        for (int k = 0; k < Columns; ++k) {
            const Lanes<N> right = load<N>(b + k * bStride + p);
            for (int m = 0; m < Rows; ++m) sum[m][k] += left[m] * right;
        }
    }
    for (int m = 0; m < Rows; ++m)
        for (int k = 0; k < Columns; ++k) store<N>(lanes + m * laneStride + k * kPartialSums, sum[m][k]);
}

/// lanes[m][k] += partial sums over patterns of a[m] * b[k]; those of row m start at lanes + m * laneStride.
template <int N, int Rows, int Columns>
void dotTile(const float* a, size_t aStride, const float* b, size_t bStride, int columns, float* lanes,
             size_t laneStride) {
    for (int first = 0; first < kPartialSums; first += N)
        dotPass<N, Rows, Columns>(a + first, aStride, b + first, bStride, columns, lanes + first, laneStride);
}

template <int N, int Rows, int Columns>
void dotRows(const float* a, size_t aStride, const float* b, size_t bStride, int columns, float* lanes,
             size_t laneStride, int count) {
    int k = 0;
    for (; k + Columns <= count; k += Columns)
        dotTile<N, Rows, Columns>(a, aStride, b + k * bStride, bStride, columns, lanes + k * kPartialSums, laneStride);
    if constexpr (Columns > 1)
        dotRows<N, Rows, Columns - 1>(a, aStride, b + k * bStride, bStride, columns, lanes + k * kPartialSums,
                                      laneStride, count - k);
}

/// a [rows][columns], b [count][columns]: lane sums [rows][count] += a b'.
template <int N, int Rows>
void dots(const float* a, size_t aStride, int rows, const float* b, size_t bStride, int count, int columns,
          float* lanes, size_t laneStride) {
    int m = 0;
    for (; m + Rows <= rows; m += Rows)
        dotRows<N, Rows, TileSize<N>::dotColumns>(a + m * aStride, aStride, b, bStride, columns, lanes + m * laneStride,
                                                  laneStride, count);
    if constexpr (Rows > 1)
        dots<N, Rows - 1>(a + m * aStride, aStride, rows - m, b, bStride, count, columns, lanes + m * laneStride,
                          laneStride);
}

template <int N>
void rowSums(const float* a, size_t aStride, int rows, int columns, float* lanes) {
    for (int m = 0; m < rows; ++m, a += aStride, lanes += kPartialSums)
        for (int first = 0; first < kPartialSums; first += N) {
            Lanes<N> sum = load<N>(lanes + first);
            for (int p = first; p < columns; p += kPartialSums) sum += load<N>(a + p);
            store<N>(lanes + first, sum);
        }
}

struct Parts {
    const float *w, *b, *v, *c;
    explicit Parts(const KernelTile& t)
        : w(t.parameters), b(w + size_t(t.hidden) * t.inputs), v(b + t.hidden), c(v + size_t(t.outputs) * t.hidden) {}
};

template <int N>
void tanhRow(float* row, int columns) {
    for (int p = 0; p < columns; p += N) store<N>(row + p, rationalTanh(load<N>(row + p)));
}

template <int N>
void forward(const KernelTile& t, float* h, float* y) {
    const Parts net(t);
    const auto hiddenLayer = [&](auto f) {
        multiply<N, TileSize<N>::rows>({net.w, size_t(t.inputs), 1}, net.b, t.x, t.stride, t.inputs, h, t.hiddenStride,
                                       t.hidden, t.columns, f);
    };
    if constexpr (N < 16) {  // too few registers for a tile of sums and the constants of tanh
        hiddenLayer(Identity{});
        for (int j = 0; j < t.hidden; ++j) tanhRow<N>(h + j * t.hiddenStride, t.columns);
    } else {
        hiddenLayer(Tanh{});
    }
    multiply<N, TileSize<N>::rows>({net.v, size_t(t.hidden), 1}, net.c, h, t.hiddenStride, t.hidden, y, t.stride,
                                   t.outputs, t.columns, Identity{});
}

/// The derivative at a hidden unit's sum: that at its output times 1 - h^2, h being as far from the output as `offset`.
struct TimesTanhSlope {
    ptrdiff_t offset;
    template <class T>
    [[gnu::always_inline]] T operator()(T sum, const float* at) const {
        const T h = load<sizeof(T) / sizeof(float)>(at + offset);
        return sum * (1.0f - h * h);
    }
};

template <int N>
void backward(const KernelTile& t, const float* h, const float* error, float* d, float* lanes, float* dx) {
    const Parts net(t);
    float* laneB = lanes + kPartialSums * (net.b - net.w);
    float* laneV = lanes + kPartialSums * (net.v - net.w);
    float* laneC = lanes + kPartialSums * (net.c - net.w);
    dots<N, TileSize<N>::dotRows>(error, t.stride, t.outputs, h, t.hiddenStride, t.hidden, t.columns, laneV,
                                  size_t(t.hidden) * kPartialSums);
    rowSums<N>(error, t.stride, t.outputs, t.columns, laneC);
    multiply<N, TileSize<N>::rows>({net.v, 1, size_t(t.hidden)}, nullptr, error, t.stride, t.outputs, d, t.hiddenStride,
                                   t.hidden, t.columns, TimesTanhSlope{h - d});
    dots<N, TileSize<N>::dotRows>(d, t.hiddenStride, t.hidden, t.x, t.stride, t.inputs, t.columns, lanes,
                                  size_t(t.inputs) * kPartialSums);
    rowSums<N>(d, t.hiddenStride, t.hidden, t.columns, laneB);
    if (dx)
        multiply<N, TileSize<N>::rows>({net.w, 1, size_t(t.inputs)}, nullptr, d, t.hiddenStride, t.hidden, dx, t.stride,
                                       t.inputs, t.columns, Identity{});
}

template <int N>
double squaredError(const KernelTile& t, const float* y, const float* target, float* error) {
    double loss = 0;
    for (int k = 0; k < t.outputs; ++k, y += t.stride, target += t.stride, error += t.stride) {
        float sums[kPartialSums];
        for (int first = 0; first < kPartialSums; first += N) {
            Lanes<N> sum{};
            for (int p = first; p < t.columns; p += kPartialSums) {
                Lanes<N> e = load<N>(y + p) - load<N>(target + p);
                for (int lane = t.valid - p; lane < N; ++lane) e[lane < 0 ? 0 : lane] = 0.0f;
                store<N>(error + p, e);
                sum += e * e;
            }
            store<N>(sums + first, sum);
        }
        for (const float sum : sums) loss += sum;
    }
    return loss;
}

/// The partial sums, by way of four.
[[gnu::always_inline]] inline Lanes<4> fourSums(const float* lanes) {
    return (load<4>(lanes) + load<4>(lanes + 4)) + (load<4>(lanes + 8) + load<4>(lanes + 12));
}

template <int N>
void reduce(float* lanes, size_t count, double* gradient) {
    for (size_t i = 0; i < count; i += 4) {
        float sums[16] = {}, columns[16];
        const int here = count - i < 4 ? int(count - i) : 4;
        for (int row = 0; row < here; ++row) {
            float* from = lanes + (i + row) * kPartialSums;
            store<4>(sums + 4 * row, fourSums(from));
            for (int first = 0; first < kPartialSums; first += N) store<N>(from + first, Lanes<N>{});
        }
        transpose4(sums, 4, columns, 4);
        const Lanes<4> total =
            (load<4>(columns) + load<4>(columns + 4)) + (load<4>(columns + 8) + load<4>(columns + 12));
        for (int row = 0; row < here; ++row) gradient[i + row] += total[row];
    }
}

template <int N>
void features(const KernelTile& t, const float* h, float* f, size_t featureStride) {
    for (int p = 0; p < t.valid; ++p, f += featureStride) {
        for (int j = 0; j < t.hidden; ++j) f[j] = h[j * t.hiddenStride + p];
        f[t.hidden] = 1.0f;
        float* to = f + t.hidden + 1;
        for (int i = 0; i <= t.inputs; ++i, to += t.hidden) {
            const float x = i < t.inputs ? t.x[i * t.stride + p] : 1.0f;
            for (int j = 0; j < t.hidden; ++j) to[j] = (1.0f - f[j] * f[j]) * x;
        }
    }
}

template <int N, int Rows, int Vectors>
[[gnu::always_inline]] inline void gramTile(const float* left, const float* right, int rows, size_t stride,
                                            float* gram) {
    Lanes<N> sum[Rows][Vectors];
    for (int m = 0; m < Rows; ++m)
        for (int v = 0; v < Vectors; ++v) sum[m][v] = load<N>(gram + m * stride + v * N);
    for (int r = 0; r < rows; ++r, left += stride, right += stride)
        for (int m = 0; m < Rows; ++m)
            for (int v = 0; v < Vectors; ++v) sum[m][v] += load<N>(right + v * N) * left[m];
    for (int m = 0; m < Rows; ++m)
        for (int v = 0; v < Vectors; ++v) store<N>(gram + m * stride + v * N, sum[m][v]);
}

template <int N>
void gram(const float* f, int rows, int size, size_t stride, float* out) {
    constexpr int kVectors = N == 16 ? 4 : 2, kRows = 6;
    for (int m = 0; m < size; m += kRows)
        for (int n = m / (kVectors * N) * (kVectors * N); n < size; n += kVectors * N) {
            if (m + kRows <= size) {
                gramTile<N, kRows, kVectors>(f + m, f + n, rows, stride, out + m * stride + n);
            } else {
                for (int row = m; row < size; ++row)
                    gramTile<N, 1, kVectors>(f + row, f + n, rows, stride, out + row * stride + n);
            }
        }
}

template <int N>
constexpr TrainingKernel trainingKernel() {
    return {forward<N>, squaredError<N>, backward<N>, reduce<N>, features<N>, gram<N>};
}

}  // namespace
}  // namespace mrose
