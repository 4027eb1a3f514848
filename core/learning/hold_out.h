#pragma once

namespace mrose {

/// What no part of learning has seen: of data in numbered groups those whose number is `offset` modulo `every`.
struct HoldOut {
    int every = 0;  ///< 0: nothing is held out; else at least 2
    int offset = 0;
    bool operator==(const HoldOut&) const = default;

    bool holdsAny() const { return every > 0; }
    bool holds(int group) const { return holdsAny() && remainder(group - offset) == 0; }

    /// Numbers the groups that are not held out without gaps, so that they can be divided evenly.
    int rankOfOther(int group) const {
        return holdsAny() ? group - (group - offset - remainder(group - offset)) / every : group;
    }

private:
    int remainder(int number) const { return ((number % every) + every) % every; }
};

}  // namespace mrose
