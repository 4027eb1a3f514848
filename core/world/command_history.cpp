#include "world/command_history.h"

#include <algorithm>
#include <cassert>

namespace mrose {

Command CommandView::at(Nanoseconds time) const {
    // The newest commands are asked for most, so the search starts at the end.
    for (std::size_t i = size(); i-- > 0;)
        if (issueTime(i) <= time) return command(i);
    return before_;
}

Command CommandView::mean(Nanoseconds from, Nanoseconds to) const {
    if (to <= from) return at(from);
    double v = 0, w = 0;
    Nanoseconds end = to;
    for (std::size_t i = size(); i-- > 0 && end > from;) {
        const Nanoseconds begin = std::max(issueTime(i), from);
        if (begin >= end) continue;
        const double held = static_cast<double>(end - begin);
        v += held * command(i).v;
        w += held * command(i).w;
        end = begin;
    }
    if (end > from) {
        v += static_cast<double>(end - from) * before_.v;
        w += static_cast<double>(end - from) * before_.w;
    }
    const double duration = static_cast<double>(to - from);
    return {v / duration, w / duration};
}

void issueCommand(std::span<StampedCommand> slots, std::size_t& size, Command& before, const StampedCommand& issued) {
    assert(!slots.empty() && (size == 0 || issued.time >= slots[size - 1].time));
    if (size > 0 && issued.time == slots[size - 1].time) {
        slots[size - 1] = issued;
        return;
    }
    if (size > 0 && identical(slots[size - 1].command, issued.command)) return;
    if (size == slots.size()) {
        before = slots.front().command;
        std::move(slots.begin() + 1, slots.end(), slots.begin());
        --size;
    }
    slots[size++] = issued;
}

}  // namespace mrose
