#pragma once

#include <limits>

namespace mrose {

/// P and Hd of open-loop predictions, as the referee of the MRCLAM windows defines them; NaN where nothing drove or
/// turned.
struct PercentErrors {
    double p = 0;   ///< %: sum of time-mean position errors / sum of paths
    double hd = 0;  ///< %: sum of time-mean |heading errors| / sum of rotations
};

constexpr double percent(double part, double whole) {
    return whole > 0 ? 100 * part / whole : std::numeric_limits<double>::quiet_NaN();
}

/// The sums over rollouts from which P and Hd follow; m and rad.
struct ErrorSums {
    double position = 0, path = 0, heading = 0, rotation = 0;

    void add(double positionMean, double headingMean, double itsPath, double itsRotation) {
        position += positionMean;
        heading += headingMean;
        path += itsPath;
        rotation += itsRotation;
    }
    PercentErrors percentErrors() const { return {percent(position, path), percent(heading, rotation)}; }
};

}  // namespace mrose
