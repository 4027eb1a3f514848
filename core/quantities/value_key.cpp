#include "quantities/value_key.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <regex>
#include <utility>

#include "quantities/part.h"

namespace mrose {
namespace {

using Of = Quantity::Of;

/// Bodies, or else the quantities of that body.
std::string namesThereAre(const Scenario& scenario, const ValueKey& key) {
    const Scene& scene = scenario.scene();
    const std::uint32_t body = bodyNamed(scene, key.body);
    std::vector<std::string> names;
    for (std::uint32_t i = 0; body == noBody && i < scene.bodyCount(); ++i) names.push_back(nameOfBody(scene, i));
    if (body == noBody) return "there are " + nearestNames(key.body, names);
    names = quantityNames(scenario, body);
    for (const Quantity& quantity : quantities())
        if (quantity.isPair() && !key.of.empty()) names.emplace_back(quantity.name);
    return "of " + key.body + " there are " + nearestNames(key.quantity, names);
}

/// Whether the key has the form of such a quantity, and what it names is there.
bool bind(const Scene& scene, const ValueKey& key, BoundValue& value) {
    const Quantity& quantity = *value.quantity;
    const std::vector<Goal>& goals = scene.environment.goals;
    const auto goal = std::find_if(goals.begin(), goals.end(), [&](const Goal& one) { return one.name == key.body; });
    switch (quantity.of) {
        case Of::run:
            return key.body.empty() && key.of.empty();
        case Of::goal:
            value.body = static_cast<std::uint32_t>(goal - goals.begin());
            return goal != goals.end() && key.of.empty();
        case Of::items:
            value.item = key.of;
            return hasQuantity(scene, value.body, quantity) && !key.of.empty();
        case Of::body:
        case Of::robot:
        case Of::object:
            return hasQuantity(scene, value.body, quantity) && key.of.empty();
        default:
            value.other = bodyNamed(scene, key.of);
            const bool there = value.other != noBody || (quantity.of == Of::touchingPair && key.of == wallName);
            return there && value.body < (quantity.of == Of::seenPair ? scene.robots.size() : scene.bodyCount());
    }
}

std::optional<BoundValue> boundTo(const Scenario& scenario, const ValueKey& key) {
    const Scene& scene = scenario.scene();
    for (const Quantity& quantity : quantities()) {
        BoundValue value{&quantity, bodyNamed(scene, key.body), noBody, {}, key.unit};
        if (quantity.name == key.quantity && bind(scene, key, value)) return value;
    }
    BoundValue value{&partQuantity(), bodyNamed(scene, key.body), noBody, {}, key.unit};
    if (value.body >= scene.bodyCount()) return {};
    const std::vector<std::string> parts = partNames(scenario, value.body);
    const auto part = std::find(parts.begin(), parts.end(), key.quantity);
    if (part == parts.end() || !bind(scene, key, value)) return {};
    value.other = static_cast<std::uint32_t>(part - parts.begin());
    return value;
}

std::string quoted(const std::string& name) {
    std::string text = "[\"";
    for (const char c : name) text += c == '"' || c == '\\' ? std::string{'\\', c} : std::string(1, c);
    return text + "\"]";
}

std::string bodyPath(const Scene& scene, std::uint32_t body) {
    if (body == noBody) return wallName;
    const std::string name = quoted(nameOfBody(scene, body));
    if (body >= scene.robots.size()) return "object" + name;
    return (scene.typeOf(body).person ? "person" : "robot") + name;
}

/// A body by its number in such a list, from 1; noBody: there is none.
std::uint32_t bodyNumbered(const Scene& scene, const std::string& list, const std::string& digits) {
    std::size_t number = 0, persons = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const std::size_t robots = scene.robots.size();
    if (list == "object" && number >= 1 && number <= scene.objects.size())
        return static_cast<std::uint32_t>(robots + number - 1);
    for (std::uint32_t i = 0; i < robots && list != "object"; ++i) {
        const bool person = scene.typeOf(i).person;
        persons += person ? 1 : 0;
        if (person == (list == "person") && number == (person ? persons : scene.placeOf(i) + 1)) return i;
    }
    return noBody;
}

std::uint32_t ballOf(const Scene& scene) {
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
        if (scene.typeOfObject(i).rolls) return static_cast<std::uint32_t>(scene.robots.size()) + i;
    return noBody;
}

}  // namespace

QuantityValue BoundValue::value(const Moment& at) const {
    if (quantity->needs == Quantity::Needs::real && at.real == nullptr) return std::nan("");
    return quantity->value({at, body, other, item});
}

std::string BoundValue::shownUnit() const {
    return isAngle() ? degreeSign : !ownUnit.empty() ? ownUnit : quantity->unit.shown();
}

double BoundValue::shown(double number) const { return isAngle() ? inDegrees(number) : quantity->unit.inShown(number); }

Expected<BoundValue> boundValue(const Scenario& scenario, const ValueKey& key) {
    auto value = boundTo(scenario, key);
    if (!value)
        return fail({}, "there is no " + key.quantity + " of " + key.body + "; " + namesThereAre(scenario, key));
    return *std::move(value);
}

ValueKey keyOf(const Scenario& scenario, const BoundValue& value) {
    const Quantity& quantity = *value.quantity;
    const Scene& scene = scenario.scene();
    if (quantity.of == Of::run) return {quantity.name};
    if (quantity.of == Of::goal) return {quantity.name, scene.environment.goals[value.body].name};
    const bool part = &quantity == &partQuantity();
    const std::string name = part ? partNames(scenario, value.body)[value.other] : quantity.name;
    const std::string of = !quantity.isPair()      ? value.item
                           : value.other == noBody ? wallName
                                                   : nameOfBody(scene, value.other);
    return {name, nameOfBody(scene, value.body), of, value.ownUnit};
}

std::string pathOf(const Scenario& scenario, const BoundValue& value) {
    const Quantity& quantity = *value.quantity;
    const ValueKey key = keyOf(scenario, value);
    if (quantity.of == Of::run) return key.quantity;
    if (quantity.of == Of::goal) return key.quantity + quoted(key.body);
    const std::string body = bodyPath(scenario.scene(), value.body);
    if (quantity.isPair()) return key.quantity + '(' + body + ", " + bodyPath(scenario.scene(), value.other) + ')';
    return body + '.' + key.quantity + (key.of.empty() ? "" : quoted(key.of));
}

Expected<std::string> entryUnit(const Scenario& scenario, const BoundValue& value) {
    const WorldState start = scenario.initialState();
    const Moment moment{&scenario, &start};
    const std::vector<MemoryEntry> known = knownEntries(moment, value.body, value.other);
    std::vector<std::string> names;
    for (const auto& entries : {known, partEntries(moment, value.body, value.other)})
        for (const MemoryEntry& entry : entries) {
            if (entry.name == value.item) return entry.unit;
            names.push_back(entry.name);
        }
    if (known.empty()) return std::string();
    return fail({}, "there is no " + value.item + " of " + partNames(scenario, value.body)[value.other] + "; it has " +
                        nearestNames(value.item, names));
}

std::optional<ValueKey> keyOfPath(const Scenario& scenario, const std::string& path) {
    static const std::regex form(
        R"re(\s*(?:(robot|person|object)\[(?:"([^"\\]*)"|'([^'\\]*)'|(\d{1,9}))\]|(ball))\.(\w+)(?:\.(\w+)|\["([^"\\]*)"\])?\s*)re");
    enum Group { list = 1, doubleQuoted, singleQuoted, digits, ball, quantity, plainItem, quotedItem };
    std::smatch found;
    if (!std::regex_match(path, found, form)) return {};
    const auto text = [&](Group group) { return found[group].str(); };
    const Scene& scene = scenario.scene();
    ValueKey key{text(quantity), text(doubleQuoted) + text(singleQuoted), text(plainItem) + text(quotedItem)};
    if (key.body.empty()) {
        const std::uint32_t body = found[ball].matched ? ballOf(scene) : bodyNumbered(scene, text(list), text(digits));
        if (body == noBody) return {};
        key.body = nameOfBody(scene, body);
    }
    const std::optional<BoundValue> value = boundTo(scenario, key);
    if (!value) return {};
    if (value->quantity == &partQuantity()) key.unit = entryUnit(scenario, *value).value_or("");
    return key;
}

}  // namespace mrose
