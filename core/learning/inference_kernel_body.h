#pragma once

#include "learning/elementary.h"
#include "learning/inference_kernel.h"
#include "learning/lanes.h"

// The inference kernels, for any number of lanes. The order of sums is part of their contract, the same for every
// number of lanes, alone and in a batch:
//   hidden unit j: bias, then the products with inputs 0, 1, 2, ... added in order;
//   output k: four partial sums s0..s3 over the units j = 0, 4, 8, ...; 1, 5, 9, ...; and so on, each from 0 upwards in
//   order; y = bias + ((s0 + s1) + (s2 + s3)).
// Multiplications and additions round separately: compile with -ffp-contract=off.

namespace mrose {
namespace {

// alone: lanes are hidden units, then outputs

template <int N, int Blocks>
[[gnu::always_inline]] inline void hiddenBlocks(const PackedMlp& net, const float* x, int first, float* h) {
    Lanes<N> sum[Blocks];
    for (int b = 0; b < Blocks; ++b) sum[b] = load<N>(net.hiddenBiases + first + b * N);
    const float* weights = net.hiddenWeights + first;
    for (int i = 0; i < net.inputs; ++i, weights += net.hiddenStride)
        for (int b = 0; b < Blocks; ++b) sum[b] = sum[b] + load<N>(weights + b * N) * x[i];
    for (int b = 0; b < Blocks; ++b) store<N>(h + first + b * N, rationalTanh(sum[b]));
}

template <int N>
void hiddenLayerAlone(const PackedMlp& net, const float* x, float* h) {
    int first = 0;
    for (; first + 7 * N < net.hidden; first += 8 * N) hiddenBlocks<N, 8>(net, x, first, h);
    for (; first + 3 * N < net.hidden; first += 4 * N) hiddenBlocks<N, 4>(net, x, first, h);
    switch ((net.hidden - first + N - 1) / N) {
        case 3:
            return hiddenBlocks<N, 3>(net, x, first, h);
        case 2:
            return hiddenBlocks<N, 2>(net, x, first, h);
        case 1:
            return hiddenBlocks<N, 1>(net, x, first, h);
        default:
            return;
    }
}

template <int N>
[[gnu::always_inline]] inline Lanes<N> outputBlock(const PackedMlp& net, const float* h, int first) {
    Lanes<N> sum[4] = {};
    const float* weights = net.outputWeights + first;
    const size_t stride = net.outputStride;
    int j = 0;
    for (; j + 4 <= net.hidden; j += 4, weights += 4 * stride)
        for (int part = 0; part < 4; ++part) sum[part] = sum[part] + load<N>(weights + part * stride) * h[j + part];
    for (int part = 0; j + part < net.hidden; ++part)
        sum[part] = sum[part] + load<N>(weights + part * stride) * h[j + part];
    return load<N>(net.outputBiases + first) + ((sum[0] + sum[1]) + (sum[2] + sum[3]));
}

template <int Narrow, int Wide>
void hiddenLayerAlone(const PackedMlp& net, const float* x, float* h) {
    if constexpr (Narrow < Wide)
        if (net.hidden <= 2 * Wide) return hiddenLayerAlone<Narrow>(net, x, h);
    hiddenLayerAlone<Wide>(net, x, h);
}

/// Lanes of the hidden layer: `Wide` where it has many units, else `Narrow`, which wastes fewer; `Out` of the output
/// layer.
template <int Narrow, int Wide, int Out>
void predictOne(const PackedMlp& net, const float* x, float* y, float* scratch) {
    float* h = scratch;
    hiddenLayerAlone<Narrow, Wide>(net, x, h);
    for (int first = 0; first < net.outputs; first += Out) {
        const Lanes<Out> values = outputBlock<Out>(net, h, first);
        storeFirst<Out>(y + first, values, net.outputs - first < Out ? net.outputs - first : Out);
    }
}

// in a batch: lanes are patterns

template <int N, int Units>
[[gnu::always_inline]] inline void hiddenUnits(const PackedMlp& net, const float* x, int first, float* h) {
    Lanes<N> sum[Units];
    for (int u = 0; u < Units; ++u) sum[u] = Lanes<N>{} + net.hiddenBiases[first + u];
    const float* weights = net.hiddenWeights + first;
    for (int i = 0; i < net.inputs; ++i, weights += net.hiddenStride) {
        const Lanes<N> value = load<N>(x + i * N);
        for (int u = 0; u < Units; ++u) sum[u] = sum[u] + value * weights[u];
    }
    for (int u = 0; u < Units; ++u) store<N>(h + (first + u) * N, rationalTanh(sum[u]));
}

template <int N, int Count>
[[gnu::always_inline]] inline void outputUnits(const PackedMlp& net, const float* h, int first, float* y) {
    Lanes<N> sum[Count][4];
    for (int k = 0; k < Count; ++k)
        for (int part = 0; part < 4; ++part) sum[k][part] = Lanes<N>{};
    const float* weights = net.outputWeights + first;
    int j = 0;
    for (; j + 4 <= net.hidden; j += 4)
        for (int part = 0; part < 4; ++part, weights += net.outputStride) {
            const Lanes<N> value = load<N>(h + (j + part) * N);
            for (int k = 0; k < Count; ++k) sum[k][part] = sum[k][part] + value * weights[k];
        }
    for (int part = 0; j + part < net.hidden; ++part, weights += net.outputStride) {
        const Lanes<N> value = load<N>(h + (j + part) * N);
        for (int k = 0; k < Count; ++k) sum[k][part] = sum[k][part] + value * weights[k];
    }
    for (int k = 0; k < Count; ++k) {
        const Lanes<N> bias = Lanes<N>{} + net.outputBiases[first + k];
        store<N>(y + (first + k) * N, bias + ((sum[k][0] + sum[k][1]) + (sum[k][2] + sum[k][3])));
    }
}

/// x [inputs][N] -> y [outputs][N].
template <int N, int OutputUnits>
void predictLanes(const PackedMlp& net, const float* x, float* h, float* y) {
    int j = 0;
    for (; j + 8 <= net.hidden; j += 8) hiddenUnits<N, 8>(net, x, j, h);
    for (; j + 4 <= net.hidden; j += 4) hiddenUnits<N, 4>(net, x, j, h);
    for (; j < net.hidden; ++j) hiddenUnits<N, 1>(net, x, j, h);
    int k = 0;
    for (; k + OutputUnits <= net.outputs; k += OutputUnits) outputUnits<N, OutputUnits>(net, h, k, y);
    for (; k < net.outputs; ++k) outputUnits<N, 1>(net, h, k, y);
}

/// to[column][row] = from[row][column].
[[gnu::always_inline]] inline void transpose(const float* from, size_t fromStride, int rows, int columns, float* to,
                                             size_t toStride) {
    int column = 0;
    for (; column + 4 <= columns; column += 4) {
        int row = 0;
        for (; row + 4 <= rows; row += 4)
            transpose4(from + row * fromStride + column, fromStride, to + column * toStride + row, toStride);
        for (; row < rows; ++row)
            for (int i = column; i < column + 4; ++i) to[i * toStride + row] = from[row * fromStride + i];
    }
    for (; column < columns; ++column)
        for (int row = 0; row < rows; ++row) to[column * toStride + row] = from[row * fromStride + column];
}

[[gnu::always_inline]] inline int atMost(size_t left, int most) { return left < size_t(most) ? int(left) : most; }

/// 64 rows are turned into lanes before the first of them is computed: vectors of freshly stored single floats load
/// slowly.
template <int N, int OutputUnits>
void predictBatch(const PackedMlp& net, const float* rows, float* out, size_t n, float* scratch) {
    constexpr int kRows = 64;
    const int inputs = net.inputs, outputs = net.outputs;
    float* x = scratch;
    float* h = x + inputs * kRows;
    float* y = h + net.hidden * N;
    const int padded = (atMost(n, kRows) + N - 1) / N * N;
    for (int i = 0; i < inputs * padded; ++i) x[i] = 0;
    for (size_t first = 0; first < n; first += kRows) {
        const int here = atMost(n - first, kRows);
        for (int row = 0; row < here; row += N)
            transpose(rows + (first + row) * inputs, inputs, atMost(here - row, N), inputs, x + row * inputs, N);
        for (int row = 0; row < here; row += N) {
            predictLanes<N, OutputUnits>(net, x + row * inputs, h, y);
            transpose(y, N, outputs, atMost(here - row, N), out + (first + row) * outputs, outputs);
        }
    }
}

}  // namespace
}  // namespace mrose
