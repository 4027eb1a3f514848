#include "widgets/value_catalogue.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <sstream>
#include <string_view>

#include "condition/condition.h"
#include "io/nearest_word.h"
#include "widgets/command_queue.h"

namespace mrose {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr const char* degreeSign = "\u00b0";

/// What a quantity is read of.
struct Subject {
    const Moment& at;
    std::uint32_t body;
    std::uint32_t other;  ///< the body that `of` names
    const ValueKey& key;

    const RobotState& robot() const { return at.state.robots[body]; }
    const ObjectState& object() const { return at.state.objects[body - at.state.robots.size()]; }
    bool isRobot() const { return body < at.state.robots.size(); }
    const Pose& pose() const { return Scenario::poseOf(at.state, body); }
    Pose otherPose() const {
        return other < at.scene().bodyCount() ? Scenario::poseOf(at.state, other) : Pose{unknown, unknown, unknown};
    }
    const RobotInsight* insight() const {
        return body < at.insights.size() && at.insights[body].tick >= 0 ? &at.insights[body] : nullptr;
    }
};

double degrees(double radians) { return wrapAngle(radians) * 180 / std::numbers::pi; }

Command issuedLast(const Subject& s) { return s.at.scenario.commandsOf(s.at.state, s.body).at(s.at.now()); }
Command inEffect(const Subject& s) { return commandsOnTheWay(commandsOf(s.at.scenario, s.at.state, s.body)).active; }

Pose predictedEnd(const Subject& s) { return s.robot().segment.start * s.robot().segment.increment; }

/// What contact changed in the last tick, in the frame of where the body would have been.
std::optional<Pose> pushedBy(const Subject& s) {
    if (s.body >= s.at.lastTick.size()) return std::nullopt;
    const StepTrace::Robot& told = s.at.lastTick[s.body];
    return told.touched ? relative(told.planned, s.pose()) : Pose{};
}

double impulse(const Subject& s, bool anybody) {
    double sum = 0;
    for (const ContactReport& contact : s.at.contacts) {
        const bool first = contact.bodyA == s.body, second = contact.bodyB == s.body;
        if ((first || second) && (anybody || (first ? contact.bodyB : contact.bodyA) == s.other))
            sum += contact.impulse;
    }
    return sum;
}

std::size_t manipulatorOf(const Subject& s) {
    const std::vector<Manipulator>& all = s.at.scene().typeOf(s.body).manipulators;
    return static_cast<std::size_t>(
        std::find_if(all.begin(), all.end(), [&](const Manipulator& m) { return m.name == s.key.of; }) - all.begin());
}

double readyIn(const Subject& s) {
    const std::size_t which = manipulatorOf(s);
    if (which >= s.at.scene().typeOf(s.body).manipulators.size()) return unknown;
    return toSeconds(std::max<Nanoseconds>(0, s.robot().ready[which] - s.at.now()));
}

double kickDueIn(const Subject& s) {
    for (const PendingKick& kick : s.at.state.kicks)
        if (kick.robot == s.body && kick.manipulator == manipulatorOf(s)) return toSeconds(kick.due - s.at.now());
    return unknown;
}

const Observation* observation(const Subject& s) {
    return s.insight() != nullptr && s.insight()->observed ? &s.insight()->observation : nullptr;
}

const SeenBody* seen(const Subject& s) {
    const Observation* const all = observation(s);
    if (all == nullptr) return nullptr;
    const auto robots = static_cast<std::uint32_t>(s.at.state.robots.size());
    const std::vector<SeenBody>& bodies = s.other < robots ? all->robots : all->objects;
    const std::uint32_t index = s.other < robots ? s.other : s.other - robots;
    const auto found =
        std::find_if(bodies.begin(), bodies.end(), [&](const SeenBody& body) { return body.index == index; });
    return found == bodies.end() ? nullptr : &*found;
}

/// Where the robot takes what it sees to be, by the pose that it measured.
std::optional<Point> seenAt(const Subject& s) {
    const SeenBody* const body = seen(s);
    const Observation* const all = observation(s);
    if (body == nullptr || !all->localised) return std::nullopt;
    return Placement(all->self).place(body->position_B);
}

std::optional<Pose> measuredSelf(const Subject& s) {
    const Observation* const all = observation(s);
    return all != nullptr && all->localised ? std::optional(all->self) : std::nullopt;
}

const Annotation* note(const Subject& s) {
    if (s.insight() == nullptr) return nullptr;
    for (const Annotation& note : s.insight()->decision.annotations)
        if (note.label == s.key.of || noteLabel(note.label).name == s.key.of) return &note;
    return nullptr;
}

double notedPoint(const Subject& s, double Point::*axis) {
    const Annotation* const found = note(s);
    return found != nullptr && !found->points.empty() ? found->points.front().*axis : unknown;
}

double remembered(const Subject& s) {
    for (const MemoryEntry& entry :
         s.at.scenario.controller(s.body).explain(s.at.scenario.memoryOf(s.at.state, s.body)))
        if (entry.name == s.key.of && entry.text.empty())
            return entry.unit == std::string_view("rad") ? degrees(entry.value) : entry.value;
    return unknown;
}

double speedOf(const Subject& s) {
    return s.isRobot() ? std::hypot(s.robot().velocity_B.x, s.robot().velocity_B.y)
                       : std::hypot(s.object().velocity_W.x, s.object().velocity_W.y);
}

double slip(const Subject& s) {
    return length(Point{s.object().velocity_W.x, s.object().velocity_W.y} - s.object().roll_W);
}

double or0(const std::optional<Pose>& pose, double Pose::*part) { return pose ? (*pose).*part : unknown; }

Nanoseconds modelTime(const Subject& s, const Reality::ModelCourse& model) {
    return s.at.now() - s.at.now() % model.step;
}

/// Of the robot that really drove what the body repeats.
const Reality::Robot* realRobot(const Subject& s) {
    return s.at.reality == nullptr ? nullptr : s.at.reality->robotNamed(s.at.scene().robots[s.body].name);
}

std::optional<Pose> realPose(const Subject& s) {
    const Reality::Robot* const robot = realRobot(s);
    return robot == nullptr ? std::nullopt : robot->poseAt(s.at.now());
}

double realVelocity(const Subject& s, double Velocity::*part) {
    const Reality::Robot* const robot = realRobot(s);
    const auto velocity = robot == nullptr ? std::nullopt : robot->velocityAt(s.at.now());
    return velocity ? (*velocity).*part : unknown;
}

/// A real pose and what is held against it: the body's own, or that of the model that `of` names.
struct Compared {
    Pose real, simulated;
};
std::optional<Compared> compared(const Subject& s) {
    const Reality::Robot* const robot = realRobot(s);
    if (robot == nullptr) return std::nullopt;
    std::optional<Pose> simulated = s.pose();
    Nanoseconds now = s.at.now();
    if (!s.key.of.empty()) {
        const std::vector<Reality::ModelCourse>& models = s.at.reality->models;
        const auto model = std::find_if(models.begin(), models.end(),
                                        [&](const Reality::ModelCourse& one) { return one.name == s.key.of; });
        if (model == models.end()) return std::nullopt;
        simulated = model->poseAt(static_cast<std::size_t>(robot - s.at.reality->robots.data()), now);
        now = modelTime(s, *model);
    }
    const std::optional<Pose> real = robot->poseAt(now);
    return real && simulated ? std::optional(Compared{*real, *simulated}) : std::nullopt;
}

/// m, rad; in the real robot's frame
double offReality(const Subject& s, double Pose::*part) {
    const auto both = compared(s);
    return both ? relative(both->real, both->simulated).*part : unknown;
}

double errorOf(const Subject& s, double PoseError::*part) {
    const auto both = compared(s);
    return both ? poseError(both->real, both->simulated).*part : unknown;
}

struct Quantity {
    enum class Whose { robot, object, body };
    const char* name;
    QuantityText text;
    Whose whose;
    double (*read)(const Subject&);
};
using Whose = Quantity::Whose;

constexpr Quantity quantities[] = {
    {"x", {"m", 3}, Whose::body, [](const Subject& s) { return s.pose().x; }},
    {"y", {"m", 3}, Whose::body, [](const Subject& s) { return s.pose().y; }},
    {"heading", {degreeSign, 1}, Whose::body, [](const Subject& s) { return degrees(s.pose().heading); }},
    {"speed", {"m/s", 3}, Whose::body, speedOf},
    {"forward", {"m/s", 3}, Whose::robot, [](const Subject& s) { return s.robot().velocity_B.x; }},
    {"sideways", {"m/s", 3}, Whose::robot, [](const Subject& s) { return s.robot().velocity_B.y; }},
    {"turning", {"rad/s", 3}, Whose::robot, [](const Subject& s) { return s.robot().velocity_B.rotation; }},
    {"direction",
     {degreeSign, 1},
     Whose::object,
     [](const Subject& s) {
         return speedOf(s) > 0 ? degrees(std::atan2(s.object().velocity_W.y, s.object().velocity_W.x)) : unknown;
     }},
    {"spin", {"rad/s", 3}, Whose::object, [](const Subject& s) { return s.object().velocity_W.rotation; }},
    {"slip", {"m/s", 3}, Whose::object, slip},
    {"commanded forward", {"m/s", 3}, Whose::robot, [](const Subject& s) { return issuedLast(s).v; }},
    {"commanded turning", {"rad/s", 3}, Whose::robot, [](const Subject& s) { return issuedLast(s).w; }},
    {"forward in effect", {"m/s", 3}, Whose::robot, [](const Subject& s) { return inEffect(s).v; }},
    {"turning in effect", {"rad/s", 3}, Whose::robot, [](const Subject& s) { return inEffect(s).w; }},
    {"ready in", {"s", 2}, Whose::robot, readyIn},
    {"kick due in", {"s", 2}, Whose::robot, kickDueIn},
    {"predicted x", {"m", 3}, Whose::robot, [](const Subject& s) { return predictedEnd(s).x; }},
    {"predicted y", {"m", 3}, Whose::robot, [](const Subject& s) { return predictedEnd(s).y; }},
    {"predicted heading",
     {degreeSign, 1},
     Whose::robot,
     [](const Subject& s) { return degrees(predictedEnd(s).heading); }},
    {"predicted forward", {"m/s", 3}, Whose::robot, [](const Subject& s) { return s.robot().segment.endVelocity.v; }},
    {"predicted turning", {"rad/s", 3}, Whose::robot, [](const Subject& s) { return s.robot().segment.endVelocity.w; }},
    {"pushed ahead", {"m", 4}, Whose::robot, [](const Subject& s) { return or0(pushedBy(s), &Pose::x); }},
    {"pushed left", {"m", 4}, Whose::robot, [](const Subject& s) { return or0(pushedBy(s), &Pose::y); }},
    {"pushed round",
     {degreeSign, 2},
     Whose::robot,
     [](const Subject& s) { return degrees(or0(pushedBy(s), &Pose::heading)); }},
    {"recovers", {"", 0}, Whose::robot, [](const Subject& s) { return s.robot().pushed ? 1.0 : 0.0; }},
    {"impulse", {"N s", 2}, Whose::body, [](const Subject& s) { return impulse(s, true); }},
    {"impulse from", {"N s", 2}, Whose::body, [](const Subject& s) { return impulse(s, false); }},
    {"distance to",
     {"m", 3},
     Whose::body,
     [](const Subject& s) { return distance(position(s.pose()), position(s.otherPose())); }},
    {"bearing of",
     {degreeSign, 1},
     Whose::body,
     [](const Subject& s) {
         const Point way = Placement(s.pose()).placeBack(position(s.otherPose()));
         return degrees(std::atan2(way.y, way.x));
     }},
    {"sees x of", {"m", 3}, Whose::robot, [](const Subject& s) { return seenAt(s) ? seenAt(s)->x : unknown; }},
    {"sees y of", {"m", 3}, Whose::robot, [](const Subject& s) { return seenAt(s) ? seenAt(s)->y : unknown; }},
    {"error in seeing",
     {"m", 3},
     Whose::robot,
     [](const Subject& s) { return seenAt(s) ? distance(*seenAt(s), position(s.otherPose())) : unknown; }},
    {"age of sight of",
     {"s", 3},
     Whose::robot,
     [](const Subject& s) { return seen(s) != nullptr ? toSeconds(s.at.now() - seen(s)->measured) : unknown; }},
    {"measured x", {"m", 3}, Whose::robot, [](const Subject& s) { return or0(measuredSelf(s), &Pose::x); }},
    {"measured y", {"m", 3}, Whose::robot, [](const Subject& s) { return or0(measuredSelf(s), &Pose::y); }},
    {"measured heading",
     {degreeSign, 1},
     Whose::robot,
     [](const Subject& s) { return degrees(or0(measuredSelf(s), &Pose::heading)); }},
    {"error of own place",
     {"m", 3},
     Whose::robot,
     [](const Subject& s) {
         return measuredSelf(s) ? distance(position(*measuredSelf(s)), position(s.pose())) : unknown;
     }},
    {"error of own heading",
     {degreeSign, 1},
     Whose::robot,
     [](const Subject& s) { return degrees(or0(measuredSelf(s), &Pose::heading) - s.pose().heading); }},
    {"age of own pose",
     {"s", 3},
     Whose::robot,
     [](const Subject& s) { return measuredSelf(s) ? toSeconds(s.at.now() - observation(s)->selfMeasured) : unknown; }},
    {"odometry forward",
     {"m/s", 3},
     Whose::robot,
     [](const Subject& s) { return observation(s) != nullptr ? observation(s)->velocity.v : unknown; }},
    {"odometry turning",
     {"rad/s", 3},
     Whose::robot,
     [](const Subject& s) { return observation(s) != nullptr ? observation(s)->velocity.w : unknown; }},
    {"note",
     {"", 3},
     Whose::robot,
     [](const Subject& s) {
         const Annotation* const found = note(s);
         return found != nullptr && found->kind == Annotation::Kind::value ? found->value : unknown;
     }},
    {"x of note", {"m", 3}, Whose::robot, [](const Subject& s) { return notedPoint(s, &Point::x); }},
    {"y of note", {"m", 3}, Whose::robot, [](const Subject& s) { return notedPoint(s, &Point::y); }},
    {"remembers", {"", 3}, Whose::robot, remembered},
    {"real x", {"m", 3}, Whose::robot, [](const Subject& s) { return or0(realPose(s), &Pose::x); }},
    {"real y", {"m", 3}, Whose::robot, [](const Subject& s) { return or0(realPose(s), &Pose::y); }},
    {"real heading",
     {degreeSign, 1},
     Whose::robot,
     [](const Subject& s) { return degrees(or0(realPose(s), &Pose::heading)); }},
    {"real forward", {"m/s", 3}, Whose::robot, [](const Subject& s) { return realVelocity(s, &Velocity::v); }},
    {"real turning", {"rad/s", 3}, Whose::robot, [](const Subject& s) { return realVelocity(s, &Velocity::w); }},
    {positionErrorQuantity,
     {"cm", 1},
     Whose::robot,
     [](const Subject& s) { return 100 * errorOf(s, &PoseError::position); }},
    {headingErrorQuantity,
     {degreeSign, 1},
     Whose::robot,
     [](const Subject& s) { return degrees(errorOf(s, &PoseError::heading)); }},
    {"error ahead", {"cm", 1}, Whose::robot, [](const Subject& s) { return 100 * offReality(s, &Pose::x); }},
    {"error to the left", {"cm", 1}, Whose::robot, [](const Subject& s) { return 100 * offReality(s, &Pose::y); }},
};

const Quantity* quantityNamed(const std::string& name) {
    const auto* const found = std::find_if(std::begin(quantities), std::end(quantities),
                                           [&](const Quantity& quantity) { return quantity.name == name; });
    return found == std::end(quantities) ? nullptr : found;
}

/// How far two names are from one another, of words in any order: each word of one against the nearest of the other.
std::size_t wordsApart(const std::string& written, const std::string& name) {
    const auto wordsOf = [](const std::string& text) {
        std::istringstream stream(text);
        return std::vector<std::string>(std::istream_iterator<std::string>(stream), {});
    };
    const std::vector<std::string> known = wordsOf(name);
    std::size_t sum = 0;
    for (const std::string& word : wordsOf(written)) {
        std::size_t least = word.size();
        for (const std::string& other : known) least = std::min(least, wordDistance(word, other));
        sum += least;
    }
    return 2 * sum + known.size();
}

bool fits(Whose whose, const Scene& scene, std::uint32_t body) {
    if (body >= scene.bodyCount()) return false;
    return whose == Whose::body || (whose == Whose::robot) == (body < scene.robots.size());
}

}  // namespace

Moment momentOf(const FieldFrame& frame) {
    return {*frame.scenario, frame.state, frame.lastTick, frame.contacts, frame.insights, nullptr, frame.reality.get()};
}

std::uint32_t bodyNamed(const Scene& scene, const std::string& name) {
    for (std::size_t i = 0; i < scene.bodyCount(); ++i)
        if ((i < scene.robots.size() ? scene.robots[i].name : scene.objects[i - scene.robots.size()].name) == name)
            return static_cast<std::uint32_t>(i);
    return noBody;
}

namespace {

Expected<PlottedValue> expressionValue(const Scenario& scenario, const ValueKey& key) {
    // Which log that is, if any, each moment says anew.
    auto reality = std::make_shared<const Reality*>(nullptr);
    const RealPoses real = [reality](const std::string& robot, Nanoseconds now) -> std::optional<Pose> {
        const Reality::Robot* const there = *reality != nullptr ? (*reality)->robotNamed(robot) : nullptr;
        return there != nullptr ? there->poseAt(now) : std::nullopt;
    };
    auto compiled = compileWorldValue(key.of, scenario, "expression", real);
    if (!compiled) return tl::unexpected(compiled.error());
    PlottedValue value;
    value.name = QString::fromStdString(key.of);
    value.unit = QString::fromStdString(key.unit);
    value.read = [reality, expression = std::make_shared<WorldValue>(std::move(*compiled))](const Moment& at) {
        *reality = at.reality;
        return expression->value(at.scenario, at.state, at.trace).value_or(unknown);
    };
    return value;
}

}  // namespace

namespace {

/// Bodies, or else the quantities of that body, the nearest to what was written first.
std::string namesThereAre(const Scene& scene, const ValueKey& key) {
    const std::uint32_t body = bodyNamed(scene, key.body);
    std::vector<std::string> names;
    if (body != noBody)
        for (const Quantity& quantity : quantities) {
            if (fits(quantity.whose, scene, body)) names.emplace_back(quantity.name);
        }
    else
        for (std::size_t i = 0; i < scene.bodyCount(); ++i)
            names.push_back(i < scene.robots.size() ? scene.robots[i].name
                                                    : scene.objects[i - scene.robots.size()].name);
    const std::string& written = body != noBody ? key.quantity : key.body;
    std::vector<std::pair<std::size_t, std::string>> ranked;
    for (const std::string& name : names) ranked.emplace_back(wordsApart(written, name), name);
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::string text = body != noBody ? "of " + key.body + " there are " : "there are ";
    const std::size_t listed = std::min<std::size_t>(ranked.size(), 12);
    for (std::size_t i = 0; i < listed; ++i) text += (i > 0 ? ", " : "") + ranked[i].second;
    if (listed < ranked.size()) text += " ...";
    return text;
}

}  // namespace

Expected<PlottedValue> plottedValue(const Scenario& scenario, const ValueKey& key) {
    if (key.quantity == expressionQuantity) return expressionValue(scenario, key);
    const Scene& scene = scenario.scene();
    const Quantity* const quantity = quantityNamed(key.quantity);
    const std::uint32_t body = bodyNamed(scene, key.body);
    if (quantity == nullptr || !fits(quantity->whose, scene, body))
        return fail({}, "there is no " + key.quantity + " of " + key.body + "; " + namesThereAre(scene, key));
    PlottedValue value;
    const QString of = QString::fromStdString(key.of), what = QObject::tr(quantity->name);
    value.name = QString::fromStdString(key.body) + "  ";
    if (readsReality(key) && !key.of.empty())
        value.name += of + ": " + what;  // the model first: it is what differs
    else
        value.name += key.of.empty() ? what : what + ' ' + of;
    const char* const unit = key.unit.empty() ? quantity->text.unit : key.unit.c_str();
    value.angle = unit == std::string_view("rad") || unit == std::string_view(degreeSign);
    value.unit = QString::fromUtf8(value.angle ? degreeSign : unit);
    value.decimals = quantity->text.decimals;
    if (body < scene.robots.size()) value.colourOf = static_cast<std::uint32_t>(scene.placeOf(body));
    value.read = [key, body, read = quantity->read, other = bodyNamed(scene, key.of)](const Moment& at) {
        return read({at, body, other, key});
    };
    return value;
}

double readValue(const Moment& moment, const ValueKey& key, std::uint32_t body) {
    const Quantity* const quantity = quantityNamed(key.quantity);
    if (quantity == nullptr || !fits(quantity->whose, moment.scene(), body)) return unknown;
    const std::uint32_t other = key.of.empty() ? noBody : bodyNamed(moment.scene(), key.of);
    return quantity->read({moment, body, other, key});
}

NoteLabel noteLabel(const std::string& label) {
    const std::size_t unit = label.rfind(" (");
    if (unit == std::string::npos || unit == 0 || !label.ends_with(')')) return {label, {}};
    return {label.substr(0, unit), label.substr(unit + 2, label.size() - unit - 3)};
}

bool readsReality(const ValueKey& key) {
    return key.quantity.starts_with("real ") || key.quantity == positionErrorQuantity ||
           key.quantity == headingErrorQuantity || key.quantity == "error ahead" || key.quantity == "error to the left";
}

const QuantityText* quantityText(const std::string& quantity) {
    const Quantity* const found = quantityNamed(quantity);
    return found == nullptr ? nullptr : &found->text;
}

QString fixedText(double value, int decimals) {
    if (!std::isfinite(value)) return QString::fromUtf8("\u2013");
    const double rounding = 0.5 * std::pow(10, -decimals);
    return QString::number(std::abs(value) < rounding ? 0.0 : value, 'f', decimals);
}

}  // namespace mrose
