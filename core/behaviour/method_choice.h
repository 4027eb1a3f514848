#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "control/controller.h"
#include "control/learned_mapping.h"
#include "planning/team_plan.h"

namespace mrose {

/// By which method a team plans, chosen for the way before it by what the plans of each method come to and by what
/// driving so has taken: a mapping that was learned. Part of a controller's memory; all zero nothing is chosen.
struct MethodChoice {
    static constexpr std::size_t most = 8;  ///< methods

    /// What a mapping may be asked with: of the team, or of what one method's plans come to.
    struct Input {
        std::size_t method = 0;
        double TeamEstimate::*estimate = nullptr;  ///< of that method, or ...
        double MethodChoice::*quantity = nullptr;  ///< ... of all
    };
    struct Options {
        std::vector<TeamMethod> methods;             ///< none: nothing is considered
        std::shared_ptr<const LearnedMapping> time;  ///< of `inputs` to the time by each method; null: none is chosen
        std::vector<Input> inputs;
        Nanoseconds listen = 400'000'000;  ///< to who is there and where they go, before
    };
    /// What is planned for: the team by its indices, what stands in the way, how they drive.
    struct Problem {
        std::span<const TeamMember> team;
        const DiscSpace& space;
        double objects = 0;
        DriveTimes drive;
        double separation = 0;  ///< m, between centres
    };

    std::int64_t chosen;      ///< 1 more than its place among the methods; 0: none
    std::int64_t considered;  ///< methods
    std::int64_t listening;
    Nanoseconds since;  ///< when it began to listen
    double robots, objects;
    double beyond;                             ///< how far the mapping was asked outside of what it has seen, a share
    std::array<TeamEstimate, most> estimates;  ///< of those that were considered
    std::array<double, most> expected;         ///< what the mapping says of each

    /// "robots", "objects", or "rests_3": of the estimate of the third method. nullopt: there is no such thing.
    static std::optional<Input> input(std::string_view name, std::size_t methods);

    static std::string inputNames();  ///< for people

    /// Whether it has listened for long enough, since it first asked.
    bool hasListened(Nanoseconds now, const Options& options);
    /// Whether there is nothing left to consider.
    bool isMade(const Options& options) const { return considered != 0 && (chosen != 0 || !options.time); }
    /// Plans by each method, and chooses the one of the least expected time.
    void consider(const Problem& problem, const Options& options);
    void explain(const Options& options, MemoryEntries& entries) const;
};
static_assert(sizeof(MethodChoice) == 7 * 8 + MethodChoice::most * (sizeof(TeamEstimate) + 8), "without padding");

}  // namespace mrose
