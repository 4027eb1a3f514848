#include "messages/observation_bytes.h"

#include <algorithm>
#include <cstring>

#include "messages/text_bytes.h"

namespace mrose {
namespace {

constexpr std::size_t mostFields = 256;

void appendType(const RecordType& type, std::string& bytes) {
    appendText(type.name, bytes);
    appendCount(bytes, type.size);
    appendCount(bytes, type.fields.size());
    for (const RecordField& field : type.fields) {
        appendText(field.name, bytes);
        appendText(field.unit, bytes);
        appendNumber(bytes, static_cast<std::uint8_t>(field.kind));
        appendCount(bytes, field.offset);
        appendCount(bytes, field.count);
    }
}

std::size_t packedSizeOf(const RecordType& type) {
    std::size_t size = 0;
    for (const RecordField& field : type.fields) size += field.count * sizeOf(field.kind);
    return size;
}

/// Whether its fields lie within it, one after the other, and it is not much larger than they are.
bool sound(const RecordType& type) {
    std::size_t end = 0;  // of the field before
    for (const RecordField& field : type.fields) {
        if (field.offset < end || field.count == 0 || field.count > 1u << 16 || field.offset > type.size ||
            field.count * sizeOf(field.kind) > type.size - field.offset)
            return false;
        end = field.offset + field.count * sizeOf(field.kind);
    }
    return !type.fields.empty() && type.size <= packedSizeOf(type) + 8 * (type.fields.size() + 1);
}

bool readType(ByteReader& reader, RecordType& type) {
    if (!readText(reader, type.name)) return false;
    type.size = static_cast<std::uint32_t>(std::min<std::uint64_t>(readCount(reader), 1u << 30));
    const std::uint64_t fields = readCount(reader);
    if (fields > mostFields) return false;
    for (std::uint64_t i = 0; i < fields; ++i) {
        RecordField& field = type.fields.emplace_back();
        if (!readText(reader, field.name) || !readText(reader, field.unit)) return false;
        const auto kind = reader.number<std::uint8_t>();
        if (kind > static_cast<std::uint8_t>(NumberKind::uint8)) return false;
        field.kind = static_cast<NumberKind>(kind);
        field.offset = static_cast<std::uint32_t>(std::min<std::uint64_t>(readCount(reader), 1u << 30));
        field.count = static_cast<std::uint32_t>(std::min<std::uint64_t>(readCount(reader), 1u << 30));
    }
    return !reader.failed() && sound(type);
}

bool readReading(ByteReader& reader, RecordTypes& types, Observation& observation) {
    std::string name;
    RecordType told;
    if (!readText(reader, name) || name.size() > ReadingName::most || !readType(reader, told)) return false;
    const auto measured = reader.number<Nanoseconds>();
    const std::uint64_t count = readCount(reader);
    const std::size_t each = packedSizeOf(told);
    if (reader.failed() || each == 0 || count > reader.rest().size() / each) return false;
    const RecordType& type = types.of(std::move(told));
    std::byte* place = observation.add(name, type, measured, count);
    for (std::uint64_t i = 0; i < count; ++i, place += type.size)
        for (const RecordField& field : type.fields) {
            const std::string_view bytes = reader.take(field.count * sizeOf(field.kind));
            if (!bytes.empty()) std::memcpy(place + field.offset, bytes.data(), bytes.size());
        }
    return !reader.failed();
}

}  // namespace

const RecordType& RecordTypes::of(RecordType type) {
    for (const RecordType* known :
         {&recordType<Pose>(), &recordType<Velocity>(), &recordType<SeenBody>(), &recordType<ReceivedMessage>()})
        if (*known == type) return *known;
    const auto found = std::find(types_.begin(), types_.end(), type);
    return found != types_.end() ? *found : types_.emplace_back(std::move(type));
}

void appendObservation(const Observation& observation, std::string& bytes) {
    appendNumber(bytes, observation.robot);
    appendNumber(bytes, observation.manipulators);
    appendNumber(bytes, observation.time);
    appendNumber(bytes, observation.noise);
    appendCount(bytes, observation.readings().size());
    for (const Reading& reading : observation.readings()) {
        appendText(reading.name, bytes);
        appendType(*reading.type, bytes);
        appendNumber(bytes, reading.measured);
        appendCount(bytes, reading.count);
        const std::byte* record = observation.recordsOf(reading);
        for (std::uint32_t i = 0; i < reading.count; ++i, record += reading.type->size)
            for (const RecordField& field : reading.type->fields)
                bytes.append(reinterpret_cast<const char*>(record + field.offset), field.count * sizeOf(field.kind));
    }
}

bool readObservation(ByteReader& reader, RecordTypes& types, Observation& observation) {
    observation.robot = reader.number<std::uint32_t>();
    observation.manipulators = reader.number<std::uint32_t>();
    observation.time = reader.number<Nanoseconds>();
    observation.noise = reader.number<std::uint64_t>();
    observation.clearReadings();
    for (std::uint64_t left = readCount(reader); left > 0; --left)
        if (!readReading(reader, types, observation)) return false;
    return !reader.failed();
}

void appendAttention(const Attention& attention, std::string& bytes) {
    appendNumber(bytes, static_cast<std::uint8_t>(attention.all));
    appendCount(bytes, attention.names.size());
    for (const ReadingName& name : attention.names) appendText(name, bytes);
}

bool readAttention(ByteReader& reader, Attention& attention) {
    const auto all = reader.number<std::uint8_t>();
    attention = {all == 1, {}};
    bool sound = all <= 1;
    std::string name;
    for (std::uint64_t left = readCount(reader); sound && left > 0; --left) {
        sound = readText(reader, name) && name.size() <= ReadingName::most;
        if (sound) attention.names.emplace_back(name);
    }
    return sound && !reader.failed();
}

}  // namespace mrose
