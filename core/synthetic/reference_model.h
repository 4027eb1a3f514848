#pragma once

#include "motion/motion_model.h"
#include "synthetic/reference_robot.h"

namespace mrose {

/// The reference robot as what moves a robot of the world: synthetic, of another class than what is learned from it.
/// All of it, with the commands on their way to it, is memory in the world's state. Where contact has changed its
/// velocity its wheels go on from there.
class ReferenceModel final : public MotionModel {
public:
    /// So long at most: what is issued in a period must still be on its way at the period's end.
    static constexpr Nanoseconds longestPeriod = 200'000'000;

    /// `period` is a whole multiple of ReferenceRobot::step.
    explicit ReferenceModel(Nanoseconds period, const ReferenceRobotParameters& parameters = {})
        : period_(period), parameters_(parameters) {}

    /// The seed of the robot that a draw of the world's noise is for: with another seed of the run, and for another
    /// robot, it is another one.
    static std::uint64_t robotSeed(const NoiseKey& noise);

    /// What it remembers of a robot.
    struct Memory {
        ReferenceRobotState robot;   ///< its pose is counted from the period's start
        Nanoseconds switchedOn = 0;  ///< by the world's clock
        Nanoseconds lastRead = 0;    ///< commands issued later are new
        std::uint64_t begun = 0;     ///< 0 before the first period
    };

    const ReferenceRobotParameters& parameters() const { return parameters_; }
    Nanoseconds period() const override { return period_; }
    Nanoseconds lookBack() const override;
    DeadTimes deadTimes() const override;
    bool sameAs(const MotionModel& other) const override;
    std::size_t memorySize() const override { return sizeof(Memory); }
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    /// Without a noise key nothing about it is random.
    void predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const override;

private:
    MotionStep step(const MotionInput& input, Memory& memory) const;
    void begin(const ReferenceRobot& robot, const MotionInput& input, Memory& memory) const;

    Nanoseconds period_;
    ReferenceRobotParameters parameters_;
};

}  // namespace mrose
