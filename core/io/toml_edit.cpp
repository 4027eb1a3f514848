#include "io/toml_edit.h"

#include <algorithm>
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

std::string lineEnd(const std::string& text) {
    const std::size_t first = text.find('\n');
    return first != std::string::npos && first > 0 && text[first - 1] == '\r' ? "\r\n" : "\n";
}

/// One piece of a text to be replaced by another.
struct Patch {
    std::size_t begin = 0, end = 0;
    std::string by;
};

Patch newKey(const std::string& text, const toml::table& table, const TomlEdit& edit) {
    const std::string content = edit.place.key + " = " + edit.value;
    if (table.is_inline()) {
        const std::size_t at = offsetOf(text, table.source().begin) + 1;
        return {at, at, ' ' + content + ','};
    }
    const toml::node* const above = table.get(edit.place.after);
    const toml::source_index line = above != nullptr           ? above->source().end.line
                                    : edit.place.table.empty() ? 0
                                                               : table.source().begin.line;
    const std::size_t at = lineStart(text, line + 1);
    const bool unended = at == text.size() && !text.empty() && text.back() != '\n';
    return {at, at, (unended ? lineEnd(text) : "") + content + lineEnd(text)};
}

const toml::table* tableAt(const toml::table& root, const std::string& path) {
    return path.empty() ? &root : toml::at_path(root, path).as_table();
}

std::string shownToml(const toml::node& node) {
    std::ostringstream out;
    node.visit([&](const auto& shown) { out << shown; });
    return out.str();
}

/// The lines at which tables begin that are no part of `left`.
void addTableLines(const toml::table& table, const toml::table* left, std::vector<toml::source_index>& lines) {
    if (&table == left) return;
    const auto add = [&](const toml::table& inner) {
        if (&inner != left && !inner.is_inline() && inner.source().begin.line > 0)
            lines.push_back(inner.source().begin.line);
        addTableLines(inner, left, lines);
    };
    for (const auto& [key, node] : table) {
        if (const toml::table* const inner = node.as_table()) add(*inner);
        if (const toml::array* const array = node.as_array())
            for (const toml::node& element : *array)
                if (const toml::table* const inner = element.as_table()) add(*inner);
    }
}

/// The tables that a path such as "robot[].controller" names.
std::vector<std::string> tablesAt(const toml::table& root, const std::string& path) {
    const std::size_t each = path.find("[]");
    if (each == std::string::npos) return {path};
    const toml::array* const array = toml::at_path(root, path.substr(0, each)).as_array();
    std::vector<std::string> all;
    for (std::size_t i = 0; array != nullptr && i < array->size(); ++i)
        all.push_back(path.substr(0, each + 1) + std::to_string(i) + path.substr(each + 1));
    return all;
}

}  // namespace

Expected<std::string> withTomlValues(const std::string& text, const std::string& file,
                                     std::span<const TomlEdit> edits) {
    const auto root = parsedToml(text, file);
    if (!root) return tl::unexpected(root.error());
    std::vector<Patch> patches;
    for (const TomlEdit& edit : edits) {
        const toml::table* const table = tableAt(*root, edit.place.table);
        if (table == nullptr) return fail(file, "has no " + edit.place.table);
        if (const toml::node* const there = table->get(edit.place.key))
            patches.push_back({offsetOf(text, there->source().begin), offsetOf(text, there->source().end), edit.value});
        else
            patches.push_back(newKey(text, *table, edit));
    }
    std::stable_sort(patches.begin(), patches.end(), [](const Patch& a, const Patch& b) { return a.begin > b.begin; });
    std::string edited = text;
    for (const Patch& patch : patches) edited.replace(patch.begin, patch.end - patch.begin, patch.by);
    const auto found = parsedToml(edited, file);
    for (const TomlEdit& edit : edits) {
        const auto wanted = parsedToml("value = " + edit.value, file);
        const toml::table* const table = found ? tableAt(*found, edit.place.table) : nullptr;
        const toml::node* const node = table != nullptr ? table->get(edit.place.key) : nullptr;
        if (!wanted || node == nullptr || shownToml(*node) != shownToml(*wanted->get("value")))
            return fail(file, edit.place.key + " cannot be written into its text", 0, edit.place.table);
    }
    return edited;
}

Expected<std::string> withoutTomlTable(const std::string& text, const std::string& file, const std::string& path) {
    const auto root = parsedToml(text, file);
    if (!root) return tl::unexpected(root.error());
    const toml::table* const table = tableAt(*root, path);
    const std::string array = path.substr(0, path.find('['));
    if (table == nullptr || table == &*root) return fail(file, "has no " + path);
    const auto count = [&](const toml::table& in) {
        const toml::array* const tables = in.get_as<toml::array>(array);
        return tables != nullptr ? tables->size() : 0;
    };
    std::vector<toml::source_index> lines;
    addTableLines(*root, table, lines);
    const std::size_t begin = lineStart(text, table->source().begin.line);
    std::size_t end = text.size();
    for (const toml::source_index line : lines)
        if (const std::size_t at = lineStart(text, line); at > begin) end = std::min(end, at);
    std::string edited = text;
    edited.erase(begin, end - begin);
    const auto found = parsedToml(edited, file);
    if (table->is_inline() || !found || count(*found) + 1 != count(*root))
        return fail(file, "cannot be left out of its text; expected a table under [[" + array + "]]", 0, path);
    return edited;
}

Expected<std::vector<TomlString>> tomlStrings(const std::string& text, const std::string& file, std::string_view path) {
    const auto root = parsedToml(text, file);
    if (!root) return tl::unexpected(root.error());
    const std::size_t dot = path.rfind('.');
    const bool inTable = dot != std::string_view::npos;
    const std::string key(inTable ? path.substr(dot + 1) : path);
    std::vector<TomlString> strings;
    for (const std::string& place : tablesAt(*root, std::string(inTable ? path.substr(0, dot) : "")))
        if (const toml::table* const table = tableAt(*root, place))
            if (const auto value = (*table)[key].value<std::string>()) strings.push_back({{place, key}, *value});
    return strings;
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
