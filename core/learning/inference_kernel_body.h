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

/// Lanes `Hidden` in the hidden layer, `Out` in the output layer.
template <int Hidden, int Out>
void predictOne(const PackedMlp& net, const float* x, float* y, float* scratch) {
    float* h = scratch;
    hiddenLayerAlone<Hidden>(net, x, h);
    for (int first = 0; first < net.outputs; first += Out) {
        const Lanes<Out> values = outputBlock<Out>(net, h, first);
        const int count = net.outputs - first < Out ? net.outputs - first : Out;
        for (int k = 0; k < count; ++k) y[first + k] = values[k];
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
    Lanes<N> sum[Count][4] = {};
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
    for (; j + 4 <= net.hidden; j += 4) hiddenUnits<N, 4>(net, x, j, h);
    for (; j < net.hidden; ++j) hiddenUnits<N, 1>(net, x, j, h);
    int k = 0;
    for (; k + OutputUnits <= net.outputs; k += OutputUnits) outputUnits<N, OutputUnits>(net, h, k, y);
    for (; k < net.outputs; ++k) outputUnits<N, 1>(net, h, k, y);
}

template <int N, int OutputUnits>
void predictBatch(const PackedMlp& net, const float* rows, float* out, size_t n, float* scratch) {
    float* x = scratch;
    float* h = x + net.inputs * N;
    float* y = h + net.hidden * N;
    for (size_t first = 0; first < n; first += N) {
        const int count = n - first < N ? static_cast<int>(n - first) : N;
        for (int i = 0; i < net.inputs; ++i)
            for (int lane = 0; lane < N; ++lane)
                x[i * N + lane] = lane < count ? rows[(first + lane) * net.inputs + i] : 0.0f;
        predictLanes<N, OutputUnits>(net, x, h, y);
        for (int lane = 0; lane < count; ++lane)
            for (int k = 0; k < net.outputs; ++k) out[(first + lane) * net.outputs + k] = y[k * N + lane];
    }
}

}  // namespace
}  // namespace mrose
