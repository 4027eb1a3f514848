#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "learning/mlp_inference.h"
#include "motion/input_reader.h"
#include "motion/motion_model.h"
#include "motion/motion_network.h"

namespace mrose {

/// A motion network made ready for use; shared by all robots that it moves.
class LearnedMotion {
public:
    explicit LearnedMotion(MotionNetwork network);

    const MotionNetwork& network() const { return network_; }
    const InputReader& inputs() const { return inputs_; }

    /// What is remembered of a robot.
    struct Memory {
        /// The velocity at the period's end that the commands alone lead to: what differs from it has been pushed, and
        /// recovers.
        Velocity unperturbed;
        std::uint64_t begun = 0;  ///< 0 before the first period: `unperturbed` is told from the commands
        std::uint64_t unused = 0;
    };

    /// Steps for robots that may differ: robots[i] is the index by InputReader::robotIndex.
    void predict(std::span<const MotionInput> inputs, std::span<const int> robots, std::span<MotionStep> steps) const;

    /// How many networks it is the mean of; 0 where these are not known.
    std::size_t memberCount() const { return network_.members.size(); }

    /// The same steps, and what each member predicts by itself: members[i * memberCount() + m] from inputs[i]. Outputs
    /// that were fitted to all members together, the velocities of the history form, are the same in all of them.
    void predictMembers(std::span<const MotionInput> inputs, std::span<const int> robots, std::span<MotionStep> steps,
                        std::span<MotionStep> members) const;

private:
    double value(const float* outputs, std::size_t index) const {
        return network_.outputs[index].mean + network_.outputs[index].scale * static_cast<double>(outputs[index]);
    }
    MotionStep toStep(const MotionInput& input, int robot, const float* outputs) const;
    void remember(const MotionInput& input, const float* outputs) const;

    MotionNetwork network_;
    InputReader inputs_;
    MlpInference inference_;
    std::optional<MlpInference> withMembers_;  ///< where they are known
    struct Decay {
        double velocity = 0;      ///< what is left of a velocity disturbance after the period
        double displacement = 0;  ///< s: what it moved the robot per unit of velocity
    };
    static Decay decayOf(double timeConstant, double period);
    Decay decayV_, decayW_;
    std::vector<TrackerOffset> trackers_;  ///< by robot index
};

/// The motion of one robot.
class LearnedModel final : public MotionModel {
public:
    /// A robot that the network was not learned from moves like the mean of those that it was.
    LearnedModel(std::shared_ptr<const LearnedMotion> motion, const std::string& robot);

    const MotionNetwork& network() const { return motion_->network(); }
    int robot() const { return robot_; }  ///< by InputReader::robotIndex
    Nanoseconds period() const override { return network().period; }
    Nanoseconds lookBack() const override { return motion_->inputs().lookBack(); }
    DeadTimes deadTimes() const override { return deadTimes_; }
    bool sameAs(const MotionModel& other) const override;
    std::size_t memorySize() const override { return sizeof(LearnedMotion::Memory); }
    std::vector<MemoryEntry> explain(std::span<const std::byte> memory) const override;
    void predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const override;
    /// Of the members about their mean (of a sample: divided by their number less one).
    void predictWithSpread(std::span<const MotionInput> inputs, std::span<MotionStep> steps,
                           std::span<MotionSpread> spreads) const override;

private:
    std::shared_ptr<const LearnedMotion> motion_;
    int robot_;
    DeadTimes deadTimes_;
};

/// The learned model that a robot is moved by, whatever is added to it; null where it is of another kind.
const LearnedModel* learnedModel(const MotionModel& model);

}  // namespace mrose
