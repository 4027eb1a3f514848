#include "debug/breakpoint.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "condition/condition.h"
#include "io/nearest_word.h"

namespace mrose {
namespace {

using MarkKind = TimelineMark::Kind;

constexpr std::array<std::pair<std::string_view, BreakKind>, 6> words{{{"contact", BreakKind::contact},
                                                                       {"kick", BreakKind::kick},
                                                                       {"goal", BreakKind::goal},
                                                                       {"fault", BreakKind::fault},
                                                                       {"breakHere()", BreakKind::breakHere},
                                                                       {"divergence", BreakKind::divergence}}};
constexpr std::string_view space = " \t\r\n";

std::string_view trimmed(std::string_view text) {
    const auto begin = text.find_first_not_of(space);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(space) + 1 - begin);
}

/// All that a kind may be asked of, by their numbers.
std::vector<std::string> namesOf(BreakKind kind, const Scene& scene) {
    std::vector<std::string> names;
    if (kind == BreakKind::goal) {
        for (const Goal& goal : scene.environment.goals) names.push_back(goal.name);
        return names;
    }
    for (const auto& robot : scene.robots) names.push_back(robot.name);
    if (kind == BreakKind::contact)
        for (const auto& object : scene.objects) names.push_back(object.name);
    return names;
}

std::string bodyName(std::uint32_t body, const Scene& scene) {
    if (body < scene.robots.size()) return scene.robots[body].name;
    return body < scene.bodyCount() ? scene.objects[body - scene.robots.size()].name : "the place";
}

MarkKind markOf(BreakKind kind) {
    switch (kind) {
        case BreakKind::kick:
            return MarkKind::kick;
        case BreakKind::goal:
            return MarkKind::goal;
        case BreakKind::fault:
            return MarkKind::fault;
        case BreakKind::breakHere:
            return MarkKind::stop;
        default:
            return MarkKind::contact;
    }
}

Expected<void> checkIn(const Scenario& scenario, std::string_view text, const RealityPointer& reality) {
    const BreakText what = readBreakText(text);
    if (what.kind == BreakKind::condition) {
        auto condition = compileCondition(what.name, scenario, "condition", reality.get());
        if (condition) return {};
        // In the text as it is written.
        if (condition.error().line == 1 && condition.error().column > 0)
            condition.error().column += static_cast<int>(text.find_first_not_of(space));
        return tl::unexpected(condition.error());
    }
    if (what.name.empty()) return {};
    if (what.kind == BreakKind::divergence) return fail("", "\"divergence\" takes no name");
    const std::vector<std::string> names = namesOf(what.kind, scenario.scene());
    std::string all;
    for (const std::string& name : names) {
        if (name == what.name) return {};
        all += (all.empty() ? "" : ", ") + name;
    }
    const std::string one = what.kind == BreakKind::goal ? "goal" : what.kind == BreakKind::contact ? "body" : "robot";
    const std::string_view meant = nearestWord(what.name, {names.begin(), names.end()});
    return fail("", "there is no " + one + " '" + std::string(what.name) + '\'' +
                        (!meant.empty() ? "; did you mean " + std::string(meant) + '?'
                         : !all.empty() ? "; expected one of " + all
                                        : ""));
}

}  // namespace

bool Breakpoint::operator==(const Breakpoint& other) const {
    return id == other.id && text == other.text && enabled == other.enabled && oneShot == other.oneShot &&
           from == other.from && error == other.error;
}

BreakText readBreakText(std::string_view text) {
    text = trimmed(text);
    const std::string_view word = text.substr(0, text.find_first_of(space));
    for (const auto& [name, kind] : words)
        if (word == name) return {kind, trimmed(text.substr(word.size()))};
    return {BreakKind::condition, text};
}

bool isSameTruth(const RealityPointer& a, const RealityPointer& b) {
    if (a == nullptr || b == nullptr) return a == b;
    return a->log == b->log && std::equal(a->robots.begin(), a->robots.end(), b->robots.begin(), b->robots.end(),
                                          [](const Reality::Robot& x, const Reality::Robot& y) {
                                              return x.name == y.name && x.trajectory == y.trajectory &&
                                                     x.origin == y.origin;
                                          });
}

Expected<void> checkBreakHere(std::string_view text, const BranchSetup& setup, const RealityPointer& reality) {
    return checkIn(*setup.scenario, text, reality);
}

Expected<void> checkBreakText(std::string_view text, const BranchSetup& setup, const RealityPointer& reality) {
    auto here = checkBreakHere(text, setup, reality);
    if (here || reality == nullptr || reality->allRobots == nullptr) return here;
    return checkIn(*reality->allRobots, text, reality);
}

bool isMeant(const BreakText& text, const TimelineMark& mark, const BranchSetup& setup) {
    if (text.kind == BreakKind::condition || text.kind == BreakKind::divergence || mark.kind != markOf(text.kind))
        return false;
    if (text.name.empty()) return true;
    const std::vector<Goal>& goals = setup.scene().environment.goals;
    if (text.kind == BreakKind::goal) return mark.other < goals.size() && goals[mark.other].name == text.name;
    const Scene& scene = setup.scene();
    return bodyName(mark.body, scene) == text.name ||
           (text.kind == BreakKind::contact && bodyName(mark.other, scene) == text.name);
}

std::string textOf(const TimelineMark& mark, const BranchSetup& setup) {
    const Scene& scene = setup.scene();
    const std::string body = bodyName(mark.body, scene);
    switch (mark.kind) {
        case MarkKind::contact:
            return body + " touches " + bodyName(mark.other, scene);
        case MarkKind::kick:
            return body + (mark.other == noBody ? " kicks and misses" : " kicks " + bodyName(mark.other, scene));
        case MarkKind::goal:
            return mark.other < scene.environment.goals.size()
                       ? "a ball is in the " + scene.environment.goals[mark.other].name + " goal"
                       : "a goal";
        case MarkKind::fault:
            return "the controller of " + body + " fails";
        default:
            return body + " calls breakHere()";
    }
}

}  // namespace mrose
