#pragma once

#include <cstddef>

#include "planning/path.h"

namespace mrose {

struct PotentialFieldOptions {
    double influence = 0.45;  ///< m: a piece pushes from so far beyond its growth
    double repulsion =
        0.006;           ///< m3, beside the goal's pull of 1: its force at a gap g is (1/g - 1/influence)/g^2 of it
    double step = 0.08;  ///< m
    int mostSteps = 600;
};

struct PotentialFieldPath {
    Path path;
    std::size_t localMinima = 0;  ///< that it came into
    Point lastMinimum;            ///< where the last one was
};

/// Down the field of a goal that pulls and pieces that push (Khatib 1986), in steps of one length. Where it gets no
/// nearer to the goal it is in a local minimum. The way out: along the piece in front, to the side on which the goal
/// lies, until it is nearer to the goal than the minimum, by more than a step, and the goal's pull leads away from the
/// piece (as Bug2 leaves walls; Lumelsky and Stepanov 1987); where that leads back, along it to the other side. The
/// points of the path are thinned out as far as it stays free.
PotentialFieldPath potentialFieldPath(const DiscSpace& space, const Point& start, const Point& goal,
                                      const PotentialFieldOptions& options = {});

}  // namespace mrose
