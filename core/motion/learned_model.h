#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "learning/mlp_inference.h"
#include "motion/driving_reader.h"
#include "motion/input_reader.h"
#include "motion/motion_model.h"
#include "motion/motion_network.h"
#include "motion/residual_noise.h"

namespace mrose {

/// What of a network's distribution moves a robot.
enum class MotionDraw {
    mean,
    noisy,  ///< one run of many, where the network knows its noise and a key is given: MotionInput::noise
};

/// A motion network made ready for use; shared by all robots that it moves.
class LearnedMotion {
public:
    explicit LearnedMotion(MotionNetwork network);

    const MotionNetwork& network() const { return network_; }
    const InputReader& inputs() const { return inputs_; }

    /// What is remembered of a robot.
    struct Memory {
        /// The velocity at the period's end that the commands alone lead to: what differs from it has been pushed, and
        /// recovers. Of a network of form state whose drive ramps, which recovers by itself: what the drive follows
        /// (InputReader::Followed).
        Velocity unperturbed;
        std::uint32_t begun = 0;       ///< 0 before the first period: `unperturbed` is told from the commands
        std::uint32_t followedAt = 0;  ///< when the drive follows that: the lower bits of microseconds; 0: at no time
        /// Of the tracked point, besides what the network knows: MotionModel::adapt.
        float ahead = 0, rotated = 0;
    };
    /// Bytes that are remembered of a robot: Memory; of a network of form history whose drive ramps, what it follows;
    /// and where noise is drawn, what that remembers.
    std::size_t memorySize(MotionDraw draw) const;
    static constexpr std::size_t largestOfMean = sizeof(Memory) + sizeof(Velocity);  ///< memorySize(mean), at most
    /// What is remembered of a robot, for people: velocities, and how large the noise is.
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const;

    /// How the tracked point lies on the robot of this index, as far as the network knows; none of one that it does
    /// not.
    TrackerOffset tracker(int robot) const {
        return robot >= 0 ? trackers_[static_cast<std::size_t>(robot)] : TrackerOffset{};
    }
    /// What a memory takes over of what was seen of its robot before: MotionModel::adapt.
    void adapt(int robot, std::span<std::byte> memory, const TrackerEvidence& seen) const;

    /// What a memory takes over of what its robot was sent before: MotionModel::recall.
    void recall(std::span<std::byte> memory, const CommandView& sent, Nanoseconds start) const;

    /// Steps for robots that may differ: robots[i] is the index by InputReader::robotIndex.
    void predict(std::span<const MotionInput> inputs, std::span<const int> robots, std::span<MotionStep> steps,
                 MotionDraw draw = MotionDraw::mean) const;

    /// How many networks it is the mean of; 0 where these are not known.
    std::size_t memberCount() const { return network_.members.size(); }

    /// The same steps, and what each member predicts by itself: members[i * memberCount() + m] from inputs[i]. Outputs
    /// that were fitted to all members together, the velocities of the history form, are the same in all of them.
    void predictMembers(std::span<const MotionInput> inputs, std::span<const int> robots, std::span<MotionStep> steps,
                        std::span<MotionStep> members) const;

    /// What it was learned from; null where that is not known.
    const DrivingReader* familiar() const { return familiar_ ? &*familiar_ : nullptr; }

private:
    double value(const float* outputs, std::size_t index) const {
        return network_.outputs[index].mean + network_.outputs[index].scale * static_cast<double>(outputs[index]);
    }
    /// `noise`: of the increment.
    MotionStep toStep(const MotionInput& input, int robot, const float* outputs,
                      const std::optional<Pose>& noise = std::nullopt) const;
    void readInputs(const MotionInput& input, int robot, float* row) const;
    void remember(const MotionInput& input, const float* outputs) const;
    /// Whether what the drive follows lies in Memory, or behind it.
    bool followsInMemory() const { return inputs_.ramps() && network_.form == MotionNetwork::Form::state; }
    bool followsBehind() const { return inputs_.ramps() && network_.form == MotionNetwork::Form::history; }
    template <class Bytes>
    auto& followedIn(Bytes memory) const {
        return followsBehind() ? as<Velocity>(memory.subspan(sizeof(Memory))) : as<Memory>(memory).unperturbed;
    }
    /// Of what the noise remembers.
    std::size_t noiseOffset() const { return sizeof(Memory) + (followsBehind() ? sizeof(Velocity) : 0); }
    /// Of the network that this is drawn by: with the outputs of the members where the noise needs them.
    const MlpInference& inferenceFor(MotionDraw draw) const;
    Pose incrementOf(const float* outputs) const { return {value(outputs, 0), value(outputs, 1), value(outputs, 2)}; }
    std::optional<Pose> drawNoise(const MotionInput& input, const float* row, const float* outputs) const;

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
    TrackerOffset usualTracker_;           ///< mean of the identified ones
    struct Noise {
        NoiseTraitReader traits;
        NoiseProcesses processes;
    };
    std::optional<Noise> noise_;
    std::optional<DrivingReader> familiar_;
};

/// The motion of one robot.
class LearnedModel final : public MotionModel {
public:
    /// A robot that the network was not learned from moves like the mean of those that it was.
    LearnedModel(std::shared_ptr<const LearnedMotion> motion, const std::string& robot,
                 MotionDraw draw = MotionDraw::mean);

    const MotionNetwork& network() const { return motion_->network(); }
    /// Noisy only where the network knows its noise.
    MotionDraw draw() const { return draw_; }
    /// The same robot, drawn otherwise.
    std::shared_ptr<const LearnedModel> drawn(MotionDraw draw) const;
    const LearnedMotion& motion() const { return *motion_; }
    int robot() const { return robot_; }  ///< by InputReader::robotIndex
    Nanoseconds period() const override { return network().period; }
    Nanoseconds lookBack() const override { return motion_->inputs().lookBack(); }
    DeadTimes deadTimes() const override { return deadTimes_; }
    bool sameAs(const MotionModel& other) const override;
    std::size_t memorySize() const override { return motion_->memorySize(draw_); }
    void restart(std::span<std::byte> memory) const override;
    void adapt(std::span<std::byte> memory, const TrackerEvidence& seen) const override {
        motion_->adapt(robot_, memory, seen);
    }
    void recall(std::span<std::byte> memory, const CommandView& sent, Nanoseconds start) const override {
        motion_->recall(memory, sent, start);
    }
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const override;
    /// Of the members about their mean (of a sample: divided by their number less one), which the steps are.
    void predictWithSpread(std::span<const MotionInput> inputs, std::span<MotionStep> steps,
                           std::span<MotionSpread> spreads) const override;

private:
    std::shared_ptr<const LearnedMotion> motion_;
    int robot_;
    MotionDraw draw_;
    DeadTimes deadTimes_;
};

/// The mean in the place of a noisy learned model; any other model as it is.
std::shared_ptr<const MotionModel> meanOf(std::shared_ptr<const MotionModel> model);

/// The learned model that a robot is moved by, whatever is added to it; null where it is of another kind.
const LearnedModel* learnedModel(const MotionModel& model);

}  // namespace mrose
