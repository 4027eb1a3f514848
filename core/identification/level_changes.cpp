#include "identification/level_changes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/elementary.h"
#include "identification/robust_statistics.h"

namespace mrose {
namespace {

constexpr Nanoseconds binLength = 2 * nanosecondsPerSecond, shortestStretch = 2 * binLength;
constexpr Nanoseconds pauseLength = 10 * nanosecondsPerSecond;  // nothing is said of what lies between
constexpr std::size_t fewestInBin = 3;
constexpr double penalty = 10;      // times the noise's variance and the logarithm of the number of bins
constexpr double significance = 5;  // standard errors

/// The misfits of 2 s, less the usual level.
struct Bin {
    std::size_t begin = 0, end = 0;  // of the misfits
    double level = 0;
};

struct Piece {
    std::size_t begin = 0, end = 0;  // of the bins
    double level = 0;
};

std::vector<Bin> binsOf(std::span<const StampedMisfit> misfits) {
    std::vector<Bin> bins;
    for (std::size_t begin = 0, end = 0; begin < misfits.size(); begin = end) {
        const Nanoseconds number = (misfits[begin].time - misfits.front().time) / binLength;
        std::vector<double> values;
        while (end < misfits.size() && (misfits[end].time - misfits.front().time) / binLength == number)
            values.push_back(misfits[end++].value);
        if (values.size() >= fewestInBin) bins.push_back({begin, end, medianOf(std::move(values))});
    }
    return bins;
}

/// Bins without a long pause between them.
std::vector<std::vector<Bin>> runsOf(const std::vector<Bin>& bins, std::span<const StampedMisfit> misfits) {
    std::vector<std::vector<Bin>> runs;
    for (const Bin& bin : bins) {
        const bool goesOn =
            !runs.empty() && misfits[bin.begin].time - misfits[runs.back().back().end - 1].time <= pauseLength;
        if (!goesOn) runs.emplace_back();
        runs.back().push_back(bin);
    }
    return runs;
}

/// From one bin to the next, whatever the levels do.
double noiseOf(const std::vector<Bin>& bins) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < bins.size(); ++i) steps.push_back(bins[i].level - bins[i - 1].level);
    return steps.empty() ? 0 : robustSpread(std::move(steps), 0) / std::sqrt(2.0);
}

std::vector<Piece> piecesOf(const std::vector<Bin>& bins, double price) {
    const std::size_t count = bins.size();
    std::vector<double> sum(count + 1), squares(count + 1), best(count + 1, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> from(count + 1);
    for (std::size_t i = 0; i < count; ++i) {
        sum[i + 1] = sum[i] + bins[i].level;
        squares[i + 1] = squares[i] + bins[i].level * bins[i].level;
    }
    best[0] = 0;
    for (std::size_t end = 1; end <= count; ++end)
        for (std::size_t begin = 0; begin < end; ++begin) {
            const double total = sum[end] - sum[begin];
            const double within = squares[end] - squares[begin] - total * total / static_cast<double>(end - begin);
            const double cost = best[begin] + within + price;
            if (cost < best[end]) best[end] = cost, from[end] = begin;
        }
    std::vector<Piece> pieces;
    for (std::size_t end = count; end > 0; end = from[end])
        pieces.push_back({from[end], end, (sum[end] - sum[from[end]]) / static_cast<double>(end - from[end])});
    std::reverse(pieces.begin(), pieces.end());
    return pieces;
}

/// The misfit with which the second of two neighbouring pieces begins: within their two bins at the border.
std::size_t borderOf(std::span<const StampedMisfit> misfits, const std::vector<Bin>& bins, const Piece& before,
                     const Piece& after) {
    const std::size_t first = bins[before.end - 1].begin, last = bins[after.begin].end;
    std::size_t border = first;
    double least = 0, cost = 0;  // against a border at `first`, by each misfit that goes over to the piece before
    for (std::size_t i = first; i <= last; ++i) {
        if (cost < least) least = cost, border = i;
        if (i < last) cost += std::abs(misfits[i].value - before.level) - std::abs(misfits[i].value - after.level);
    }
    return std::min(border, misfits.size() - 1);
}

LevelChange stretchOf(std::span<const StampedMisfit> misfits, const std::vector<Bin>& bins,
                      const std::vector<Piece>& pieces, std::size_t index, double noise) {
    const Piece& piece = pieces[index];
    const std::size_t begin = index == 0 ? bins[piece.begin].begin : borderOf(misfits, bins, pieces[index - 1], piece);
    const std::size_t end =
        index + 1 == pieces.size() ? bins[piece.end - 1].end : borderOf(misfits, bins, piece, pieces[index + 1]);
    std::vector<double> levels;
    for (std::size_t i = piece.begin; i < piece.end; ++i) levels.push_back(bins[i].level);
    const double spread = std::max(robustSpread(levels, piece.level), noise);
    return {misfits[begin].time, misfits[std::max(end, begin + 1) - 1].time, piece.level,
            spread / std::sqrt(static_cast<double>(levels.size()))};
}

}  // namespace

std::vector<LevelChange> levelChanges(std::span<const StampedMisfit> misfits, double usual, double least, double most) {
    std::vector<StampedMisfit> sound;
    for (const StampedMisfit& misfit : misfits)
        if (std::abs(misfit.value - usual) < most) sound.push_back({misfit.time, misfit.value - usual});
    const std::vector<Bin> bins = binsOf(sound);
    if (bins.size() < 2) return {};
    const double noise = noiseOf(bins);
    const double price = std::max(1e-12, penalty * noise * noise * logarithm(static_cast<double>(bins.size())));
    std::vector<LevelChange> changes;
    for (const std::vector<Bin>& run : runsOf(bins, sound)) {
        const std::vector<Piece> pieces = piecesOf(run, price);
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            if (std::abs(pieces[i].level) < least) continue;
            const LevelChange change = stretchOf(sound, run, pieces, i, noise);
            if (change.end - change.begin >= shortestStretch && std::abs(change.offset) > significance * change.error)
                changes.push_back(change);
        }
    }
    return changes;
}

}  // namespace mrose
