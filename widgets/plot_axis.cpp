#include "widgets/plot_axis.h"

#include <algorithm>

namespace mrose {
namespace {

constexpr double shortestView = 10;  // ticks
constexpr double growth = 1.15;      // of the view, when the known time outgrows it

}  // namespace

/// As far as anything is known or awaited.
double PlotAxis::reach() const { return static_cast<double>(std::max(time_.last, time_.end)); }

void PlotAxis::setRange(double from, double to) {
    from_ = from;
    to_ = std::max(to, from + shortestView);
}

void PlotAxis::setTime(const Time& time) {
    time_ = time;
    const auto first = static_cast<double>(time.first), last = static_cast<double>(time.last);
    const auto now = static_cast<double>(time.now);
    const double length = to_ - from_;
    if (!all_) {
        if (now > to_) setRange(now - 0.1 * length, now + 0.9 * length);
        if (now < from_) setRange(now - 0.9 * length, now + 0.1 * length);
        return;
    }
    // Some room at the right, so that the scale does not change at each tick.
    const bool fits = from_ == first && to_ >= last && last - first > 0.6 * length;
    if (time.end >= time.last && time.end > time.first)
        setRange(first, reach());
    else if (!fits)
        setRange(first, std::max(first + (last - first) * growth, first + 250));
}

void PlotAxis::showAll() {
    all_ = true;
    setRange(static_cast<double>(time_.first), reach());
}

void PlotAxis::show(double from, double to) {
    all_ = false;
    setRange(from, to);
}

void PlotAxis::zoom(double factor, double share) {
    const double about = from_ + share * (to_ - from_);
    const double known = (reach() - static_cast<double>(time_.first)) * growth + 250;
    const double length = std::clamp((to_ - from_) / factor, shortestView, std::max(known, shortestView));
    const double from = std::clamp(about - share * length, static_cast<double>(time_.first) - 0.5 * length, reach());
    show(from, from + length);
}

void PlotAxis::pan(double share) {
    const double length = to_ - from_;
    const double from = std::clamp(from_ + share * length, static_cast<double>(time_.first) - 0.5 * length, reach());
    show(from, from + length);
}

}  // namespace mrose
