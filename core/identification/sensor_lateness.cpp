#include "identification/sensor_lateness.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "identification/robust_statistics.h"

namespace mrose {
namespace {

constexpr double earliest = -0.5, latest = 2;  // s
constexpr double coarseStep = 0.05;            // s
// s: truth is read over 0.12 s, so that the noise of these two slopes has nothing in common. Each stands in for the
// other where a square would count noise as turning.
constexpr double innerReach = 0.1, outerReach = 0.25;
constexpr double tukeyCut = 4.685;    // spreads: 95 % as good as least squares where errors are normal
constexpr double leastSpread = 1e-4;  // rad or m: of a simulation's sensors too, as truth is interpolated
constexpr std::size_t fewestMisfits = 100;
constexpr double greatestError = 0.1;  // s

/// The offset and the noise of one kind of misfits.
struct KindLevel {
    double offset = 0, spread = 1;
};

class LatenessFitter {
public:
    explicit LatenessFitter(const LateMisfits& misfits) : misfits_(misfits) {
        for (const std::int32_t kind : misfits.kinds) kinds_ = std::max(kinds_, kind + 1);
    }

    std::size_t known(double lateness) const {
        const auto values = misfits_.at(lateness);
        return static_cast<std::size_t>(
            std::count_if(values.begin(), values.end(), [](double x) { return std::isfinite(x); }));
    }
    double coarse() const;
    SensorLateness refine(double lateness) const;

private:
    std::vector<KindLevel> levels(const std::vector<double>& values) const;
    /// One misfit in units of its kind's spread, with how it changes with the lateness.
    struct Row {
        double weight, curvature;  // Tukey's: of the value, and the derivative of the weighted value
        double value, inner, outer;
        std::int32_t block, kind;
    };
    std::vector<double> slopes(double lateness, double reach) const;
    std::vector<Row> rowsAt(double lateness) const;
    void centre(std::vector<Row>& rows) const;
    struct Step {
        double change = 0, error = 0;
    };
    Step step(double lateness) const;

    const LateMisfits& misfits_;
    std::int32_t kinds_ = 0;
};

std::vector<KindLevel> LatenessFitter::levels(const std::vector<double>& values) const {
    std::vector<KindLevel> found;
    for (std::int32_t kind = 0; kind < kinds_; ++kind) {
        std::vector<double> own;
        for (std::size_t i = 0; i < values.size(); ++i)
            if (misfits_.kinds[i] == kind && std::isfinite(values[i])) own.push_back(values[i]);
        const double offset = medianOf(own);
        found.push_back({offset, std::max(robustSpread(std::move(own), offset), leastSpread)});
    }
    return found;
}

/// By misfits in units of the spreads at no lateness, cut where they say no more than that something is wrong.
double LatenessFitter::coarse() const {
    const auto units = levels(misfits_.at(0));
    double best = 0, least = INFINITY;
    for (int i = 0; earliest + i * coarseStep <= latest; ++i) {
        const double lateness = earliest + i * coarseStep;
        const auto values = misfits_.at(lateness);
        const auto now = levels(values);
        double cost = 0, count = 0;
        for (std::size_t k = 0; k < values.size(); ++k) {
            if (!std::isfinite(values[k])) continue;
            const auto kind = static_cast<std::size_t>(misfits_.kinds[k]);
            cost += std::min(std::abs(values[k] - now[kind].offset) / units[kind].spread, 2 * tukeyCut);
            ++count;
        }
        if (count > 0 && cost / count < least) least = cost / count, best = lateness;
    }
    return best;
}

std::vector<double> LatenessFitter::slopes(double lateness, double reach) const {
    std::vector<double> before = misfits_.at(lateness - reach), after = misfits_.at(lateness + reach);
    for (std::size_t i = 0; i < after.size(); ++i) after[i] = (after[i] - before[i]) / (2 * reach);
    return after;
}

std::vector<LatenessFitter::Row> LatenessFitter::rowsAt(double lateness) const {
    const auto values = misfits_.at(lateness), inner = slopes(lateness, innerReach),
               outer = slopes(lateness, outerReach);
    const auto level = levels(values);
    std::vector<Row> rows;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const KindLevel& own = level[static_cast<std::size_t>(misfits_.kinds[i])];
        const double value = (values[i] - own.offset) / own.spread, share = value / tukeyCut;
        if (!std::isfinite(value + inner[i] + outer[i]) || std::abs(share) >= 1) continue;
        const double left = 1 - share * share;
        rows.push_back({left * left, left * (1 - 5 * share * share), value, inner[i] / own.spread,
                        outer[i] / own.spread, misfits_.blocks[i], misfits_.kinds[i]});
    }
    return rows;
}

/// Less the weighted means of their kinds: what an offset of each would take.
void LatenessFitter::centre(std::vector<Row>& rows) const {
    for (double Row::*const quantity : {&Row::value, &Row::inner, &Row::outer}) {
        std::vector<double> sum(static_cast<std::size_t>(kinds_)), weight(sum.size());
        for (const Row& row : rows) {
            sum[static_cast<std::size_t>(row.kind)] += row.weight * row.*quantity;
            weight[static_cast<std::size_t>(row.kind)] += row.weight;
        }
        for (Row& row : rows)
            row.*quantity -= sum[static_cast<std::size_t>(row.kind)] / weight[static_cast<std::size_t>(row.kind)];
    }
}

LatenessFitter::Step LatenessFitter::step(double lateness) const {
    std::vector<Row> rows = rowsAt(lateness);
    centre(rows);
    double information = 0, curvature = 0, gradient = 0;
    std::map<std::int32_t, double> blocks;
    for (const Row& row : rows) {
        information += row.weight * row.inner * row.outer;
        curvature += row.curvature * row.inner * row.outer;
        gradient += row.weight * row.outer * row.value;
        blocks[row.block] += row.weight * row.outer * row.value;
    }
    if (information <= 0) return {0, INFINITY};
    double squares = 0;
    for (const auto& [block, sum] : blocks) squares += sum * sum;
    const auto count = static_cast<double>(blocks.size());
    return {-gradient / information,
            count > 1 && curvature > 0 ? std::sqrt(squares * count / (count - 1)) / curvature : INFINITY};
}

SensorLateness LatenessFitter::refine(double lateness) const {
    SensorLateness found{false, {}, lateness, INFINITY};
    for (int i = 0; i < 20; ++i) {
        const Step next = step(found.lateness);
        found.error = next.error;
        if (std::abs(next.change) < 1e-5) break;
        found.lateness =
            std::clamp(found.lateness + std::clamp(next.change, -coarseStep, coarseStep), earliest, latest);
    }
    return found;
}

}  // namespace

SensorLateness fitLateness(const LateMisfits& misfits) {
    const LatenessFitter fitter(misfits);
    if (fitter.known(0) < fewestMisfits) return {false, "too little was reported of what the ground truth shows"};
    SensorLateness found = fitter.refine(fitter.coarse());
    if (found.lateness <= earliest || found.lateness >= latest)
        found.reason = "none between -0.5 and 2 s fits";
    else if (!(found.error < greatestError))
        found.reason = "the standard error exceeds 0.1 s: the robot hardly turns while it reports";
    else
        found.identified = true;
    return found;
}

}  // namespace mrose
