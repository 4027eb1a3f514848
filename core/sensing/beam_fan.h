#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sensing/outlines.h"

namespace mrose {

/// Beams from one point, counter-clockwise from the first, at most once round.
class BeamFan {
public:
    enum class Spacing {
        angles,    ///< equal angles from beam to beam
        tangents,  ///< equal steps on a line across, as in a pinhole's image; all less than a right angle from x
    };
    BeamFan() : BeamFan(0, 1, 0) {}
    /// Directions first, first + step, ..., rad, or their tangents; step > 0.
    BeamFan(double first, double step, std::size_t count, Spacing spacing = Spacing::angles);

    std::size_t size() const { return size_; }
    /// That many places `ranges` and `owners` must have: beams are cast two by two.
    std::size_t places() const { return x_.size(); }
    /// rad, of a beam that is not turned; of places between beams too.
    double direction(std::size_t beam) const { return directionAt(static_cast<double>(beam)); }
    double directionAt(double place) const;
    double step() const { return step_; }
    /// The beam's vector of length 1.
    Point towards(std::size_t beam) const { return {x_[beam], y_[beam]}; }

    /// Turns a beam to where one would be that is so many beams beside it.
    void turn(std::size_t beam, double beams);

    /// How far each beam gets until it meets an outline, m; infinite where it meets none. What the fan's origin is
    /// inside of is not met. Those beyond size() mean nothing.
    void cast(const Outlines& outlines, std::span<double> ranges) const;
    /// Also whose outline each beam meets, the lowest owner's of those that are as near; anything where it meets none.
    void cast(const Outlines& outlines, std::span<double> ranges, std::span<std::uint32_t> owners) const;

private:
    /// visit(beam) for pairs of beams, each by its first, that may lie between two directions: at least all those
    /// that do.
    template <class Visit>
    void visitPairs(double right, double left, Visit visit) const;
    /// How many beams are within an angle from the first one's direction, and what share of the step to the next.
    double beamsWithin(double angle) const;
    void point(std::size_t beam, double at);
    template <class Kept>
    void castAt(const Outlines& outlines, const Outlines::Polygon& polygon, double* range, Kept kept) const;
    template <class Kept>
    void castAt(const Outlines::Circle& circle, double* range, Kept kept) const;
    template <class Kept>
    void castAll(const Outlines& outlines, std::span<double> ranges, Kept kept) const;

    double first_, perStep_, step_;
    Spacing spacing_;
    std::size_t size_;
    double rightmost_ = 0, width_ = 0;  ///< rad, the first beam's direction, and from there to the last one's
    double slack_;                      ///< rad, how far beams may be from their directions, with rounding
    std::vector<double> x_, y_;         ///< cosines and sines of the directions, an even number of them
};

}  // namespace mrose
