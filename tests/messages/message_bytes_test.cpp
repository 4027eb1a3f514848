#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "messages/decision_bytes.h"
#include "messages/memory_entry_bytes.h"
#include "messages/observation_bytes.h"
#include "messages/text_bytes.h"
#include "support/observation_parts.h"

namespace mrose {
namespace {

/// A record that nobody but the test knows.
struct Beam {
    float range = 0;
    std::uint8_t echoes = 0;
    std::array<std::int32_t, 3> levels{};
};
}  // namespace

template <>
const RecordType& recordType<Beam>() {
    static const RecordType type{
        "beam",
        sizeof(Beam),
        {field<float>("range", "m", offsetof(Beam, range)), field<std::uint8_t>("echoes", "", offsetof(Beam, echoes)),
         field<std::int32_t>("levels", "V", offsetof(Beam, levels), 3)}};
    return type;
}

namespace {

Observation fullObservation() {
    ObservationParts o;
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
    Observation whole = o;
    const std::array<Beam, 2> beams{Beam{1.5f, 2, {1, -2, 3}}, Beam{0, 255, {4, 5, 6}}};
    whole.add("scan", 99, std::span<const Beam>(beams));
    whole.add("messages", 100, ReceivedMessage{5, 1, 2, 3, {std::byte{7}}});
    whole.add("scan", 101, std::span<const Beam>());
    return whole;
}

Decision fullDecision() {
    Decision d;
    d.command = Command{0.25, -0.0};
    d.earlier = {{1, {0.1, 0.2}}, {2, {0.3, 0.4}}};
    d.kicks = {{3, 0.5}};
    d.messages = {RadioMessage::of(1.5, 4, 2), {broadcast, 0, 0, {}}};
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

TEST(MessageBytes, ObservationComesBackToTheBit) {
    const std::string bytes = bytesOf(fullObservation());
    ByteReader reader(bytes);
    RecordTypes types;
    Observation read;
    read.add("old", 1, Pose{});
    ASSERT_TRUE(readObservation(reader, types, read));
    EXPECT_TRUE(reader.done());
    const Observation o = fullObservation();
    EXPECT_EQ(read, o);
    EXPECT_TRUE(std::signbit(read.velocity().w));
    const auto beams = read.records<Beam>("scan");
    ASSERT_EQ(beams.size(), 2u);
    EXPECT_EQ(beams[1].levels[2], 6);
    EXPECT_EQ(bytesOf(read), bytes);
}

TEST(MessageBytes, DecisionComesBackToTheBit) {
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

TEST(MessageBytes, MemoryEntriesComeBackToTheBit) {
    const std::vector<MemoryEntry> entries{{"count", -0.0, "", ""}, {"mode", 0, "", "searching"}, {"", 1.5, "m/s"}};
    std::string bytes;
    appendEntries(entries, bytes);
    ByteReader reader(bytes);
    std::vector<MemoryEntry> read;
    ASSERT_TRUE(readEntries(reader, read) && reader.done());
    ASSERT_EQ(read.size(), 3u);
    EXPECT_TRUE(std::signbit(read[0].value));
    EXPECT_EQ(read[1].text, "searching");
    EXPECT_EQ(read[2].unit, "m/s");
    std::string again;
    appendEntries(read, again);
    EXPECT_EQ(again, bytes);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        ByteReader cut(std::string_view(bytes).substr(0, size));
        EXPECT_FALSE(readEntries(cut, read)) << size;
    }
}

TEST(MessageBytes, NamesOfReadingsAreOfBoundedLength) {
    const auto reads = [](std::size_t length) {
        std::string bytes(1, '\0');
        appendCount(bytes, 1);
        appendText(std::string(length, 'n'), bytes);
        ByteReader reader(bytes);
        Attention read;
        return readAttention(reader, read) && read.names.at(0) == ReadingName(std::string(length, 'n'));
    };
    EXPECT_TRUE(reads(ReadingName::most));
    EXPECT_FALSE(reads(ReadingName::most + 1));
    Observation observation;
    observation.add(std::string(ReadingName::most, 'n'), 0, Pose{});
    std::string bytes = bytesOf(observation);
    const std::size_t at = bytes.find("nnn");
    bytes.insert(at, "n");
    ++bytes[at - 1];
    ByteReader reader(bytes);
    RecordTypes types;
    Observation read;
    EXPECT_FALSE(readObservation(reader, types, read));
}

TEST(MessageBytes, CutOffOnesAreRefused) {
    const std::string observation = bytesOf(fullObservation()), decision = bytesOf(fullDecision());
    for (std::size_t size = 0; size < observation.size(); ++size) {
        ByteReader reader(std::string_view(observation).substr(0, size));
        RecordTypes types;
        Observation read;
        EXPECT_FALSE(readObservation(reader, types, read)) << size;
    }
    for (std::size_t size = 0; size < decision.size(); ++size) {
        ByteReader reader(std::string_view(decision).substr(0, size));
        Decision read;
        EXPECT_FALSE(readDecision(reader, read)) << size;
    }
}

/// Every byte that is changed gives a value or a refusal, and no more memory than there are bytes.
TEST(MessageBytes, ChangedOnesAreReadOrRefused) {
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
    flag[0] = 64;
    ByteReader reader(flag);
    Decision read;
    EXPECT_FALSE(readDecision(reader, read));
}

/// What a type tells is no reason to take memory that its bytes do not fill.
TEST(MessageBytes, TypesThatDoNotFitTheirFieldsAreRefused) {
    const auto reads = [](const RecordType& type, std::uint64_t count, const std::string& rest) {
        std::string bytes = bytesOf(Observation());
        bytes.pop_back();  // no readings
        appendCount(bytes, 1);
        appendText("a", bytes);
        appendText(type.name, bytes);
        appendCount(bytes, type.size);
        appendCount(bytes, type.fields.size());
        for (const RecordField& f : type.fields) {
            appendText(f.name, bytes);
            appendText(f.unit, bytes);
            appendNumber(bytes, static_cast<std::uint8_t>(f.kind));
            appendCount(bytes, f.offset);
            appendCount(bytes, f.count);
        }
        appendNumber(bytes, std::int64_t{0});
        appendCount(bytes, count);
        bytes += rest;
        ByteReader reader(bytes);
        RecordTypes types;
        Observation read;
        return readObservation(reader, types, read);
    };
    const RecordField number{"x", "", NumberKind::float64, 0, 1};
    EXPECT_TRUE(reads({"t", 8, {number}}, 1, std::string(8, 'x')));
    EXPECT_FALSE(reads({"t", 8, {number}}, 2, std::string(8, 'x')));
    EXPECT_FALSE(reads({"t", 4, {number}}, 1, std::string(8, 'x')));
    EXPECT_FALSE(reads({"t", 1 << 20, {number}}, 1, std::string(8, 'x')));
    EXPECT_FALSE(reads({"t", 8, {{"x", "", NumberKind::float64, 1, 1}}}, 1, std::string(8, 'x')));
    EXPECT_FALSE(reads({"t", 8, {}}, 1, ""));
    const RecordField within{"y", "", NumberKind::uint8, 4, 1};
    EXPECT_FALSE(reads({"t", 8, {number, within}}, 1, std::string(9, 'x'))) << "one lies in the other";
}

/// A manipulator beyond 32 bits would come back as another one.
TEST(MessageBytes, KicksOfManipulatorsThatCannotBeAreRefused) {
    const auto reads = [](std::uint64_t manipulator) {
        std::string bytes(1, '\4');  // kicks alone
        appendCount(bytes, 1);
        appendCount(bytes, manipulator);
        appendNumber(bytes, 0.5);
        ByteReader reader(bytes);
        Decision read;
        bool fromOutside = false;
        return readOrders(reader, read, fromOutside);
    };
    EXPECT_TRUE(reads(0xffffffff));
    EXPECT_FALSE(reads(0x100000000));
}

/// A number of elements is believed as far as there are bytes for them.
TEST(MessageBytes, NumbersAloneTakeNoMemory) {
    constexpr std::uint32_t many = 1 << 20;
    std::string bytes(1, '\0');  // no orders
    appendCount(bytes, many);
    bytes.append(many, '\xff');  // no annotation
    ByteReader reader(bytes);
    Decision read;
    EXPECT_FALSE(readDecision(reader, read));
    EXPECT_LT(read.annotations.capacity(), 10u);
}

}  // namespace
}  // namespace mrose
