#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sensing/outlines.h"

namespace mrose {

/// Beams from one point in equally spaced directions, at most once round.
class BeamFan {
public:
    /// Directions first, first + step, ..., rad; step > 0.
    BeamFan(double first, double step, std::size_t count);

    std::size_t size() const { return size_; }
    /// That many places `ranges` must have: beams are cast two by two.
    std::size_t places() const { return x_.size(); }
    double direction(std::size_t beam) const { return first_ + static_cast<double>(beam) * step_; }

    /// How far each beam gets until it meets an outline, m; infinite where it meets none. What the fan's origin is
    /// inside of is not met. Those beyond size() mean nothing.
    void cast(const Outlines& outlines, std::span<double> ranges) const;

private:
    /// visit(beam) for pairs of beams, each by its first, that may lie between two directions: at least all those
    /// that do.
    template <class Visit>
    void visitPairs(double right, double left, Visit visit) const;
    void castAt(const Outlines& outlines, const Outlines::Polygon& polygon, double* range) const;
    void castAt(const Outlines::Circle& circle, double* range) const;

    double first_, perStep_, step_;
    std::size_t size_;
    std::vector<double> x_, y_;  ///< cosines and sines of the directions, an even number of them
};

}  // namespace mrose
