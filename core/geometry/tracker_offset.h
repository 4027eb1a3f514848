#pragma once

#include "geometry/pose.h"

namespace mrose {

/// A tracker's marker is not quite on the axle's middle, nor quite straight: while the body moves by (dx, 0, dphi) the
/// marker also moves sideways, by ahead * dphi - rotated * dx. Predictions of a robot's log are of its marker.
struct TrackerOffset {
    double ahead = 0;    ///< m, of the axle
    double rotated = 0;  ///< rad, against the body's forward direction
    bool operator==(const TrackerOffset&) const = default;

    double sideways(const Pose& bodyIncrement) const {
        return ahead * bodyIncrement.heading - rotated * bodyIncrement.x;
    }
};

/// What a marker's motion says of its TrackerOffset: the normal equations of least squares.
class TrackerEvidence {
public:
    /// It turned by `rotation` (rad) and moved forward (m), and `sideways` (m) beyond what an arc leads sideways.
    void add(double rotation, double forward, double sideways) {
        rr_ += rotation * rotation;
        rf_ += rotation * forward;
        ff_ += forward * forward;
        rs_ += rotation * sideways;
        fs_ += forward * sideways;
    }
    /// In a short time.
    void add(const Pose& increment) { add(increment.heading, increment.x, sidewaysOfArc(increment)); }
    static double sidewaysOfArc(const Pose& increment) { return increment.y - increment.x * increment.heading / 2; }

    /// Counts for less from here on, by this factor.
    void fade(double factor) {
        for (double* const sum : {&rr_, &rf_, &ff_, &rs_, &fs_}) *sum *= factor;
    }

    /// Whether it says nothing.
    bool none() const { return rr_ + ff_ < 1e-9; }
    /// The offset that explains it best.
    TrackerOffset offset() const {
        const double determinant = rr_ * ff_ - rf_ * rf_;
        return {(rs_ * ff_ - fs_ * rf_) / determinant, -(fs_ * rr_ - rs_ * rf_) / determinant};
    }
    /// The same where the offset was thought to be `before`: that counts like a turn of 0.15 rad and a way of 0.07 m.
    TrackerOffset offset(const TrackerOffset& before) const {
        TrackerEvidence all = *this;
        all.add(0.15, 0, 0.15 * before.ahead);
        all.add(0, 0.07, -0.07 * before.rotated);
        return all.offset();
    }

private:
    double rr_ = 1e-12, rf_ = 0, ff_ = 1e-12, rs_ = 0, fs_ = 0;
};

}  // namespace mrose
