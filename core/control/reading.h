#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "geometry/point.h"
#include "geometry/pose.h"
#include "world/command.h"
#include "world/radio_limits.h"

namespace mrose {

enum class NumberKind : std::uint8_t { float64, float32, int64, int32, uint64, uint32, uint8 };

constexpr std::size_t sizeOf(NumberKind kind) {
    switch (kind) {
        case NumberKind::float64:
        case NumberKind::int64:
        case NumberKind::uint64:
            return 8;
        case NumberKind::float32:
        case NumberKind::int32:
        case NumberKind::uint32:
            return 4;
        case NumberKind::uint8:
            return 1;
    }
    return 0;
}

template <class T>
constexpr NumberKind numberKind() {
    if constexpr (std::is_same_v<T, double>) return NumberKind::float64;
    if constexpr (std::is_same_v<T, float>) return NumberKind::float32;
    if constexpr (std::is_same_v<T, std::int64_t>) return NumberKind::int64;
    if constexpr (std::is_same_v<T, std::int32_t>) return NumberKind::int32;
    if constexpr (std::is_same_v<T, std::uint64_t>) return NumberKind::uint64;
    if constexpr (std::is_same_v<T, std::uint32_t>) return NumberKind::uint32;
    if constexpr (std::is_same_v<T, std::uint8_t>) return NumberKind::uint8;
}

/// A number within a record.
struct RecordField {
    std::string name, unit;  ///< "x", "m"; without a unit ""
    NumberKind kind = NumberKind::float64;
    std::uint32_t offset = 0;  ///< B from the record's beginning
    std::uint32_t count = 1;   ///< so many in a row

    /// The `i`th of them in a record.
    double numberIn(const std::byte* record, std::size_t i = 0) const;
    bool operator==(const RecordField&) const = default;
};

template <class T>
RecordField field(const char* name, const char* unit, std::size_t offset, std::uint32_t count = 1) {
    return {name, unit, numberKind<T>(), static_cast<std::uint32_t>(offset), count};
}

/// What the records of a reading are made of: numbers with names and units, so that whoever does not know the C++ type
/// (a recording, another program) can read them all the same.
struct RecordType {
    std::string name;                 ///< "pose"
    std::uint32_t size = 0;           ///< B of a record in memory
    std::vector<RecordField> fields;  ///< one after the other, in the order of their offsets
    bool operator==(const RecordType&) const = default;
};

/// The type of records that are Ts: trivially copyable, of alignment 8 at most. Whoever adds a record specialises it.
template <class T>
const RecordType& recordType();

/// Another body as a robot's sensors report it.
struct SeenBody {
    std::uint32_t index = 0;   ///< of the robot or the object
    Point position_B;          ///< in the observer's own frame at `measured`, m
    Nanoseconds measured = 0;  ///< when it was there
    bool operator==(const SeenBody&) const = default;
};

/// A message that was received from another robot.
struct ReceivedMessage {
    Nanoseconds sent = 0;
    std::uint32_t from = 0;  ///< the robot
    std::uint32_t kind = 0;  ///< the sender's own: what the bytes are
    std::uint32_t size = 0;  ///< of the bytes
    std::array<std::byte, mostMessageBytes> bytes{};
    std::uint32_t unused = 0;
};

inline const RecordType receivedMessageRecord{
    "message",
    sizeof(ReceivedMessage),
    {field<Nanoseconds>("sent", "ns", offsetof(ReceivedMessage, sent)),
     field<std::uint32_t>("from", "", offsetof(ReceivedMessage, from)),
     field<std::uint32_t>("kind", "", offsetof(ReceivedMessage, kind)),
     field<std::uint32_t>("size", "B", offsetof(ReceivedMessage, size)),
     field<std::uint8_t>("bytes", "", offsetof(ReceivedMessage, bytes), mostMessageBytes)}};
template <>
inline const RecordType& recordType<ReceivedMessage>() {
    return receivedMessageRecord;
}

inline const RecordType poseRecord{
    "pose",
    sizeof(Pose),
    {field<double>("x", "m", offsetof(Pose, x)), field<double>("y", "m", offsetof(Pose, y)),
     field<double>("heading", "rad", offsetof(Pose, heading))}};
template <>
inline const RecordType& recordType<Pose>() {
    return poseRecord;
}

inline const RecordType velocityRecord{
    "velocity",
    sizeof(Velocity),
    {field<double>("v", "m/s", offsetof(Velocity, v)), field<double>("w", "rad/s", offsetof(Velocity, w))}};
template <>
inline const RecordType& recordType<Velocity>() {
    return velocityRecord;
}

inline const RecordType seenBodyRecord{"seen_body",
                                       sizeof(SeenBody),
                                       {field<std::uint32_t>("index", "", offsetof(SeenBody, index)),
                                        field<double>("x", "m", offsetof(SeenBody, position_B) + offsetof(Point, x)),
                                        field<double>("y", "m", offsetof(SeenBody, position_B) + offsetof(Point, y)),
                                        field<Nanoseconds>("measured", "ns", offsetof(SeenBody, measured))}};
template <>
inline const RecordType& recordType<SeenBody>() {
    return seenBodyRecord;
}

/// The name of a reading. It lies in place, so that observations are copied as bytes. A longer one throws
/// std::length_error.
class ReadingName {
public:
    static constexpr std::size_t most = 31;  ///< characters

    constexpr ReadingName() = default;
    constexpr ReadingName(std::string_view name) : size_(static_cast<std::uint8_t>(name.size())) {
        if (name.size() > most) throw std::length_error("a reading's name has at most 31 characters");
        for (std::size_t i = 0; i < name.size(); ++i) characters_[i] = name[i];
    }
    constexpr ReadingName(const char* name) : ReadingName(std::string_view(name)) {}
    ReadingName(const std::string& name) : ReadingName(std::string_view(name)) {}
    constexpr operator std::string_view() const { return {characters_.data(), size_}; }

    friend bool operator==(const ReadingName& a, const ReadingName& b) {
        // Most differ in their first eight characters.
        return a.beginning() == b.beginning() && std::memcmp(&a, &b, sizeof(ReadingName)) == 0;
    }

private:
    std::uint64_t beginning() const {
        std::uint64_t word = 0;
        std::memcpy(&word, characters_.data(), sizeof word);
        return word;
    }

    std::array<char, most> characters_{};
    std::uint8_t size_ = 0;
};
static_assert(std::is_trivially_copyable_v<ReadingName> && sizeof(ReadingName) == 32);

/// One reading of a sensor: records of one type. They lie in the observation that it is part of.
struct Reading {
    ReadingName name;  ///< which one it is: "self", "robots", a sensor's own
    const RecordType* type = nullptr;
    Nanoseconds measured = 0;  ///< when
    std::uint32_t first = 0;   ///< B, where its records begin among those of all readings
    std::uint32_t count = 0;   ///< of records
};

}  // namespace mrose
