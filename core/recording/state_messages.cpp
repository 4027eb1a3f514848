#include "recording/state_messages.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/elementary.h"
#include "recording/json_text.h"

namespace mrose {
namespace {

void appendField(std::string& json, const char* key, double value, int decimals = 3) {
    json += key;
    appendFixed(json, value, decimals);
}

void appendTransform(std::string& json, const Pose& pose, const std::string& frame, const std::string& stamp) {
    json += R"({"timestamp":)";
    json += stamp;
    json += R"(,"parent_frame_id":"world","child_frame_id":)";
    appendQuoted(json, frame);
    appendField(json, R"(,"translation":{"x":)", pose.x);
    appendField(json, ",\"y\":", pose.y);
    // Half the heading, kept within half a turn so that the numbers stay small.
    const double half = std::remainder(pose.heading, 4 * std::numbers::pi) / 2;
    appendField(json, R"(,"z":0},"rotation":{"x":0,"y":0,"z":)", sine(half));
    appendField(json, ",\"w\":", cosine(half));
    json += "}}";
}

std::string stampOf(Nanoseconds time) {
    std::string stamp;
    appendTime(stamp, time);
    return stamp;
}

std::string nameOf(const Scenario& scenario, std::uint32_t body, std::uint32_t obstacle,
                   std::span<const std::string> names) {
    if (body < names.size()) return names[body];
    const ObstacleIndex& index = scenario.obstacles();
    if (obstacle >= index.pieces().size()) return "obstacle";
    const std::string& name = scenario.scene().environment.obstacles[index.obstacleOf(obstacle)].name;
    return name.empty() ? "obstacle" : name;
}

/// The rest of a contact's mark, in one of three sizes: what repeats takes no room in a file.
std::string markEnd(double impulse) {
    constexpr double hard = 5, firm = 1;  // N s
    const std::string size = impulse >= hard ? "0.18" : impulse >= firm ? "0.11" : "0.06";
    return R"(,"z":0.2},"orientation":{"x":0,"y":0,"z":0,"w":1}},"size":{"x":)" + size + ",\"y\":" + size +
           ",\"z\":" + size + R"(},"color":{"r":1,"g":0.25,"b":0.1,"a":0.8}})";
}

enum class Level { information = 2, warning = 3 };

std::string logMessage(Level level, const std::string& text, const std::string& name, const std::string& stamp) {
    std::string json =
        "{\"timestamp\":" + stamp + ",\"level\":" + std::to_string(static_cast<int>(level)) + ",\"message\":";
    appendQuoted(json, text);
    json += ",\"name\":";
    appendQuoted(json, name);
    return json + R"(,"file":"","line":0})";
}

std::string kickText(const Scenario& scenario, const StepTrace::Kicked& kick, std::span<const std::string> names) {
    const Manipulator& manipulator = scenario.scene().typeOf(kick.robot).manipulators[kick.manipulator];
    std::string text = names[kick.robot] + " kicks";
    if (!manipulator.name.empty()) text += " with " + manipulator.name;
    if (!kick.hit) return text + " and hits nothing";
    text += ": " + names[scenario.scene().robots.size() + kick.object] + " leaves with ";
    appendFixed(text, length(kick.speed_W), 2);
    return text + " m/s";
}

/// From whom to whom, what and when, without the end.
void appendRadioMessage(std::string& json, const SentMessage& message, const std::string& to, Nanoseconds sent,
                        std::span<const std::string> names) {
    constexpr std::string_view digits = "0123456789abcdef";
    json += json.back() == '[' ? "{\"from\":" : ",{\"from\":";
    appendQuoted(json, names[message.from]);
    json += ",\"to\":";
    appendQuoted(json, to);
    json += ",\"kind\":" + std::to_string(message.kind) + ",\"size\":" + std::to_string(message.size) + ",\"bytes\":\"";
    for (std::size_t i = 0; i < message.size; ++i) {
        json += digits[std::to_integer<std::size_t>(message.bytes[i] >> 4)];
        json += digits[std::to_integer<std::size_t>(message.bytes[i] & std::byte{15})];
    }
    json += '"';
    appendField(json, ",\"sent_s\":", toSeconds(sent));
}

const char* outcomeText(Transmission::Outcome outcome) {
    switch (outcome) {
        case Transmission::Outcome::received:
            return "received";
        case Transmission::Outcome::lost:
            return "lost";
        case Transmission::Outcome::outOfRange:
            return "out of range";
    }
    return "";
}

}  // namespace

const std::vector<const Quantity*>& sampledQuantities(bool robot) {
    static const auto sampled = [](Quantity::Of kind) {
        std::vector<const Quantity*> some;
        for (const Quantity& quantity : quantities())
            if (quantity.sampled && (quantity.of == Quantity::Of::body || quantity.of == kind))
                some.push_back(&quantity);
        return some;
    };
    static const auto ofRobots = sampled(Quantity::Of::robot), ofObjects = sampled(Quantity::Of::object);
    return robot ? ofRobots : ofObjects;
}

std::string transformsMessage(const WorldState& state, std::span<const std::string> frames, Nanoseconds time) {
    const std::string stamp = stampOf(time);
    std::string json = "{\"transforms\":[";
    for (std::size_t body = 0; body < state.robots.size() + state.objects.size(); ++body) {
        if (body > 0) json += ',';
        appendTransform(json, Scenario::poseOf(state, body), frames[body], stamp);
    }
    return json + "]}";
}

std::vector<SummedContact> summedContacts(std::vector<ContactReport> reports) {
    const auto key = [](const auto& c) { return std::tuple(c.bodyA, c.bodyB, c.obstacle); };
    std::stable_sort(reports.begin(), reports.end(),
                     [&](const ContactReport& a, const ContactReport& b) { return key(a) < key(b); });
    std::vector<SummedContact> sums;
    for (const ContactReport& report : reports) {
        if (sums.empty() || key(sums.back()) != key(report))
            sums.push_back({report.bodyA, report.bodyB, report.obstacle, report.position, 0, 0});
        SummedContact& sum = sums.back();
        sum.impulse += report.impulse;
        if (report.impulse <= sum.hardest) continue;
        sum.hardest = report.impulse;
        sum.position = report.position;
    }
    return sums;
}

std::string bodiesMessage(const Scenario& scenario, const WorldState& state, std::span<const SummedContact> contacts,
                          std::span<const std::string> names) {
    std::vector<double> pressed(names.size());
    for (const SummedContact& contact : contacts)
        for (const std::uint32_t body : {contact.bodyA, contact.bodyB})
            if (body < pressed.size()) pressed[body] += contact.impulse;
    const Moment at{&scenario, &state};
    std::string json;
    for (std::uint32_t body = 0; body < names.size(); ++body) {
        json += body == 0 ? '{' : ',';
        appendQuoted(json, names[body]);
        json += ":{";
        for (const Quantity* quantity : sampledQuantities(body < state.robots.size())) {
            appendQuoted(json, quantity->name);
            json += ':';
            appendFixed(json, numberOf(quantity->value({at, body})), 3);
            json += ',';
        }
        appendField(json, "\"pressed\":", pressed[body], 1);
        json += '}';
    }
    return json.empty() ? "{}" : json + '}';
}

std::string contactsMessage(const Scenario& scenario, std::span<const SummedContact> contacts,
                            std::span<const std::string> names, Nanoseconds time) {
    std::string metadata, spheres;
    for (const SummedContact& contact : contacts) {
        const char* const comma = metadata.empty() ? "" : ",";
        std::string impulse;
        appendFixed(impulse, contact.impulse, 1);
        metadata += comma;
        metadata += "{\"key\":";
        appendQuoted(metadata, nameOf(scenario, contact.bodyA, contact.obstacle, names) + " - " +
                                   nameOf(scenario, contact.bodyB, contact.obstacle, names));
        metadata += ",\"value\":\"" + impulse + "\"}";
        spheres += comma;
        appendField(spheres, R"({"pose":{"position":{"x":)", contact.position.x, 2);
        appendField(spheres, ",\"y\":", contact.position.y, 2);
        spheres += markEnd(contact.impulse);
    }
    return R"({"deletions":[],"entities":[{"timestamp":)" + stampOf(time) +
           R"(,"frame_id":"world","id":"contacts","lifetime":{"sec":0,"nsec":0},"frame_locked":true,"metadata":[)" +
           metadata + R"(],"arrows":[],"cubes":[],"spheres":[)" + spheres +
           R"(],"cylinders":[],"lines":[],"triangles":[],"texts":[],"models":[]}]})";
}

std::string radioMessage(const Scene& scene, const WorldState& after, const StepTrace& trace,
                         std::span<const std::string> names) {
    const std::int64_t tick = after.tick - 1;
    const bool sent = !after.messages.empty() && after.messages.back().tick == tick;
    if (!sent && trace.transmissions.empty()) return {};
    const Nanoseconds now = scene.timeOf(tick);
    std::string json = "{\"timestamp\":" + stampOf(scene.timeOf(after.tick)) + ",\"sent\":[";
    for (const SentMessage& message : after.messages) {
        if (message.tick != tick) continue;
        appendRadioMessage(json, message, message.to == noBody ? "all" : names[message.to], now, names);
        json += '}';
    }
    json += "],\"due\":[";
    const std::size_t listed = std::min(trace.transmissions.size(), mostTransmissions);
    for (const Transmission& one : std::span(trace.transmissions).first(listed)) {
        const SentMessage& message = trace.messages[one.message];
        const Nanoseconds then = scene.timeOf(message.tick);
        appendRadioMessage(json, message, names[one.to], then, names);
        json += ",\"outcome\":\"";
        json += outcomeText(one.outcome);
        appendField(json, "\",\"arrival_ms\":", toSeconds(one.arrival - then) * 1e3, 1);
        appendField(json, ",\"late_ms\":", toSeconds(now - then) * 1e3, 1);
        json += '}';
    }
    return json + "],\"left_out\":" + std::to_string(trace.transmissions.size() - listed) + '}';
}

std::vector<std::string> logMessages(const Scenario& scenario, const StepTrace& trace,
                                     std::span<const std::string> names, Nanoseconds time) {
    std::vector<std::string> messages;
    const std::string stamp = stampOf(time);
    for (const StepTrace::Kicked& kick : trace.kicks)
        messages.push_back(logMessage(Level::information, kickText(scenario, kick, names), names[kick.robot], stamp));
    for (const std::uint32_t goal : trace.goals) {
        const std::string& name = scenario.scene().environment.goals[goal].name;
        messages.push_back(logMessage(Level::information, "goal in " + (name.empty() ? std::to_string(goal + 1) : name),
                                      "world", stamp));
    }
    for (const StepTrace::Fault& fault : trace.faults)
        messages.push_back(logMessage(Level::warning, fault.what, names[fault.robot], stamp));
    for (std::size_t i = 0; i < trace.robots.size(); ++i)
        if (trace.robots[i].decided && !trace.robots[i].decision.breakReason.empty())
            messages.push_back(
                logMessage(Level::information, "stops here: " + trace.robots[i].decision.breakReason, names[i], stamp));
    return messages;
}

}  // namespace mrose
