#include "scenario/scenario_value.h"

#include "io/toml_text.h"
#include "io/value_bytes.h"

namespace mrose {
namespace {

/// The same without places in a text.
Value withoutPlaces(const Value& value) {
    Value without = value;
    if (const Value::Array* const array = value.asArray()) {
        Value::Array elements;
        for (const Value& element : *array) elements.push_back(withoutPlaces(element));
        without = Value(std::move(elements));
    } else if (const Value::Table* const table = value.asTable()) {
        Value::Table entries;
        for (const auto& [key, entry] : *table) entries.emplace(key, withoutPlaces(entry));
        without = Value(std::move(entries));
    }
    without.line = without.column = 0;
    return without;
}

}  // namespace

ScenarioValue::ScenarioValue(std::string name, Value content)
    : file_(std::make_shared<const DescriptionFile>(DescriptionFile{std::move(name), {}, std::move(content)})) {}

Expected<ScenarioValue> ScenarioValue::with(std::string_view path, Value value) const {
    auto changed = content().with(path, std::move(value));
    if (!changed) {
        changed.error().file = name();
        return tl::unexpected(changed.error());
    }
    return ScenarioValue(name(), std::move(*changed));
}

ScenarioValue ScenarioValue::without(std::string_view path) const { return {name(), content().without(path)}; }

Expected<ScenarioValue> ScenarioValue::overridden(std::string_view assignment) const {
    auto parsed = parseOverride(assignment);
    if (!parsed) return tl::unexpected(parsed.error());
    return with(parsed->path, std::move(parsed->value));
}

Expected<ScenarioOverride> parseOverride(std::string_view assignment) {
    const std::size_t equals = assignment.find('=');
    const std::string_view before = assignment.substr(0, equals);
    std::string path(before.substr(0, before.find_last_not_of(' ') + 1));
    if (equals == std::string_view::npos || path.empty())
        return fail(std::string(assignment), "expected PATH=VALUE, such as robot[2].network=create.net or seed=4");
    const std::string text(assignment.substr(equals + 1));
    auto parsed = parseToml("value = " + text, "");
    const Value* const value = parsed ? parsed->find("value") : nullptr;
    return ScenarioOverride{std::move(path), value ? withoutPlaces(*value) : Value(text)};
}

std::string ScenarioValue::bodyPath(std::string_view name) const {
    for (const char* const kind : {"robot", "person", "object"}) {
        const Value* const bodies = content().find(kind);
        const Value::Array* const all = bodies ? bodies->asArray() : nullptr;
        for (std::size_t i = 0; all && i < all->size(); ++i) {
            const Value* const called = (*all)[i].find("name");
            if (called && called->asText() && *called->asText() == name)
                return std::string(kind) + '[' + std::to_string(i + 1) + ']';
        }
    }
    return {};
}

std::vector<Value::File> ScenarioValue::files() const { return filesOf(file_); }

std::string ScenarioValue::bytes(std::span<const Value::File> known) const { return valueBytes(file_, known); }

std::optional<ScenarioValue> ScenarioValue::parse(std::string_view bytes, std::span<const Value::File> known) {
    const auto value = parseValue(bytes, known);
    if (!value || !value->asFile() || !value->asFile()->content.asTable()) return {};
    return ScenarioValue(value->sharedFile());
}

std::uint64_t ScenarioValue::hash() const { return hashOf(content()); }

}  // namespace mrose
