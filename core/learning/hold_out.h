#pragma once

namespace mrose {

/// What no part of learning has seen of logs of trajectories: whole groups of them, or blocks of time of long ones.
struct HoldOut {
    int every = 0;  ///< 0: nothing is held out; else at least 2
    int offset = 0;
    /// s. 0: the groups whose number is `offset` modulo `every`. Else each trajectory that is long enough is divided
    /// into equal blocks of about this length, and those whose number is `offset` modulo `every` are held out; a
    /// shorter one is held out, or not, as its group.
    double block = 0;
    double guard = 0;  ///< s before and after a block that is held out, which are not learned from either
    bool operator==(const HoldOut&) const = default;

    bool holdsAny() const { return every > 0; }
    bool byTime() const { return block > 0; }
    /// Of a group or a block, by its number.
    bool holds(int number) const { return holdsAny() && remainder(number - offset) == 0; }

    /// Numbers the groups that are not held out without gaps, so that they can be divided evenly.
    int rankOfOther(int group) const {
        return holdsAny() && !byTime() ? group - (group - offset - remainder(group - offset)) / every : group;
    }

private:
    int remainder(int number) const { return ((number % every) + every) % every; }
};

}  // namespace mrose
