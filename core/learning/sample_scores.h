#pragma once

#include <span>

#include "geometry/point.h"

namespace mrose {

// How well samples of a distribution forecast what happened: proper scores in the units of the values, the less the
// better, fair for any number of samples from two on (Gneiting, Raftery 2007; Ferro 2014). Of one sample they are its
// distance from what happened.
// Antithetic samples, whose second half was drawn with the other sign, are not independent of their opposites in the
// first half: these pairs do not count as two samples of the distribution.

/// Energy score: E|X - y| - E|X - X'| / 2. Adds its derivative by each sample, times `weight`, to `gradient`, which is
/// empty where none is asked for.
double energyScore(std::span<const Point> samples, const Point& truth, double weight = 1,
                   std::span<Point> gradient = {}, bool antithetic = false);

/// Continuous ranked probability score, the same in one dimension.
double rankedScore(std::span<const double> samples, double truth, double weight = 1, std::span<double> gradient = {},
                   bool antithetic = false);

}  // namespace mrose
