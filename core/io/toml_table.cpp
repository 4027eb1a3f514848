#include "io/toml_table.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "io/nearest_word.h"
#include "io/number_text.h"

namespace mrose {
namespace {

/// How messages tell an element of an array: by its name, where it has one, as conditions do.
std::string elementKey(std::string_view key, const toml::table& element, std::size_t index) {
    const auto name = element["name"].value<std::string>();
    return std::string(key) + '[' + (name && !name->empty() ? '"' + *name + '"' : std::to_string(index + 1)) + ']';
}

}  // namespace

TomlTable::TomlTable(std::string_view text, std::string file) : state_(std::make_shared<State>()) {
    state_->file = std::move(file);
    try {
        state_->root = toml::parse(text);
    } catch (const toml::parse_error& e) {
        const auto where = e.source().begin;
        state_->error =
            Error{state_->file, int(where.line), int(where.column), "", "is not TOML: " + std::string(e.description())};
    }
    table_ = &state_->root;
}

bool TomlTable::has(std::string_view key) {
    known_.emplace_back(key);
    return table_->contains(key);
}

const toml::node* TomlTable::find(std::string_view key) {
    asked_.emplace_back(key);
    known_.emplace_back(key);
    const toml::node* node = table_->get(key);
    if (node || failed()) return node;
    if (rejectMisspelt(key)) return nullptr;
    reject(key, "is missing");
    state_->lacking = table_;
    return nullptr;
}

bool TomlTable::rejectMisspelt(std::string_view key) {
    for (const auto& [other, value] : *table_) {
        if (isAsked(other.str()) || 4 * wordDistance(other.str(), key) > key.size()) continue;
        rejectAt(&value, other.str(), "is not a known key; did you mean " + std::string(key) + '?');
        return true;
    }
    return false;
}

void TomlTable::expectOneOf(std::string_view one, std::string_view other, const std::string& expected) {
    const bool hasOne = has(one), hasOther = has(other);
    if (hasOne != hasOther || (!hasOne && (rejectMisspelt(one) || rejectMisspelt(other)))) return;
    reject(hasOne ? one : other, "expected either " + expected);
}

bool TomlTable::isAsked(std::string_view key) const {
    return std::find(asked_.begin(), asked_.end(), key) != asked_.end();
}

void TomlTable::reject(std::string_view key, std::string cause) { rejectAt(table_->get(key), key, std::move(cause)); }

void TomlTable::rejectElement(std::string_view key, std::size_t index, std::string cause) {
    const toml::node* node = table_->get(key);
    const toml::array* array = node ? node->as_array() : nullptr;
    const toml::node* element = array && index < array->size() ? array->get(index) : node;
    rejectAt(element, std::string(key) + '[' + std::to_string(index + 1) + ']', std::move(cause));
}

void TomlTable::adopt(Error error) {
    if (!failed()) state_->error = std::move(error);
}

void TomlTable::rejectAt(const toml::node* node, std::string_view key, std::string cause) {
    if (failed()) return;
    const auto where = (node ? node : table_)->source().begin;
    state_->error = Error{state_->file, int(where.line), int(where.column), path_ + std::string(key), std::move(cause)};
}

std::optional<double> TomlTable::numberIn(const toml::node& node, std::string_view key, NumberRange range) {
    const auto value = node.value<double>();
    if (value && *value >= range.least && *value <= range.most && std::isfinite(*value)) return value;
    rejectAt(&node, key,
             value && std::isfinite(*value) ? "is " + numberText(*value) + "; expected " + numberText(range.least) +
                                                  " to " + numberText(range.most)
                                            : "expected a finite number");
    return std::nullopt;
}

double TomlTable::number(std::string_view key, NumberRange range) {
    const toml::node* node = find(key);
    return node ? numberIn(*node, key, range).value_or(0) : 0;
}

double TomlTable::numberOr(std::string_view key, double fallback, NumberRange range) {
    return has(key) ? number(key, range) : fallback;
}

std::int64_t TomlTable::integer(std::string_view key, std::int64_t least, std::int64_t most) {
    const toml::node* node = find(key);
    if (!node) return least;
    const auto value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
    if (value && *value >= least && *value <= most) return *value;
    rejectAt(node, key, "expected a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    return least;
}

std::int64_t TomlTable::integerOr(std::string_view key, std::int64_t fallback, std::int64_t least, std::int64_t most) {
    return has(key) ? integer(key, least, most) : fallback;
}

bool TomlTable::boolean(std::string_view key) {
    const toml::node* node = find(key);
    if (!node) return false;
    if (!node->is_boolean()) rejectAt(node, key, "expected true or false");
    return node->value_or(false);
}

bool TomlTable::booleanOr(std::string_view key, bool fallback) { return has(key) ? boolean(key) : fallback; }

std::string TomlTable::string(std::string_view key) {
    const toml::node* node = find(key);
    if (!node) return {};
    if (!node->is_string()) rejectAt(node, key, "expected a text in quotes");
    return node->value_or(std::string());
}

std::string TomlTable::stringOr(std::string_view key, std::string fallback) {
    return has(key) ? string(key) : std::move(fallback);
}

std::size_t TomlTable::choice(std::string_view key, std::span<const std::string_view> choices) {
    const std::string value = string(key);
    const auto found = std::find(choices.begin(), choices.end(), value);
    if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
    std::string expected;
    for (const std::string_view c : choices) expected += (expected.empty() ? "\"" : ", \"") + std::string(c) + '"';
    reject(key, "is \"" + value + "\"; expected one of " + expected);
    return 0;
}

std::vector<std::string> TomlTable::strings(std::string_view key) {
    const toml::node* node = find(key);
    std::vector<std::string> values;
    if (!node) return values;
    if (!node->is_array()) rejectAt(node, key, "expected an array of texts");
    if (const toml::array* array = node->as_array()) {
        for (const toml::node& element : *array) {
            if (!element.is_string()) rejectAt(&element, key, "expected a text in quotes");
            values.push_back(element.value_or(std::string()));
        }
    }
    return values;
}

void TomlTable::appendRow(const toml::node* node, std::string_view key, std::size_t count, NumberRange range,
                          std::vector<double>& out) {
    const toml::array* array = node ? node->as_array() : nullptr;
    if (node && !array) rejectAt(node, key, "expected an array of numbers");
    if (!array) return;
    if (array->size() != count) {
        rejectAt(node, key,
                 "has " + std::to_string(array->size()) + (array->size() == 1 ? " number" : " numbers") +
                     "; expected " + std::to_string(count));
        return;
    }
    for (const toml::node& element : *array) {
        const auto value = numberIn(element, key, range);
        if (!value) return;
        out.push_back(*value);
    }
}

std::vector<double> TomlTable::numbers(std::string_view key, std::size_t count, NumberRange range) {
    std::vector<double> values;
    appendRow(find(key), key, count, range, values);
    values.resize(count);
    return values;
}

std::vector<double> TomlTable::someNumbers(std::string_view key, std::size_t least, std::size_t most,
                                           NumberRange range) {
    std::vector<double> values;
    const toml::node* node = find(key);
    const toml::array* array = node ? node->as_array() : nullptr;
    if (node && (!array || array->size() < least || array->size() > most))
        rejectAt(node, key, "expected " + std::to_string(least) + " to " + std::to_string(most) + " numbers");
    else if (array)
        appendRow(node, key, array->size(), range, values);
    return values;
}

std::vector<double> TomlTable::matrix(std::string_view key, std::size_t rows, std::size_t columns, NumberRange range) {
    std::vector<double> values;
    const toml::node* node = find(key);
    const toml::array* array = node ? node->as_array() : nullptr;
    if (node && (!array || array->size() != rows))
        rejectAt(node, key, "expected " + std::to_string(rows) + " arrays of numbers");
    else if (array)
        for (const toml::node& row : *array) appendRow(&row, key, columns, range, values);
    values.resize(rows * columns);
    return values;
}

std::vector<double> TomlTable::rows(std::string_view key, std::size_t columns, std::size_t least, std::size_t most,
                                    NumberRange range) {
    const toml::node* node = find(key);
    const toml::array* array = node ? node->as_array() : nullptr;
    if (node && (!array || array->size() < least || array->size() > most))
        rejectAt(node, key,
                 (array ? "has " + std::to_string(array->size()) + " elements; " : "") + "expected " +
                     std::to_string(least) + " to " + std::to_string(most) + " arrays of " + std::to_string(columns) +
                     " numbers");
    std::vector<double> values;
    if (!array || failed()) return values;
    for (const toml::node& row : *array) appendRow(&row, key, columns, range, values);
    return failed() ? std::vector<double>() : values;
}

TomlTable TomlTable::table(std::string_view key) {
    static const toml::table empty;
    const toml::node* node = find(key);
    const toml::table* found = node ? node->as_table() : nullptr;
    if (node && !found) rejectAt(node, key, "expected a table");
    return TomlTable(state_, found ? found : &empty, path_ + std::string(key) + '.');
}

TomlTable TomlTable::tableOrEmpty(std::string_view key) {
    static const toml::table empty;
    return has(key) ? table(key) : TomlTable(state_, &empty, path_ + std::string(key) + '.');
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
    std::vector<TomlTable> found;
    const toml::node* node = find(key);
    if (!node) return found;
    const toml::array* array = node->as_array();
    if (!array) rejectAt(node, key, "expected an array of tables");
    for (std::size_t i = 0; array && i < array->size(); ++i) {
        if (const toml::table* element = (*array)[i].as_table())
            found.push_back(TomlTable(state_, element, path_ + elementKey(key, *element, i) + '.'));
        else
            rejectAt(array->get(i), std::string(key) + '[' + std::to_string(i + 1) + ']', "expected a table");
    }
    return found;
}

std::vector<TomlTable> TomlTable::tablesOrNone(std::string_view key) {
    return has(key) ? tables(key) : std::vector<TomlTable>();
}

std::string TomlTable::text() const {
    toml::table root = *table_;
    root.is_inline(false);  // what stood in braces stands in lines
    std::ostringstream text;
    text << root;
    return text.str();
}

std::string TomlTable::meantFor(std::string_view key) const {
    std::vector<std::string_view> candidates;
    for (const std::string& known : known_)
        if (!table_->contains(known)) candidates.push_back(known);
    return std::string(nearestWord(key, candidates));
}

std::string TomlTable::knownKeys() const {
    const std::set<std::string> known(known_.begin(), known_.end());
    std::string all;
    for (const std::string& key : known) all += (all.empty() ? "" : ", ") + key;
    return all;
}

void TomlTable::rejectUnknown() {
    if (failed() && state_->lacking != table_) return;
    for (const auto& [key, node] : *table_) {
        if (isAsked(key.str())) continue;
        const std::string meant = meantFor(key.str());
        // After an error not all keys need to have been asked for.
        if (failed() && meant.empty()) continue;
        state_->error.reset();
        state_->lacking = nullptr;
        std::string cause = "is not a known key";
        if (!meant.empty())
            cause += "; did you mean " + meant + '?';
        else if (!known_.empty())
            cause += "; expected one of " + knownKeys();
        return rejectAt(&node, key.str(), std::move(cause));
    }
}

}  // namespace mrose
