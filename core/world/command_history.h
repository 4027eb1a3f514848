#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "world/command.h"

namespace mrose {

class CommandHistory;

/// The commands issued to one robot, oldest first, wherever they are kept: the dead-time queue as models read it. A
/// command holds until the next one. Cheap to copy; what it looks at must stay.
class CommandView {
public:
    CommandView() = default;
    /// `issued` in order of time; `before` was in force earlier.
    explicit CommandView(std::span<const StampedCommand> issued, const Command& before = {})
        : issued_(issued), before_(before) {}
    CommandView(const CommandHistory& history);
    CommandView(const CommandHistory* history);

    std::size_t size() const { return issued_.size(); }
    Nanoseconds issueTime(std::size_t index) const { return issued_[index].time; }  ///< 0 is the oldest
    const Command& command(std::size_t index) const { return issued_[index].command; }
    /// What was in force before the oldest command.
    const Command& beforeFirst() const { return before_; }

    /// The command issued last at or before `time`.
    Command at(Nanoseconds time) const;

    /// The mean of the commands in force over [from, to), zero-order hold; `at(from)` when the interval is empty.
    /// Nothing issued at or after `to` is read.
    Command mean(Nanoseconds from, Nanoseconds to) const;

private:
    std::span<const StampedCommand> issued_;
    Command before_;
};

/// Commands in slots owned elsewhere, so that a world's state can keep as many as each of its robots needs. `time` must
/// not be before the newest; a command of the same instant replaces it. One equal to the command in force takes no
/// room; where all slots are taken the oldest command moves to `before`.
void issueCommand(std::span<StampedCommand> slots, std::size_t& size, Command& before, const StampedCommand& issued);

/// The commands issued to one robot as a value without heap memory. Before the first command the robot stands.
class CommandHistory {
public:
    static constexpr std::size_t capacity = 128;

    void issue(Nanoseconds time, const Command& command) { issueCommand(slots_, size_, before_, {time, command}); }

    CommandView view() const { return CommandView({slots_.data(), size_}, before_); }
    Command at(Nanoseconds time) const { return view().at(time); }
    Command mean(Nanoseconds from, Nanoseconds to) const { return view().mean(from, to); }
    std::size_t size() const { return size_; }
    const Command& beforeFirst() const { return before_; }
    Nanoseconds issueTime(std::size_t index) const { return slots_[index].time; }
    const Command& command(std::size_t index) const { return slots_[index].command; }

private:
    std::array<StampedCommand, capacity> slots_{};
    std::size_t size_ = 0;
    Command before_;
};

inline CommandView::CommandView(const CommandHistory& history) : CommandView(history.view()) {}
inline CommandView::CommandView(const CommandHistory* history) : CommandView(history->view()) {}

}  // namespace mrose
