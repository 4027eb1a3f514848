#pragma once

#include "perception/reading_distribution.h"

namespace mrose {

// How a predicted distribution of a reading's error is judged by the error that there was, one dimension at a time.

/// The continuous ranked probability score E|X - error| - E|X - X'| / 2, in the unit of the error, in closed form (of
/// normal distributions: Grimit, Gneiting, Berrocal and Johnson, 2006). Of a point it is the absolute error.
double rankedProbabilityScore(const ReadingDistribution& predicted, int dimension, double error);

/// The error of which a share is less, 0 < share < 1.
double errorQuantile(const ReadingDistribution& predicted, int dimension, double share);

}  // namespace mrose
