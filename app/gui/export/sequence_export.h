#pragma once

#include <QSize>
#include <QString>
#include <cstdint>
#include <optional>
#include <vector>

#include "export/exports.h"
#include "io/error.h"
#include "world/time.h"

namespace mrose::gui {

/// A stretch of time as pictures.
struct SequenceSettings {
    /// s of the run's clock, both shown. nullopt: all that is known of the shown branch; where that is but its
    /// beginning, as long as its scenario says.
    std::optional<double> from, to;
    double framesPerSecond = 25;  ///< of the film
    double speed = 1;             ///< simulated seconds in a second of the film
    QSize size;                   ///< pixels; empty: as large as it is shown
    bool wholeWindow = false;     ///< otherwise the field view
};

/// The tick of each frame: the nearest to from + k * speed / framesPerSecond. Error: a stretch that ends before it
/// begins; numbers that make no sense; too many frames.
Expected<std::vector<std::int64_t>> sequenceTicks(const SequenceSettings& settings, Nanoseconds tickLength);

/// Writes the shown branch's stretch as a folder of numbered PNG files, or as MP4 (film.h). Frames show exactly their
/// ticks, as the window would that goes through them in this order; ticks that are not known yet are simulated. In the
/// background: the field view is painted while the window does something else, the whole window goes through the
/// stretch and comes back. The outcome is reported in the window; unattended, this waits for it. Error: what is wrong
/// from the start; unattended, all errors.
Expected<void> exportFrames(const Exports& exports, const QString& folder, const SequenceSettings& settings = {});
Expected<void> exportFilm(const Exports& exports, const QString& file, const SequenceSettings& settings = {});

}  // namespace mrose::gui
