#pragma once

#include <QImage>

#include "io/error.h"

namespace mrose::gui {

/// Where the frames of a stretch of time go, one after the other. What was begun and is not finished leaves nothing
/// behind.
class FrameSink {
public:
    FrameSink() = default;
    FrameSink(const FrameSink&) = delete;
    FrameSink& operator=(const FrameSink&) = delete;
    virtual ~FrameSink() = default;

    virtual Expected<void> add(const QImage& frame) = 0;
    /// False: ended before its end.
    virtual Expected<bool> finish() = 0;
};

}  // namespace mrose::gui
