#pragma once

#include <cstdint>

#include "world/time.h"

namespace mrose {

/// The ticks that curves are plotted over, and those of them that are seen: all, also as they come, or a part.
class PlotAxis {
public:
    struct Time {
        std::int64_t first = 0, last = 0;  ///< ticks that are known
        std::int64_t now = 0;
        Nanoseconds tickLength = 20'000'000;
        std::int64_t end = 0;  ///< how far the axis reaches at the least, where all is shown
        bool operator==(const Time&) const = default;
    };
    /// What is seen goes along: of all, with what comes; of a part, with now when it leaves that.
    void setTime(const Time& time);
    const Time& time() const { return time_; }

    void showAll();
    void show(double from, double to);       ///< ticks
    void zoom(double factor, double share);  ///< larger than 1: closer; what lies at that share of it stays there
    void pan(double share);                  ///< of what is seen
    bool showsAll() const { return all_; }
    double from() const { return from_; }
    double to() const { return to_; }

    double seconds(double tick) const { return tick * toSeconds(time_.tickLength); }

private:
    double reach() const;
    void setRange(double from, double to);

    Time time_;
    double from_ = 0, to_ = 1;
    bool all_ = true;
};

}  // namespace mrose
