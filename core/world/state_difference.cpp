#include "world/state_difference.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>

#include "io/format.h"
#include "world/state_fields.h"

namespace mrose {
namespace {

using Part = StateDifference::Part;

template <class Number>
std::string textOf(const Number& value) {
    if constexpr (std::is_same_v<Number, double>) {
        if (!std::isnan(value)) return numberText(value);
        char text[24];
        std::snprintf(text, sizeof text, "nan:%016llx",
                      static_cast<unsigned long long>(std::bit_cast<std::uint64_t>(value)));
        return text;
    } else if constexpr (std::is_same_v<Number, float>) {
        return std::isnan(value) ? textOf(static_cast<double>(value)) : numberText(value);
    } else if constexpr (std::is_same_v<Number, bool>) {
        return value ? "true" : "false";
    } else {
        return std::to_string(static_cast<long long>(value));
    }
}

/// The names on the way to the first number in which two values differ, and both as text.
template <class T>
bool differs(const T& a, const T& b, const std::string& path, StateDifference& out) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
        using Bytes = std::array<std::byte, sizeof(T)>;
        if (std::bit_cast<Bytes>(a) == std::bit_cast<Bytes>(b)) return false;
        out.field = path;
        out.first = textOf(a);
        out.second = textOf(b);
        return true;
    } else if constexpr (IsArray<T>::value) {
        for (std::size_t i = 0; i < a.size(); ++i)
            if (differs(a[i], b[i], path + ' ' + std::to_string(i + 1), out)) return true;
        return false;
    } else {
        bool found = false;
        Fields<T>::each([&](const char* name, auto member) {
            found = found || differs(a.*member, b.*member, path.empty() ? name : path + '.' + name, out);
        });
        return found;
    }
}

class Comparison {
public:
    template <class T>
    void field(const char* name, const T& a, const T& b) {
        if (!found_ && differs(a, b, name, difference_)) found_ = true;
    }
    template <class T>
    void elements(Part part, const char* name, const std::vector<T>& a, const std::vector<T>& b) {
        const std::size_t common = std::min(a.size(), b.size());
        for (std::size_t i = 0; i < common && !found_; ++i)
            if (StateDifference d{part, i}; differs(a[i], b[i], "", d)) found(d);
        if (!found_ && a.size() != b.size()) found({Part::state, 0, name, textOf(a.size()), textOf(b.size())});
    }
    void bytes(Part part, const char* name, const std::vector<std::byte>& a, const std::vector<std::byte>& b) {
        if (found_) return;
        if (a.size() != b.size()) return found({Part::state, 0, name, textOf(a.size()), textOf(b.size())});
        const auto [inA, inB] = std::mismatch(a.begin(), a.end(), b.begin());
        if (inA != a.end())
            found({part, static_cast<std::size_t>(inA - a.begin()), "", textOf(static_cast<int>(*inA)),
                   textOf(static_cast<int>(*inB))});
    }
    std::optional<StateDifference> result() const { return found_ ? std::optional(difference_) : std::nullopt; }

private:
    void found(StateDifference difference) {
        difference_ = std::move(difference);
        found_ = true;
    }

    StateDifference difference_;
    bool found_ = false;
};

}  // namespace

std::optional<StateDifference> firstDifference(const WorldState& a, const WorldState& b, StateScope scope) {
    Comparison compare;
    compare.field("tick", a.tick, b.tick);
    compare.field("seed", a.seed, b.seed);
    compare.elements(Part::robot, "robots", a.robots, b.robots);
    compare.elements(Part::object, "objects", a.objects, b.objects);
    compare.elements(Part::contact, "contacts", a.contacts, b.contacts);
    compare.elements(Part::kick, "kicks", a.kicks, b.kicks);
    compare.elements(Part::message, "messages", a.messages, b.messages);
    compare.elements(Part::goal, "goals", a.goals, b.goals);
    compare.elements(Part::command, "commands", a.commands, b.commands);
    compare.bytes(Part::motion, "bytes of motion models", a.motion, b.motion);
    if (scope == StateScope::world) return compare.result();
    compare.bytes(Part::memory, "bytes of controllers", a.memory, b.memory);
    compare.bytes(Part::sensing, "bytes of sensors", a.sensing, b.sensing);
    compare.elements(Part::past, "past poses", a.past, b.past);
    compare.elements(Part::touch, "touches", a.touches, b.touches);
    return compare.result();
}

bool StateDifference::ofBytes() const { return part == Part::motion || part == Part::memory || part == Part::sensing; }

bool StateDifference::ofMemories() const {
    return part == Part::memory || part == Part::sensing || part == Part::past || part == Part::touch ||
           (part == Part::state && (field == "bytes of controllers" || field == "bytes of sensors" ||
                                    field == "past poses" || field == "touches"));
}

std::string StateDifference::message() const {
    static constexpr std::array names{"",
                                      "robot ",
                                      "object ",
                                      "contact ",
                                      "kick ",
                                      "message ",
                                      "goal ",
                                      "command ",
                                      "motion models' memory, byte ",
                                      "controllers' memory, byte ",
                                      "sensors' memory, byte ",
                                      "past pose "};
    std::string where = names[static_cast<std::size_t>(part)];
    if (part != Part::state) where += std::to_string(index + (ofBytes() ? 0 : 1));
    if (part != Part::state && !field.empty()) where += ' ';
    return where + field + ": " + first + " against " + second;
}

}  // namespace mrose
