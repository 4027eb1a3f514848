#include "scenario/toml_edit.h"

#include <cstdio>
#include <sstream>

#include <toml++/toml.h>

namespace mrose {
namespace {

Expected<toml::table> parsedToml(const std::string& text, const std::string& file) {
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        return tl::unexpected(Error{file, static_cast<int>(error.source().begin.line),
                                    static_cast<int>(error.source().begin.column), "",
                                    "is not TOML: " + std::string(error.description())});
    }
}

/// Where a line begins, counted from 1.
std::size_t lineStart(const std::string& text, toml::source_index line) {
    std::size_t at = 0;
    for (toml::source_index i = 1; i < line && at < text.size(); ++i)
        if (at = text.find('\n', at); at++ == std::string::npos) return text.size();
    return at;
}

/// Columns count characters, of which some have several bytes.
std::size_t offsetOf(const std::string& text, const toml::source_position& position) {
    std::size_t at = lineStart(text, position.line);
    for (toml::source_index column = 1; column < position.column && at < text.size(); ++column) do
            ++at;
        while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80);
    return at;
}

/// A line of its own below another one, with the same kind of end.
void insertBelow(std::string& text, toml::source_index line, const std::string& content) {
    const std::size_t first = text.find('\n');
    const std::string end = first != std::string::npos && first > 0 && text[first - 1] == '\r' ? "\r\n" : "\n";
    const std::size_t at = lineStart(text, line + 1);
    const bool unended = at == text.size() && !text.empty() && text.back() != '\n';
    text.insert(at, (unended ? end : "") + content + end);
}

void insertKey(std::string& text, const toml::table& table, const TomlPlace& place, const std::string& value) {
    const std::string content = place.key + " = " + value;
    if (table.is_inline())
        text.insert(offsetOf(text, table.source().begin) + 1, ' ' + content + ',');
    else if (const toml::node* const above = table.get(place.after))
        insertBelow(text, above->source().end.line, content);
    else
        insertBelow(text, place.table.empty() ? 0 : table.source().begin.line, content);
}

}  // namespace

Expected<std::string> withTomlValue(const std::string& text, const std::string& file, const TomlPlace& place,
                                    const std::string& value) {
    const auto root = parsedToml(text, file);
    if (!root) return tl::unexpected(root.error());
    const toml::table* const table = place.table.empty() ? &*root : toml::at_path(*root, place.table).as_table();
    if (table == nullptr) return fail(file, "has no " + place.table);
    std::string edited = text;
    if (const toml::node* const there = table->get(place.key)) {
        const std::size_t begin = offsetOf(text, there->source().begin), end = offsetOf(text, there->source().end);
        edited.replace(begin, end - begin, value);
    } else {
        insertKey(edited, *table, place, value);
    }
    const auto wanted = parsedToml("value = " + value, file), found = parsedToml(edited, file);
    const toml::table* const now = !found                ? nullptr
                                   : place.table.empty() ? &*found
                                                         : toml::at_path(*found, place.table).as_table();
    const toml::node* const node = now == nullptr ? nullptr : now->get(place.key);
    const auto textOf = [](const toml::node& of) {
        return of.visit([](const auto& shown) {
            std::ostringstream out;
            out << shown;
            return out.str();
        });
    };
    if (!wanted || node == nullptr || textOf(*node) != textOf(*wanted->get("value")))
        return fail(file, place.key + " cannot be written into its text", 0, place.table);
    return edited;
}

Expected<std::string> tomlTableNamed(const std::string& text, const std::string& file,
                                     std::initializer_list<const char*> arrays, const std::string& name) {
    const auto root = parsedToml(text, file);
    if (!root) return tl::unexpected(root.error());
    for (const char* const array : arrays) {
        const toml::array* const tables = root->get_as<toml::array>(array);
        for (std::size_t i = 0; tables != nullptr && i < tables->size(); ++i)
            if (const toml::table* const table = tables->get(i)->as_table())
                if ((*table)["name"].value<std::string>() == name) return array + ('[' + std::to_string(i) + ']');
    }
    return "";
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
