#include "scenario/value_file.h"

#include "io/base64.h"
#include "io/compression.h"
#include "io/toml_table.h"
#include "io/toml_text.h"
#include "scenario/saved_state.h"

namespace mrose {
namespace {

constexpr const char* valueFormat = "mrose scenario value";
constexpr const char* stateFormat = "mrose state";

Expected<ScenarioValue> readValueFile(const Value& content, const std::string& file) {
    TomlTable root = TomlTable::of(content, file);
    root.choice("format", {valueFormat});
    root.integer("version", 1, 1);
    root.string("name");
    const auto value = decoded(root.string("value"));
    root.rejectUnknown();
    if (!value) root.reject("value", "is damaged");
    if (root.failed()) return tl::unexpected(root.error());
    return *value;
}

Expected<ScenarioValue> readStateFile(const Value& content, const std::string& file) {
    const auto saved = readSavedState(content, file);
    if (!saved) return tl::unexpected(saved.error());
    const Value* const kept = content.find("value");
    if (!kept)
        return fail(file, "does not hold the scenario that it is a state of; expected one whose initial_state it is");
    const auto value = kept->asText() ? decoded(*kept->asText()) : std::nullopt;
    if (!value) return fail(file, "is damaged", static_cast<int>(kept->line), "value");
    return value->with("initial_state",
                       std::make_shared<const DescriptionFile>(DescriptionFile{file, file, savedStateText(*saved)}));
}

}  // namespace

std::string encoded(const ScenarioValue& value) { return base64(compressed(value.bytes())); }

std::optional<ScenarioValue> decoded(const std::string& text) {
    const auto packed = fromBase64(text);
    const auto bytes = packed ? decompressed(*packed) : std::nullopt;
    return bytes ? ScenarioValue::parse(*bytes) : std::nullopt;
}

std::string valueFileText(const ScenarioValue& value) {
    const Value* const name = value.at("name");
    return tomlText(Value::Table{{"format", valueFormat},
                                 {"version", 1},
                                 {"name", name && name->asText() ? *name->asText() : std::string()},
                                 {"value", encoded(value)}},
                    "A scenario with all that it is made of: robots, places, networks. mrose run opens it.");
}

Expected<ScenarioValue> scenarioOf(const Value::File& description, const std::string& shown) {
    const Value* const format = description->content.find("format");
    const std::string* const text = format ? format->asText() : nullptr;
    if (text && *text == valueFormat) return readValueFile(description->content, shown);
    if (text && *text == stateFormat) return readStateFile(description->content, shown);
    return ScenarioValue(description);
}

}  // namespace mrose
