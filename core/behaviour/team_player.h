#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "behaviour/chase_ball.h"
#include "behaviour/role_choice.h"
#include "control/learned_mapping.h"

namespace mrose {

/// A player of a team that does not chase the ball by all of its robots at once. It tells its team by radio what it
/// believes of itself, what it has seen of the ball, and what its going for it would cost. By its own belief, with what
/// its mates tell, it decides who goes: whom that costs least (RoleChoice). If that is it, it chases the ball as
/// ChaseBall does; otherwise it takes a place between ball and own goal, or beside. A keeper stays in its goal.
class TeamPlayer final : public Controller {
public:
    enum class Choose {
        time,               ///< the time until it is at the ball, 0.6 m from it, as it was learned, s
        nearest,            ///< the distance to the ball, m
        distanceOverSpeed,  ///< the same over its own speed, s
        fixed               ///< the one that the options name
    };
    struct Member {
        std::uint32_t robot = 0;
        std::string name;
    };
    struct Options {
        ChaseBall::Options chase;
        Point ownGoal;
        std::vector<Member> team;  ///< with this one; at most RoleChoice::most
        bool keeper = false;
        Choose choose = Choose::distanceOverSpeed;
        std::shared_ptr<const LearnedMapping> time = nullptr;  ///< of Choose::time: wayToBallNames to time_s
        std::int64_t goes = 0;                                 ///< of Choose::fixed: 1 more than the place in the team
        RoleChoice::Options role;
        /// So much later who goes stops: players decide at instants of their own, and rather two go than nobody.
        Nanoseconds handOver = 30'000'000;
    };

    explicit TeamPlayer(Options options);

    std::size_t memorySize() const override;
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override;

private:
    struct Memory;
    std::size_t placeOf(std::uint32_t robot) const;
    void listen(const Observation& observation, Memory& memory) const;
    double costOf(const Memory& memory) const;
    void bid(const Observation& observation, std::size_t place, std::span<const Point> others, Memory& memory) const;
    void tell(const Observation& observation, std::size_t place, const Memory& memory, Decision& decision) const;
    Point placeOfSeen(const SeenBody& seen, const Memory& memory) const;
    std::vector<Point> othersOnTheFloor(const Observation& observation, std::size_t place, const Memory& memory) const;
    Point supportingPlace(std::size_t place, const Memory& memory) const;
    Command support(const Observation& observation, std::size_t place, std::span<const Point> others,
                    Memory& memory) const;
    void annotate(const Memory& memory, Decision& decision) const;
    std::string nameOfGoer(const Memory& memory) const;

    Options options_;
    ChaseBall chase_;
};

}  // namespace mrose
