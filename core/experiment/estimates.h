#pragma once

#include <cstddef>
#include <span>

namespace mrose {

/// A number with its 95 % interval; NaN where it is not known.
struct Estimate {
    double value, low, high;
    Estimate();  ///< not known
    Estimate(double of, double least, double most) : value(of), low(least), high(most) {}
};

inline Estimate negated(const Estimate& of) { return {-of.value, -of.high, -of.low}; }

/// The quantile of Student's distribution with `degrees` of freedom below which 97.5 % lie; infinite for none.
double studentQuantile(std::size_t degrees);

/// The mean of independent numbers with its interval by Student's distribution; without an interval of fewer than two.
Estimate meanOf(std::span<const double> values);

/// A share of yes among `count` runs, by Wilson's interval. `share` of fewer than one run is not known.
/// `count` need not be whole: where runs belong together they count as fewer (effectiveCount()).
Estimate wilsonShare(double share, double count);

/// How many independent runs say as much about a share as `runs` that belong to trials, whose means are `byTrial`: by
/// the design effect, at least 1 (Kish 1965). All trials have as many runs.
double effectiveCount(std::span<const double> byTrial, double runs);

/// The ratio of the means of pairs of numbers with its interval by Fieller's theorem (1954). Not known where the
/// denominators' own interval holds 0: then the ratio may be anything.
Estimate ratioOfMeans(std::span<const double> numerators, std::span<const double> denominators);

}  // namespace mrose
