#pragma once

#include <QString>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "debug/tick_ranges.h"
#include "debug/timeline_mark.h"
#include "scenario/scenario.h"
#include "world/time.h"

namespace mrose {

/// What a timeline shows: a branch's ticks, and what happened in them.
struct TimelineContent {
    std::int64_t first = 0, last = 0, now = 0;
    std::int64_t end = 0;        ///< how far the bar reaches: what has not happened yet can be asked for as well
    std::int64_t departed = -1;  ///< tick at which the branch began; -1: it is the run itself
    Nanoseconds tickLength = 20'000'000;
    std::shared_ptr<const std::vector<TimelineMark>> marks;  ///< in the order of their ticks
    /// Marks of others than the run itself, in the order of their ticks, each with what is said of it.
    struct Noted {
        TimelineMark mark;
        QString text;
        QString name = {};   ///< beside the mark, where there is room
        bool faint = false;  ///< of a robot that is not asked about
    };
    std::vector<Noted> noted;
    std::vector<TickRange> unknown;                ///< without ground truth
    std::vector<std::int64_t> branches;            ///< ticks at which others departed from it
    std::shared_ptr<const Scenario> scenario;      ///< for names; may be null
    std::map<std::uint32_t, QString> breakpoints;  ///< what they wait for, by their numbers

    /// Marks of the run itself from one tick to another, both among them.
    std::span<const TimelineMark> marksBetween(std::int64_t from, std::int64_t to) const;
    /// The next mark after now, or the one before: of all kinds, or without contacts. nullopt: there is none.
    std::optional<std::int64_t> nextMark(bool contacts) const;
    std::optional<std::int64_t> previousMark(bool contacts) const;
    /// Whose mark it is, or which breakpoint's; empty: it is not known.
    QString nameOf(const TimelineMark& mark) const;
};

}  // namespace mrose
