// What kind of robot a network is learned of: by the log, by name, by a robot file.
#include <gmock/gmock.h>

#include "cli/workshop.h"
#include "motion/motion_network.h"

namespace mrose {
namespace {

using RobotType = Workshop;

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

MotionNetwork learned(const std::vector<std::string>& words, const std::string& file) {
    const ProgramResult result = runMrose(words);
    EXPECT_EQ(result.status, 0) << result.err;
    const auto network = loadNetwork(file);
    EXPECT_TRUE(network) << network.error().message();
    return network.value_or(MotionNetwork{});
}

bool reads(const MotionNetwork& network, NetworkInput::Quantity quantity) {
    return std::any_of(network.inputs.begin(), network.inputs.end(),
                       [&](const NetworkInput& input) { return input.quantity == quantity; });
}

TEST_F(RobotType, IsAnyRobotWhereTheLogDoesNotSay) {
    const MotionNetwork network = learned(trainWords(path("a.net")), path("a.net"));
    EXPECT_EQ(network.robotType, "robot");
    EXPECT_FALSE(reads(network, NetworkInput::Quantity::leftSine));
}

TEST_F(RobotType, IsToldByAMarkInTheLog) {
    const std::string drive = write("synthetic.csv", "# synthetic\n" + plantedCsv());
    EXPECT_EQ(learned(trainWords(drive, path("a.net")), path("a.net")).robotType, "reference-robot");
}

TEST_F(RobotType, IsAKindThatShipsByItsNameOrItsFile) {
    for (const std::string type : {"irobot-create", "create.toml"}) {
        auto words = trainWords(path(type + ".net"));
        words.insert(words.end(), {"--type", type});
        const MotionNetwork network = learned(words, path(type + ".net"));
        EXPECT_EQ(network.robotType, "irobot-create");
        EXPECT_TRUE((network.wheelPhase == MotionNetwork::WheelPhase{0.13, 0.0084}));
        EXPECT_EQ(network.turnOffset, 0.0055);
        EXPECT_TRUE(reads(network, NetworkInput::Quantity::leftSine));
        EXPECT_TRUE(reads(network, NetworkInput::Quantity::turnSense));
    }
}

TEST_F(RobotType, IsThatOfARobotFileWhoseNetworkIsStillToBeLearned) {
    auto words = trainWords(path("a.net"));
    words.insert(words.end(), {"--type", write("mine.toml", ownRobot)});
    const MotionNetwork network = learned(words, path("a.net"));
    EXPECT_EQ(network.robotType, "my-robot");
    EXPECT_TRUE((network.wheelPhase == MotionNetwork::WheelPhase{0.21, 0.02}));
    EXPECT_EQ(network.turnOffset, 0.003);
    EXPECT_TRUE(reads(network, NetworkInput::Quantity::turnSense));
}

TEST_F(RobotType, ThatIsUnknownIsRefused) {
    const auto refused = [&](const std::string& type, const std::vector<std::string>& parts) {
        auto words = trainWords(path("a.net"));
        words.insert(words.end(), {"--type", type});
        expectOneLine(runMrose(words), parts);
        EXPECT_EQ(read("a.net"), "");
    };
    refused("irobot-creat", {"--type irobot-creat: is no kind of robot", "irobot-create", "reference-robot", "husky"});
    refused("nomad200.toml", {"nomad200.toml", "has no section [kind]"});
    const std::string wrong = write("wrong.toml", std::string(ownRobot) + "turn_offset_degps = 1\n");
    refused(wrong, {wrong + ":14:", "kind.learning.turn_offset_degps: is not a known key"});
}

}  // namespace
}  // namespace mrose
