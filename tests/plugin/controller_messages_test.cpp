#include "plugin/controller_messages.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace mrose {
namespace {

Observation fullObservation() {
    Observation o;
    o.robot = 7;
    o.manipulators = 3;
    o.time = 123'456'789;
    o.noise = 0x8123456789abcdef;
    o.localised = true;
    o.self = {1.5, -2.5, 0.1};
    o.selfMeasured = 100;
    o.velocity = {0.3, -0.0};
    o.robots = {{1, {0.1, 0.2}, 5}, {2, {-0.1, std::numeric_limits<double>::denorm_min()}, 6}};
    o.objects = {{0, {9, 8}, 7}};
    return o;
}

Decision fullDecision() {
    Decision d;
    d.command = Command{0.25, -0.0};
    d.earlier = {{1, {0.1, 0.2}}, {2, {0.3, 0.4}}};
    d.kicks = {{3, 0.5}};
    d.annotations = {{Annotation::Kind::text, "label", 1.5, "some text", {}},
                     {Annotation::Kind::line, "", 0, "", {{1, 2}, {3, 4}}}};
    d.breakReason = "here";
    d.fault = std::string("zero\0byte", 9);
    return d;
}

std::string bytesOf(const Observation& observation) {
    std::string bytes;
    appendObservation(observation, bytes);
    return bytes;
}
std::string bytesOf(const Decision& decision) {
    std::string bytes;
    appendDecision(decision, bytes);
    return bytes;
}

TEST(ControllerMessages, ObservationComesBackToTheBit) {
    const std::string bytes = bytesOf(fullObservation());
    ByteReader reader(bytes);
    Observation read;
    read.robots.resize(9);
    ASSERT_TRUE(readObservation(reader, read));
    EXPECT_TRUE(reader.done());
    const Observation o = fullObservation();
    EXPECT_EQ(read, o);
    EXPECT_TRUE(std::signbit(read.velocity.w));
    EXPECT_EQ(bytesOf(read), bytes);
}

TEST(ControllerMessages, DecisionComesBackToTheBit) {
    const std::string bytes = bytesOf(fullDecision());
    ByteReader reader(bytes);
    Decision read;
    ASSERT_TRUE(readDecision(reader, read));
    EXPECT_TRUE(reader.done());
    EXPECT_TRUE(read.sameOrders(fullDecision()));
    EXPECT_TRUE(std::signbit(read.command->w));
    ASSERT_EQ(read.annotations.size(), 2u);
    EXPECT_EQ(read.annotations[0].kind, Annotation::Kind::text);
    EXPECT_EQ(read.annotations[0].label, "label");
    EXPECT_EQ(read.annotations[0].value, 1.5);
    EXPECT_EQ(read.annotations[0].text, "some text");
    EXPECT_EQ(read.annotations[1].points, fullDecision().annotations[1].points);
    EXPECT_EQ(read.breakReason, "here");
    EXPECT_EQ(read.fault, fullDecision().fault);
    Decision empty;
    const std::string none = bytesOf(Decision{});
    ByteReader again(none);
    read = fullDecision();
    ASSERT_TRUE(readDecision(again, read));
    EXPECT_TRUE(read.sameOrders(empty) && read.annotations.empty() && read.breakReason.empty() && read.fault.empty());
}

TEST(ControllerMessages, CutOffOnesAreRefused) {
    const std::string observation = bytesOf(fullObservation()), decision = bytesOf(fullDecision());
    for (std::size_t size = 0; size < observation.size(); ++size) {
        ByteReader reader(std::string_view(observation).substr(0, size));
        Observation read;
        EXPECT_FALSE(readObservation(reader, read)) << size;
    }
    for (std::size_t size = 0; size < decision.size(); ++size) {
        ByteReader reader(std::string_view(decision).substr(0, size));
        Decision read;
        EXPECT_FALSE(readDecision(reader, read)) << size;
    }
}

/// Every byte that is changed gives a value or a refusal, and no more memory than there are bytes.
TEST(ControllerMessages, ChangedOnesAreReadOrRefused) {
    const std::string sound = bytesOf(fullDecision());
    int refused = 0;
    for (std::size_t at = 0; at < sound.size(); ++at)
        for (const int change : {1, 0x80, 0xff}) {
            std::string bytes = sound;
            bytes[at] = static_cast<char>(bytes[at] ^ change);
            ByteReader reader(bytes);
            Decision read;
            refused += readDecision(reader, read) ? 0 : 1;
            EXPECT_LE(read.earlier.size() + read.kicks.size() + read.annotations.size(), bytes.size());
        }
    EXPECT_GT(refused, 20);
    std::string flag = bytesOf(Decision{});
    flag[0] = 2;
    ByteReader reader(flag);
    Decision read;
    EXPECT_FALSE(readDecision(reader, read));
}

/// A number of elements is believed as far as there are bytes for them.
TEST(ControllerMessages, NumbersAloneTakeNoMemory) {
    constexpr std::uint32_t many = 1 << 20;
    std::string bytes;
    appendNumber(bytes, false);  // no command, nothing earlier, no kicks
    for (const std::uint32_t size : {0u, 0u, many}) appendNumber(bytes, size);
    bytes.append(many, '\xff');  // no annotation
    ByteReader reader(bytes);
    Decision read;
    EXPECT_FALSE(readDecision(reader, read));
    EXPECT_LT(read.annotations.capacity(), 10u);
}

}  // namespace
}  // namespace mrose
