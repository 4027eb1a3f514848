#include "quantities/catalogue.h"

#include <algorithm>
#include <cassert>

#include "io/nearest_word.h"
#include "quantities/part.h"
#include "quantities/quantity_tables.h"

namespace mrose {
namespace {

std::vector<Quantity> allQuantities() {
    std::vector<Quantity> all;
    addMotionQuantities(all);
    addControlQuantities(all);
    addRealQuantities(all);
    return all;
}

std::vector<Quantity::Item> entriesOf(const Subject& s) {
    std::vector<Quantity::Item> items;
    for (const MemoryEntry& entry : partEntries(s.at, s.body, s.other)) items.push_back({entry.name, entry.unit});
    return items;
}

QuantityValue readEntry(const Subject& s) {
    MemoryEntries wanted(s.item);
    addPartEntries(s.at, s.body, s.other, wanted);
    if (wanted.all().empty()) return unknownNumber;
    const MemoryEntry& entry = wanted.all().front();
    return entry.text.empty() ? QuantityValue(entry.value) : QuantityValue(entry.text);
}

std::vector<std::string> wordsOf(std::string_view text) {
    std::vector<std::string> words(1);
    for (const char c : text)
        if (c == ' ' || c == '_')
            words.emplace_back();
        else
            words.back() += c;
    return words;
}

/// How far two names are from one another, of words in any order: each word of one against the nearest of the other.
std::size_t wordsApart(std::string_view written, std::string_view name) {
    const std::vector<std::string> known = wordsOf(name);
    std::size_t sum = 0;
    for (const std::string& word : wordsOf(written)) {
        std::size_t least = word.size();
        for (const std::string& other : known) least = std::min(least, wordDistance(word, other));
        sum += least;
    }
    return 2 * sum + known.size();
}

}  // namespace

std::span<const Quantity> quantities() {
    static const std::vector<Quantity> all = allQuantities();
    return all;
}

const Quantity& quantityNamed(std::string_view name, Quantity::Of of) {
    const auto all = quantities();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Quantity& one) { return one.name == name && one.of == of; });
    assert(found != all.end());
    return *found;
}

const Quantity& partQuantity() {
    static const Quantity quantity{"",
                                   {},
                                   "what a part of the body remembers or reports",
                                   Quantity::Of::items,
                                   readEntry,
                                   false,
                                   entriesOf,
                                   true,
                                   "",
                                   Quantity::Needs::control};
    return quantity;
}

bool hasQuantity(const Scene& scene, std::uint32_t body, const Quantity& quantity) {
    if (body >= scene.bodyCount() || !quantity.isOfBody()) return false;
    if (quantity.of == Quantity::Of::body || &quantity == &partQuantity()) return true;
    const bool robot = body < scene.robots.size();
    if (robot && quantity.needs == Quantity::Needs::real && scene.typeOf(body).person) return false;
    return robot == (quantity.of != Quantity::Of::object);
}

std::vector<std::string> quantityNames(const Scenario& scenario, std::uint32_t body) {
    std::vector<std::string> names;
    for (const Quantity& quantity : quantities())
        if (hasQuantity(scenario.scene(), body, quantity)) names.emplace_back(quantity.name);
    if (body >= scenario.scene().bodyCount()) return names;
    for (const std::string& part : partNames(scenario, body)) names.push_back(part);
    return names;
}

std::string nearestNames(std::string_view written, std::vector<std::string> names) {
    constexpr std::size_t most = 12;
    std::stable_sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
        return wordsApart(written, a) < wordsApart(written, b);
    });
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), most); ++i) text += (i > 0 ? ", " : "") + names[i];
    return names.size() > most ? text + " ..." : text;
}

std::uint32_t bodyNamed(const Scene& scene, std::string_view name) {
    for (std::uint32_t i = 0; i < scene.bodyCount(); ++i)
        if (nameOfBody(scene, i) == name) return i;
    return noBody;
}

const std::string& nameOfBody(const Scene& scene, std::uint32_t body) {
    return body < scene.robots.size() ? scene.robots[body].name : scene.objects[body - scene.robots.size()].name;
}

}  // namespace mrose
