#pragma once

#include <stddef.h>

namespace mrose {

/// Part of a block of patterns on its way through a network. Matrices are [rows][stride] with patterns along the rows;
/// `columns` patterns, a multiple of 16, of which the first `valid` are real.
struct KernelTile {
    int inputs = 0, hidden = 0, outputs = 0;
    int columns = 0, valid = 0;
    const float* parameters = nullptr;  ///< as in Mlp
    const float* x = nullptr;           ///< [inputs][stride]
    size_t stride = 0;                  ///< of x, y, target, error and dx
    size_t hiddenStride = 0;            ///< of h and d
};

/// Lane sums of the gradient: [parameterCount][16] floats, whatever the number of lanes of a kernel. All kernels give
/// the same bits.
struct TrainingKernel {
    /// h = tanh(W x + b), y = V h + c.
    void (*forward)(const KernelTile&, float* h, float* y);
    /// error = y - target, 0 in padding; returns the sum of its squares. error may be y.
    double (*squaredError)(const KernelTile&, const float* y, const float* target, float* error);
    /// Adds the gradient of sum(error * y) to the lane sums; error must be 0 in padding. d [hidden][hiddenStride] is
    /// for the derivatives at the hidden units' sums and may be h. dx (or null): [inputs][stride].
    void (*backward)(const KernelTile&, const float* h, const float* error, float* d, float* lanes, float* dx);
    /// gradient[i] += sum of lanes[i]; the lane sums become 0.
    void (*reduce)(float* lanes, size_t count, double* gradient);
    /// Features of Gauss and Newton's matrix, by patterns: f[p] = h [hidden], 1, then for every input and a last one of
    /// 1 (1 - h^2) times it [inputs + 1][hidden]. f is [valid][featureStride].
    void (*features)(const KernelTile&, const float* h, float* f, size_t featureStride);
    /// gram[m][n] += sum over `rows` r of f[r][m] f[r][n], for n >= m at least; [size][stride], stride a multiple
    /// of 64.
    void (*gram)(const float* f, int rows, int size, size_t stride, float* gram);
};

extern const TrainingKernel trainingBaseline, trainingAvx2, trainingAvx512;

}  // namespace mrose
