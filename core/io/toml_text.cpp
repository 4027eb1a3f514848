#include "io/toml_text.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <vector>

#include <toml++/toml.h>

#include "io/format.h"

namespace mrose {
namespace {

/// Dates and times become nothing: no key holds one.
Value valueOf(const toml::node& node) {
    Value value;
    if (const toml::table* const table = node.as_table()) {
        Value::Table copy;
        for (const auto& [key, element] : *table) copy.emplace(key.str(), valueOf(element));
        value = std::move(copy);
    } else if (const toml::array* const array = node.as_array()) {
        Value::Array copy;
        copy.reserve(array->size());
        for (const toml::node& element : *array) copy.push_back(valueOf(element));
        value = std::move(copy);
    } else if (const auto* const text = node.as_string()) {
        value = text->get();
    } else if (const auto* const truth = node.as_boolean()) {
        value = truth->get();
    } else if (const auto* const integer = node.as_integer()) {
        value = integer->get();
    } else if (const auto* const real = node.as_floating_point()) {
        value = real->get();
    }
    value.line = node.source().begin.line;
    value.column = node.source().begin.column;
    return value;
}

bool holdsTables(const Value& value) {
    const Value::Array* const array = value.asArray();
    return array && !array->empty() &&
           std::all_of(array->begin(), array->end(), [](const Value& element) { return element.asTable(); });
}

/// A table that is written within one line.
bool isPlain(const Value& table) {
    return std::none_of(table.asTable()->begin(), table.asTable()->end(),
                        [](const auto& entry) { return entry.second.asTable() || holdsTables(entry.second); });
}

std::string keyText(std::string_view key) {
    const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
    return bare ? std::string(key) : tomlString(key);
}

/// Of a table's keys those first by which a reader knows it.
std::vector<const Value::Table::value_type*> inReadingOrder(const Value::Table& table) {
    constexpr std::array first{"format", "version", "kind", "name", "type", "x_m", "y_m"};
    const auto rank = [&](const Value::Table::value_type* entry) {
        return std::find(first.begin(), first.end(), entry->first) - first.begin();
    };
    std::vector<const Value::Table::value_type*> order;
    for (const auto& entry : table) order.push_back(&entry);
    std::stable_sort(order.begin(), order.end(), [&](auto* a, auto* b) { return rank(a) < rank(b); });
    return order;
}

std::string inlineText(const Value& value) {
    if (const bool* const truth = value.asBoolean()) return *truth ? "true" : "false";
    if (const std::int64_t* const integer = value.asInteger()) return std::to_string(*integer);
    if (const double* const real = value.asFloat()) return numberText(*real);
    if (const std::string* const text = value.asText()) return tomlString(*text);
    if (const DescriptionFile* const file = value.asFile()) return tomlString(file->reference);
    std::string all;
    if (const Value::Array* const array = value.asArray()) {
        for (const Value& element : *array) all += (all.empty() ? "" : ", ") + inlineText(element);
        return '[' + all + ']';
    }
    for (const Value::Table::value_type* const entry : inReadingOrder(*value.asTable()))
        all += (all.empty() ? " " : ", ") + keyText(entry->first) + " = " + inlineText(entry->second);
    return '{' + all + " }";
}

/// The lines of a table under its header; `path` is "" for the text itself. Tables in tables of arrays are written
/// within a line where they can be.
void appendTable(const Value::Table& table, const std::string& path, bool inArray, std::string& text) {
    const auto order = inReadingOrder(table);
    const auto within = [&](const Value& value) {
        return !holdsTables(value) && (!value.asTable() || (inArray && isPlain(value)));
    };
    for (const auto* const entry : order)
        if (within(entry->second)) text += keyText(entry->first) + " = " + inlineText(entry->second) + '\n';
    for (const auto* const entry : order) {
        if (within(entry->second)) continue;
        const std::string header = (path.empty() ? "" : path + '.') + keyText(entry->first);
        if (const Value::Table* const inner = entry->second.asTable()) {
            text += "\n[" + header + "]\n";
            appendTable(*inner, header, inArray, text);
            continue;
        }
        for (const Value& element : *entry->second.asArray()) {
            text += "\n[[" + header + "]]\n";
            appendTable(*element.asTable(), header, true, text);
        }
    }
}

}  // namespace

Expected<Value> parseToml(std::string_view text, const std::string& file) {
    try {
        return valueOf(toml::parse(text));
    } catch (const toml::parse_error& error) {
        return tl::unexpected(Error{file, static_cast<int>(error.source().begin.line),
                                    static_cast<int>(error.source().begin.column), "",
                                    "is not TOML: " + std::string(error.description())});
    }
}

std::string tomlText(const Value& table, std::string_view comment) {
    std::string text;
    while (!comment.empty()) {
        const std::size_t end = std::min(comment.find('\n'), comment.size());
        text += "# " + std::string(comment.substr(0, end)) + '\n';
        comment.remove_prefix(std::min(end + 1, comment.size()));
    }
    if (const Value::Table* const content = table.asTable()) appendTable(*content, "", false, text);
    return text;
}

std::string tomlString(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            char escaped[8];
            std::snprintf(escaped, sizeof escaped, "\\u%04X", static_cast<unsigned>(c));
            quoted += escaped;
        } else {
            quoted += c;
        }
    }
    return quoted + '"';
}

}  // namespace mrose
