#include "support/values_at.h"

#include "quantities/part.h"

namespace mrose {
namespace {

using Of = Quantity::Of;

/// The values of a body, and of it with the others.
void addValuesOf(const Moment& moment, std::uint32_t body, std::vector<ValueKey>& keys) {
    const Scene& scene = moment.scene();
    const std::string& name = nameOfBody(scene, body);
    const auto addItems = [&](const Quantity& quantity, const std::string& of, std::uint32_t part) {
        for (const Quantity::Item& item : quantity.items({moment, body, part})) keys.push_back({of, name, item.name});
    };
    for (const Quantity& quantity : quantities()) {
        const bool known = quantity.needs != Quantity::Needs::real || moment.real != nullptr;
        if (known && hasQuantity(scene, body, quantity)) {
            if (quantity.of == Of::items)
                addItems(quantity, quantity.name, noBody);
            else
                keys.push_back({quantity.name, name});
        }
        if (!quantity.isPair() || (quantity.of == Of::seenPair && body >= scene.robots.size())) continue;
        for (std::uint32_t other = 0; other < scene.bodyCount(); ++other)
            keys.push_back({quantity.name, name, nameOfBody(scene, other)});
        if (quantity.of == Of::touchingPair) keys.push_back({quantity.name, name, wallName});
    }
    const std::vector<std::string> parts = partNames(*moment.scenario, body);
    for (std::uint32_t part = 0; part < parts.size(); ++part) addItems(partQuantity(), parts[part], part);
}

}  // namespace

std::vector<ValueKey> valuesAt(const Moment& moment) {
    std::vector<ValueKey> keys;
    for (const Quantity& quantity : quantities()) {
        if (quantity.of == Of::run) keys.push_back({quantity.name});
        if (quantity.of == Of::goal)
            for (const Goal& goal : moment.scene().environment.goals) keys.push_back({quantity.name, goal.name});
    }
    for (std::uint32_t body = 0; body < moment.scene().bodyCount(); ++body) addValuesOf(moment, body, keys);
    return keys;
}

}  // namespace mrose
