// What kind of robot a network is learned of: by the log, by name, by a robot file.
#include <algorithm>

#include "motion/motion_network.h"
#include "support/workshop.h"
#include "workflow/expect_error.h"
#include "workflow/train_network.h"

namespace mrose {
namespace {

class RobotType : public Workshop {
protected:
    /// Learned from the planted log, of a robot of that kind.
    Expected<TrainedNetwork> learned(const std::string& kind) {
        TrainRequest request = training(log(), "");
        request.robotKind = kind;
        return trainNetwork(request);
    }
};

constexpr const char* ownRobot = R"(format = "mrose robot"
version = 1
name = "My robot"
shape = "not drawn yet.toml"
mass_kg = 3
[motion]
network = "not learned yet.net"
[kind]
name = "my-robot"
[kind.learning]
wheel_phase = { half_track_m = 0.21, quantum_mps = 0.02 }
turn_offset_radps = 0.003
turns_on_tiny_commands = true
)";

bool reads(const MotionNetwork& network, NetworkInput::Quantity quantity) {
    return std::any_of(network.inputs.begin(), network.inputs.end(),
                       [&](const NetworkInput& input) { return input.quantity == quantity; });
}

TEST_F(RobotType, IsAnyRobotWhereTheLogDoesNotSay) {
    const auto trained = learned("");
    ASSERT_TRUE(trained) << trained.error().message();
    EXPECT_EQ(trained->network.robotType, "robot");
    EXPECT_FALSE(reads(trained->network, NetworkInput::Quantity::leftSine));
}

TEST_F(RobotType, IsToldByAMarkInTheLog) {
    const auto trained = trainNetwork(training(write("synthetic.csv", "# synthetic\n" + plantedCsv()), ""));
    ASSERT_TRUE(trained) << trained.error().message();
    EXPECT_EQ(trained->network.robotType, "reference-robot");
}

TEST_F(RobotType, IsAKindThatShipsByItsNameOrItsFile) {
    for (const std::string kind : {"irobot-create", "create.toml"}) {
        const auto trained = learned(kind);
        ASSERT_TRUE(trained) << trained.error().message();
        const MotionNetwork& network = trained->network;
        EXPECT_EQ(network.robotType, "irobot-create");
        EXPECT_TRUE((network.wheelPhase == MotionNetwork::WheelPhase{0.13, 0.0084}));
        EXPECT_EQ(network.turnOffset, 0.0055);
        EXPECT_TRUE(reads(network, NetworkInput::Quantity::leftSine));
        EXPECT_TRUE(reads(network, NetworkInput::Quantity::turnSense));
    }
}

TEST_F(RobotType, IsThatOfARobotFileWhoseNetworkIsStillToBeLearned) {
    const auto trained = learned(write("mine.toml", ownRobot));
    ASSERT_TRUE(trained) << trained.error().message();
    const MotionNetwork& network = trained->network;
    EXPECT_EQ(network.robotType, "my-robot");
    EXPECT_TRUE((network.wheelPhase == MotionNetwork::WheelPhase{0.21, 0.02}));
    EXPECT_EQ(network.turnOffset, 0.003);
    EXPECT_TRUE(reads(network, NetworkInput::Quantity::turnSense));
}

TEST_F(RobotType, ThatIsUnknownIsRefused) {
    expectError(learned("irobot-creat"), "",
                {"--type irobot-creat: is no kind of robot", "irobot-create", "reference-robot", "husky"});
    const auto shipped = learned("nomad200.toml");
    ASSERT_FALSE(shipped);
    expectError(shipped, shipped.error().file, {"nomad200.toml", "has no section [kind]"});
    const std::string wrong = write("wrong.toml", std::string(ownRobot) + "turn_offset_degps = 1\n");
    expectError(learned(wrong), wrong, {wrong + ":14:", "kind.learning.turn_offset_degps: is not a known key"});
}

}  // namespace
}  // namespace mrose
