#pragma once

#include <array>
#include <cstddef>

#include "world/command.h"
#include "world/time.h"

namespace mrose {

/// The commands issued to one robot, newest last: the dead-time queue. A command holds until the next one. It is a
/// value without heap memory; when it is full the oldest command is forgotten, and what came before the oldest one is
/// taken to have been that same command. Before the first command the robot is told to stand.
class CommandHistory {
public:
    static constexpr std::size_t capacity = 128;

    /// `time` must not be before the newest; a command of the same instant replaces it. One equal to the command in
    /// force takes no room.
    void issue(Nanoseconds time, const Command& command);

    /// The command issued last at or before `time`.
    Command at(Nanoseconds time) const;

    /// The mean of the commands in force over [from, to), zero-order hold; `at(from)` when the interval is empty.
    /// Nothing issued at or after `to` is read.
    Command mean(Nanoseconds from, Nanoseconds to) const;

    std::size_t size() const { return size_; }
    /// What was in force before the oldest command.
    Command beforeFirst() const { return size_ == capacity ? command(0) : Command{}; }
    Nanoseconds issueTime(std::size_t index) const { return times_[slot(index)]; }  ///< 0 is the oldest
    const Command& command(std::size_t index) const { return commands_[slot(index)]; }

private:
    std::size_t slot(std::size_t index) const { return (first_ + index) % capacity; }
    std::size_t indexAt(Nanoseconds time) const;  ///< of the command in force, size() when there is none

    std::array<Nanoseconds, capacity> times_{};
    std::array<Command, capacity> commands_{};
    std::size_t first_ = 0, size_ = 0;
};

}  // namespace mrose
