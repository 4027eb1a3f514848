#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

#include "world/world_state.h"

namespace mrose {

// What a world's state is made of, field by field, listed once: hashes, bytes and comparisons all walk over it. A field
// that is not listed here does not compile (the assertions at the end).

/// `each(visit)` calls visit(name, pointer to member) for every field, in a fixed order.
template <class T>
struct Fields;

template <>
struct Fields<RobotState> {
    template <class Visit>
    static constexpr void each(Visit&& visit) {
        visit("pose", &RobotState::pose);
        visit("velocity_B", &RobotState::velocity_B);
        visit("lastControl", &RobotState::lastControl);
        visit("nextControl", &RobotState::nextControl);
        visit("segment", &RobotState::segment);
        visit("pushed", &RobotState::pushed);
        visit("commandCount", &RobotState::commandCount);
        visit("commandBefore", &RobotState::commandBefore);
        visit("ready", &RobotState::ready);
    }
};

template <>
struct Fields<Pose> {
    template <class Visit>
    static constexpr void each(Visit&& visit) {
        visit("x", &Pose::x);
        visit("y", &Pose::y);
        visit("heading", &Pose::heading);
    }
};

template <>
struct Fields<Twist> {
    template <class Visit>
    static constexpr void each(Visit&& visit) {
        visit("x", &Twist::x);
        visit("y", &Twist::y);
        visit("rotation", &Twist::rotation);
    }
};

template <>
struct Fields<Point> {
    template <class Visit>
    static constexpr void each(Visit&& visit) {
        visit("x", &Point::x);
        visit("y", &Point::y);
    }
};

template <>
struct Fields<Velocity> {
    template <class Visit>
    static constexpr void each(Visit&& visit) {
        visit("v", &Velocity::v);
        visit("w", &Velocity::w);
    }
};

template <>
struct Fields<Command> {
    template <class Visit>
    static constexpr void each(Visit&& visit) {
        visit("v", &Command::v);
        visit("w", &Command::w);
    }
};

template <>
struct Fields<StampedCommand> {
    template <class Visit>
    static constexpr void each(Visit&& visit) {
        visit("time", &StampedCommand::time);
        visit("command", &StampedCommand::command);
    }
};

template <>
struct Fields<MotionSegment> {
    template <class Visit>
    static constexpr void each(Visit&& visit) {
        visit("startTick", &MotionSegment::startTick);
        visit("start", &MotionSegment::start);
        visit("direction", &MotionSegment::direction);
        visit("increment", &MotionSegment::increment);
        visit("logarithm", &MotionSegment::logarithm);
        visit("startRate", &MotionSegment::startRate);
        visit("endRate", &MotionSegment::endRate);
        visit("endVelocity", &MotionSegment::endVelocity);
    }
};

template <>
struct Fields<ObjectState> {
    template <class Visit>
    static constexpr void each(Visit&& visit) {
        visit("pose", &ObjectState::pose);
        visit("velocity_W", &ObjectState::velocity_W);
        visit("roll_W", &ObjectState::roll_W);
    }
};

template <>
struct Fields<ContactImpulse> {
    template <class Visit>
    static constexpr void each(Visit&& visit) {
        visit("bodyA", &ContactImpulse::bodyA);
        visit("pieceA", &ContactImpulse::pieceA);
        visit("bodyB", &ContactImpulse::bodyB);
        visit("pieceB", &ContactImpulse::pieceB);
        visit("feature", &ContactImpulse::feature);
        visit("normal", &ContactImpulse::normal);
        visit("tangent", &ContactImpulse::tangent);
    }
};

template <>
struct Fields<PendingKick> {
    template <class Visit>
    static constexpr void each(Visit&& visit) {
        visit("due", &PendingKick::due);
        visit("robot", &PendingKick::robot);
        visit("manipulator", &PendingKick::manipulator);
        visit("power", &PendingKick::power);
    }
};

template <>
struct Fields<SentMessage> {
    template <class Visit>
    static constexpr void each(Visit&& visit) {
        visit("tick", &SentMessage::tick);
        visit("number", &SentMessage::number);
        visit("from", &SentMessage::from);
        visit("to", &SentMessage::to);
        visit("kind", &SentMessage::kind);
        visit("size", &SentMessage::size);
        visit("position", &SentMessage::position);
        visit("latency", &SentMessage::latency);
        visit("jitter", &SentMessage::jitter);
        visit("bytes", &SentMessage::bytes);
    }
};

template <>
struct Fields<RobotTouch> {
    template <class Visit>
    static constexpr void each(Visit&& visit) {
        visit("tick", &RobotTouch::tick);
        visit("robot", &RobotTouch::robot);
        visit("other", &RobotTouch::other);
        visit("place_B", &RobotTouch::place_B);
    }
};

template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t n>
struct IsArray<std::array<T, n>> : std::true_type {};

template <class Owner, class Member>
Member memberOf(Member Owner::*);

/// Bytes of all numbers of a T, without padding.
template <class T>
constexpr std::size_t packedSize() {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
        return sizeof(T);
    } else if constexpr (IsArray<T>::value) {
        return std::tuple_size_v<T> * packedSize<typename T::value_type>();
    } else {
        std::size_t size = 0;
        Fields<T>::each([&](const char*, auto member) { size += packedSize<decltype(memberOf(member))>(); });
        return size;
    }
}

/// Calls leaf(number) for every number of `value`; a T may be const.
template <class T, class Leaf>
void visitNumbers(T& value, Leaf&& leaf) {
    using Value = std::remove_const_t<T>;
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>) {
        leaf(value);
    } else if constexpr (IsArray<Value>::value) {
        for (auto& element : value) visitNumbers(element, leaf);
    } else {
        Fields<Value>::each([&](const char*, auto member) { visitNumbers(value.*member, leaf); });
    }
}

/// Writes all numbers of `value` one after the other; returns where they end.
template <class T>
char* pack(const T& value, char* out) {
    visitNumbers(value, [&](const auto& number) {
        std::memcpy(out, &number, sizeof number);
        out += sizeof number;
    });
    return out;
}

/// A T without padding whose numbers lie in memory as pack() writes them: many of them can be taken as they are.
template <class T>
constexpr bool packed = std::is_trivially_copyable_v<T>&& packedSize<T>() == sizeof(T);

static_assert(packed<ObjectState> && packed<ContactImpulse> && packed<PendingKick> && packed<SentMessage> &&
              packed<StampedCommand> && packed<Pose> && packed<RobotTouch> && packed<std::int32_t> &&
              packed<MotionSegment>);
// This one has padding: 3 bytes after `pushed`.
static_assert(packedSize<RobotState>() + 3 == sizeof(RobotState));

}  // namespace mrose
