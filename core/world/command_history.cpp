#include "world/command_history.h"

#include <algorithm>
#include <cassert>

namespace mrose {

void CommandHistory::issue(Nanoseconds time, const Command& command) {
    assert(size_ == 0 || time >= issueTime(size_ - 1));
    if (size_ > 0 && time == issueTime(size_ - 1)) {
        commands_[slot(size_ - 1)] = command;
        return;
    }
    if (size_ > 0 && identical(commands_[slot(size_ - 1)], command)) return;
    if (size_ == capacity) {
        first_ = (first_ + 1) % capacity;
        --size_;
    }
    times_[slot(size_)] = time;
    commands_[slot(size_)] = command;
    ++size_;
}

std::size_t CommandHistory::indexAt(Nanoseconds time) const {
    // The newest commands are asked for most, so the search starts at the end.
    for (std::size_t i = size_; i-- > 0;)
        if (issueTime(i) <= time) return i;
    return size_;
}

Command CommandHistory::at(Nanoseconds time) const {
    const std::size_t index = indexAt(time);
    if (index < size_) return command(index);
    return beforeFirst();
}

Command CommandHistory::mean(Nanoseconds from, Nanoseconds to) const {
    if (to <= from) return at(from);
    double v = 0, w = 0;
    Nanoseconds end = to;
    for (std::size_t i = size_; i-- > 0 && end > from;) {
        const Nanoseconds begin = std::max(issueTime(i), from);
        if (begin >= end) continue;
        const double held = static_cast<double>(end - begin);
        v += held * command(i).v;
        w += held * command(i).w;
        end = begin;
    }
    if (end > from) {
        v += static_cast<double>(end - from) * beforeFirst().v;
        w += static_cast<double>(end - from) * beforeFirst().w;
    }
    const double duration = static_cast<double>(to - from);
    return {v / duration, w / duration};
}

}  // namespace mrose
