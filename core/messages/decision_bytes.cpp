#include "messages/decision_bytes.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "messages/text_bytes.h"

namespace mrose {
namespace {

enum Flag : std::uint8_t {
    hasCommand = 1,
    hasEarlier = 2,
    hasKicks = 4,
    hasFault = 8,
    isFromOutside = 16,
    hasMessages = 32
};

std::uint8_t flagsOf(const Decision& d, bool fromOutside) {
    return static_cast<std::uint8_t>((d.command ? hasCommand : 0) | (d.earlier.empty() ? 0 : hasEarlier) |
                                     (d.kicks.empty() ? 0 : hasKicks) | (d.fault.empty() ? 0 : hasFault) |
                                     (fromOutside ? isFromOutside : 0) | (d.messages.empty() ? 0 : hasMessages));
}

void appendCommand(std::string& bytes, const Command& command) {
    appendNumber(bytes, command.v);
    appendNumber(bytes, command.w);
}

Command readCommand(ByteReader& reader) {
    const double v = reader.number<double>();
    return {v, reader.number<double>()};
}

/// Calls read() as often as a count says, as far as there are bytes and it finds them sound; whether all were.
template <class Read>
bool readEach(ByteReader& reader, bool any, Read read) {
    for (std::uint64_t left = any ? readCount(reader) : 0; left > 0; --left)
        if (reader.failed() || !read()) return false;
    return !reader.failed();
}

void appendMessage(std::string& bytes, const RadioMessage& message) {
    appendNumber(bytes, message.to);
    appendNumber(bytes, message.kind);
    const std::size_t size = std::min<std::size_t>(message.size, message.bytes.size());
    appendCount(bytes, size);
    bytes.append(reinterpret_cast<const char*>(message.bytes.data()), size);
}

bool readMessage(ByteReader& reader, RadioMessage& message) {
    message.to = reader.number<std::uint32_t>();
    message.kind = reader.number<std::uint32_t>();
    const std::uint64_t size = readCount(reader);
    if (size > message.bytes.size()) return false;
    message.size = static_cast<std::uint32_t>(size);
    const std::string_view text = reader.take(size);
    if (!text.empty()) std::memcpy(message.bytes.data(), text.data(), text.size());
    return !reader.failed();
}

void appendAnnotation(std::string& bytes, const Annotation& annotation) {
    appendNumber(bytes, static_cast<std::uint8_t>(annotation.kind));
    appendText(annotation.label, bytes);
    appendNumber(bytes, annotation.value);
    appendText(annotation.text, bytes);
    appendCount(bytes, annotation.points.size());
    for (const Point& point : annotation.points) {
        appendNumber(bytes, point.x);
        appendNumber(bytes, point.y);
    }
}

bool readAnnotation(ByteReader& reader, Annotation& annotation) {
    const auto kind = reader.number<std::uint8_t>();
    if (kind > static_cast<std::uint8_t>(Annotation::Kind::line)) return false;
    annotation.kind = static_cast<Annotation::Kind>(kind);
    if (!readText(reader, annotation.label)) return false;
    annotation.value = reader.number<double>();
    if (!readText(reader, annotation.text)) return false;
    return readEach(reader, true, [&] {
        const double x = reader.number<double>();
        annotation.points.push_back({x, reader.number<double>()});
        return true;
    });
}

}  // namespace

void appendOrders(const Decision& decision, bool fromOutside, std::string& bytes) {
    const std::uint8_t flags = flagsOf(decision, fromOutside);
    appendNumber(bytes, flags);
    if (flags & hasCommand) appendCommand(bytes, *decision.command);
    if (flags & hasEarlier) appendCount(bytes, decision.earlier.size());
    for (const StampedCommand& earlier : decision.earlier) {
        appendNumber(bytes, earlier.time);
        appendCommand(bytes, earlier.command);
    }
    if (flags & hasKicks) appendCount(bytes, decision.kicks.size());
    for (const Kick& kick : decision.kicks) {
        appendCount(bytes, kick.manipulator);
        appendNumber(bytes, kick.power);
    }
    if (flags & hasFault) appendText(decision.fault, bytes);
    if (flags & hasMessages) appendCount(bytes, decision.messages.size());
    for (const RadioMessage& message : decision.messages) appendMessage(bytes, message);
}

bool readOrders(ByteReader& reader, Decision& decision, bool& fromOutside) {
    const auto flags = reader.number<std::uint8_t>();
    fromOutside = (flags & isFromOutside) != 0;
    decision.clear();
    if (flags & hasCommand) decision.command = readCommand(reader);
    bool sound = readEach(reader, (flags & hasEarlier) != 0, [&] {
        const auto time = reader.number<Nanoseconds>();
        decision.earlier.push_back({time, readCommand(reader)});
        return true;
    });
    sound = sound && readEach(reader, (flags & hasKicks) != 0, [&] {
                const std::uint64_t manipulator = readCount(reader);
                decision.kicks.push_back({static_cast<std::uint32_t>(manipulator), reader.number<double>()});
                return manipulator <= std::numeric_limits<std::uint32_t>::max();
            });
    sound = sound && ((flags & hasFault) == 0 || readText(reader, decision.fault));
    sound = sound && readEach(reader, (flags & hasMessages) != 0,
                              [&] { return readMessage(reader, decision.messages.emplace_back()); });
    return sound && !reader.failed() && flagsOf(decision, fromOutside) == flags;
}

void appendDecision(const Decision& decision, std::string& bytes) {
    appendOrders(decision, false, bytes);
    appendCount(bytes, decision.annotations.size());
    for (const Annotation& annotation : decision.annotations) appendAnnotation(bytes, annotation);
    appendText(decision.breakReason, bytes);
}

bool readDecision(ByteReader& reader, Decision& decision) {
    bool fromOutside = false;
    return readOrders(reader, decision, fromOutside) && !fromOutside &&
           readEach(reader, true, [&] { return readAnnotation(reader, decision.annotations.emplace_back()); }) &&
           readText(reader, decision.breakReason);
}

}  // namespace mrose
