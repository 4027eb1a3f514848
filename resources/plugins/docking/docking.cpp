// Drives a robot to one of two charging stations, and into it: the controller of the walk in
// resources/experiments/README.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "control/controller.h"
#include "geometry/angle.h"
#include "geometry/elementary.h"
#include "geometry/pose.h"
#include "plugin/plugin.h"

namespace {

using mrose::Pose;

/// Where the robot stands when it is docked, in the world's frame.
constexpr std::array<Pose, 2> stations{Pose{1.82, 0, 0}, Pose{-0.5, 1.32, 1.5707963267948966}};

class Docking : public mrose::Controller {
public:
    explicit Docking(mrose::PluginOptions& options)
        : approach_(options.number("approach_m", 0.8)),
          speed_(options.number("speed_mps", 0.07)),
          dockSpeed_(options.number("dock_speed_mps", 0.04)),
          aside_(options.number("aside_gain", 4)),
          turn_(options.number("turn_gain", 1.5)),
          trust_(options.number("trust", 0.2)),
          station_(static_cast<int>(options.number("station", 0))),
          times_(options.mapping("times",
                                 {"distance_1", "bearing_1", "arrival_1", "distance_2", "bearing_2", "arrival_2"},
                                 {"east", "north"})) {
        if (station_ < 0 || station_ > 2) options.reject("station", "expected 1, 2, or 0: it chooses one itself");
        if (trust_ <= 0 || trust_ > 1) options.reject("trust", "expected more than 0, at most 1");
    }

    enum State : std::int64_t { unknown, approaching, aligning, docking, docked, backingOff };

    struct Memory {
        Pose self;  // by odometry, drawn towards what it measures
        mrose::Nanoseconds measured;
        std::int64_t state, station;
        double lasts, stuck;  // s: in this state; without moving though it should
        double v;             // m/s, as commanded last
        double beyond;        // what was learned: how far it asked, a share
    };
    std::size_t memorySize() const override { return sizeof(Memory); }
    mrose::Attention attention() const override { return mrose::Attention::ofItself(); }

    void explain(std::span<const std::byte> bytes, mrose::MemoryEntries& entries) const override {
        static constexpr const char* names[] = {"unknown", "approaching", "aligning",
                                                "docking", "docked",      "backing off"};
        const Memory& memory = mrose::as<Memory>(bytes);
        entries.add("state", names[memory.state]);
        entries.add("station", static_cast<double>(memory.station + 1));
        entries.add("self x", memory.self.x, "m");
        entries.add("self y", memory.self.y, "m");
        if (times_ != nullptr) entries.add(mrose::beyondLearned, memory.beyond);
    }

    void decide(const mrose::Observation& observation, std::span<std::byte> bytes,
                mrose::Decision& decision) const override {
        Memory& memory = mrose::as<Memory>(bytes);
        decision.command = mrose::Command{};
        if (!observation.localised()) return;
        localise(observation, memory);
        if (memory.state == unknown) {
            memory.station = chosen(memory);
            enter(memory, approaching);
        }
        memory.lasts += period;
        decision.command = drive(observation, memory);
        memory.v = decision.command->v;
        const Pose& station = stations[static_cast<std::size_t>(memory.station)];
        decision.annotations.push_back(
            {mrose::Annotation::Kind::line, "way", 0, "", {position(memory.self), position(station)}});
    }

private:
    static constexpr double period = 0.1;  // s
    static constexpr double most = 0.5;    // rad/s: create.net knows 0.57

    void localise(const mrose::Observation& observation, Memory& memory) const {
        const mrose::Velocity moved = observation.velocity();
        if (memory.state == unknown) memory.self = observation.self();
        memory.self = memory.self * Pose{moved.v * period, 0, moved.w * period};
        if (observation.selfMeasured() == memory.measured) return;
        memory.measured = observation.selfMeasured();
        // What was measured, brought to now as it moves.
        const double age = mrose::toSeconds(observation.time - memory.measured);
        const Pose seen = observation.self() * Pose{moved.v * age, 0, moved.w * age};
        memory.self.x += trust_ * (seen.x - memory.self.x);
        memory.self.y += trust_ * (seen.y - memory.self.y);
        memory.self.heading += trust_ * mrose::wrapAngle(seen.heading - memory.self.heading);
    }

    int chosen(Memory& memory) const {
        const Pose& self = memory.self;
        if (station_ > 0) return station_ - 1;
        std::array<double, 6> asked{};
        for (std::size_t i = 0; i < 2; ++i) {
            const mrose::Point way = position(stations[i]) - position(self);
            asked[3 * i] = length(way);
            asked[3 * i + 1] = mrose::wrapAngle(direction(way) - self.heading);
            asked[3 * i + 2] = mrose::wrapAngle(stations[i].heading - direction(way));
        }
        if (times_ == nullptr) return asked[0] <= asked[3] ? 0 : 1;  // the nearer one
        std::array<double, 2> seconds{};
        times_->evaluate(asked, seconds);
        memory.beyond = times_->beyond(asked);
        return seconds[0] <= seconds[1] ? 0 : 1;
    }

    static void enter(Memory& memory, State state) { memory.state = state, memory.lasts = 0, memory.stuck = 0; }

    mrose::Command drive(const mrose::Observation& observation, Memory& memory) const {
        const Pose& station = stations[static_cast<std::size_t>(memory.station)];
        const Pose at = inverse(station) * memory.self;  // in the station's frame: it is driven into along x
        switch (memory.state) {
            case approaching: {
                const mrose::Point way =
                    mrose::Placement(memory.self).placeBack(position(station * Pose{-approach_, 0, 0}));
                if (length(way) < 0.06) return enter(memory, aligning), mrose::Command{};
                const double bearing = direction(way);
                const double ahead = std::abs(bearing) < 0.6 ? std::min(speed_, length(way)) : 0;
                return {ahead, std::clamp(turn_ * bearing, -most, most)};
            }
            case aligning: {
                const double off = mrose::wrapAngle(std::clamp(-aside_ * at.y, -0.5, 0.5) - at.heading);
                if (std::abs(off) < 0.05 && memory.lasts > 0.5) return enter(memory, docking), mrose::Command{};
                return {0, std::clamp(turn_ * off, -most, most)};
            }
            case docking: {
                const double off = mrose::wrapAngle(std::clamp(-aside_ * at.y, -0.5, 0.5) - at.heading);
                memory.stuck = std::abs(observation.velocity().v) < 0.3 * dockSpeed_ ? memory.stuck + period : 0;
                if (memory.stuck > 1 && at.x > -0.1) {
                    enter(memory, std::abs(at.y) < 0.02 && std::abs(at.heading) < 0.09 ? docked : backingOff);
                    return {};
                }
                if (memory.lasts > 30) enter(memory, backingOff);
                const double ahead = at.x < -0.3 ? std::max(speed_ / 2, dockSpeed_) : dockSpeed_;
                return {ahead, std::clamp(turn_ * off, -most, most)};
            }
            case backingOff:
                if (memory.lasts > 3) enter(memory, approaching);
                return {-0.07, 0};
            default:  // docked: whether it really is, only the station knows; it tries again where it is not
                if (memory.lasts > 2) enter(memory, backingOff);
                return {};
        }
    }

    double approach_, speed_, dockSpeed_, aside_, turn_, trust_;
    int station_;
    const mrose::LearnedMapping* times_;
};

}  // namespace

MROSE_PLUGIN(Docking)
