#include "io/toml_table.h"

#include <algorithm>
#include <cmath>

#include "io/format.h"
#include "io/nearest_word.h"
#include "io/toml_text.h"

namespace mrose {
namespace {

const Value emptyTable = Value::Table();

/// How messages name an element of an array: by its name, where it has one, as conditions do.
std::string elementKey(std::string_view key, const Value& element, std::size_t index) {
    const Value* const name = element.find("name");
    const std::string* const text = name ? name->asText() : nullptr;
    return std::string(key) + '[' + (text && !text->empty() ? '"' + *text + '"' : std::to_string(index + 1)) + ']';
}

/// Whole numbers are real ones, too, as far as these hold them exactly.
std::optional<double> numberOf(const Value& value) {
    constexpr std::int64_t most = std::int64_t{1} << 53;
    if (const double* const real = value.asFloat()) return *real;
    const std::int64_t* const integer = value.asInteger();
    if (!integer || *integer > most || *integer < -most) return {};
    return static_cast<double>(*integer);
}

/// The value at a place of a file, with those of `putIn`, which has their places, instead of what it holds there.
Value withPutIn(const Value& value, const std::string& place, const std::map<std::string, Value>& putIn) {
    const auto next = putIn.lower_bound(place);
    if (next == putIn.end() || !next->first.starts_with(place)) return value;
    if (next->first == place) return next->second;
    Value changed;
    if (const Value::Table* const table = value.asTable()) {
        Value::Table copy;
        for (const auto& [key, element] : *table)
            copy.emplace(key, withPutIn(element, place + (place.empty() ? "" : ".") + key, putIn));
        changed = std::move(copy);
    } else if (const Value::Array* const array = value.asArray()) {
        Value::Array copy;
        for (std::size_t i = 0; i < array->size(); ++i)
            copy.push_back(withPutIn((*array)[i], place + '[' + std::to_string(i + 1) + ']', putIn));
        changed = std::move(copy);
    } else {
        return value;
    }
    changed.line = value.line;
    changed.column = value.column;
    return changed;
}

/// Each once, in the order of the alphabet.
std::string listed(const std::vector<std::string>& keys) {
    std::string all;
    for (const std::string& key : std::set(keys.begin(), keys.end())) all += (all.empty() ? "" : ", ") + key;
    return all;
}

}  // namespace

TomlTable::TomlTable(std::string_view text, std::string file)
    : state_(std::make_shared<State>()), table_(&state_->root) {
    auto root = parseToml(text, file);
    state_->root = emptyTable;
    state_->file = std::move(file);
    if (root)
        state_->root = std::move(*root);
    else
        state_->error = std::move(root.error());
}

TomlTable TomlTable::of(Value root, std::string file) {
    TomlTable table("", std::move(file));
    if (root.asTable())
        table.state_->root = std::move(root);
    else
        table.reject("", "expected a table");
    return table;
}

TomlTable::TomlTable(std::shared_ptr<State> state, const Value* table, std::string path, std::string place)
    : state_(std::move(state)), table_(table), path_(std::move(path)), place_(std::move(place)) {}

bool TomlTable::has(std::string_view key) {
    known_.emplace_back(key);
    return lookUp(key) != nullptr;
}

const Value* TomlTable::lookUp(std::string_view key) const {
    const Value* const own = table_->find(key);
    return own != nullptr ? own : fallback_.find(key);
}

const Value* TomlTable::find(std::string_view key) {
    asked_.emplace(key);
    known_.emplace_back(key);
    const Value* node = lookUp(key);
    if (node || failed()) return node;
    if (rejectMisspelt(key)) return nullptr;
    reject(key, "is missing");
    state_->lacking = table_;
    return nullptr;
}

bool TomlTable::rejectMisspelt(std::string_view key) {
    for (const auto& [other, value] : *table_->asTable()) {
        if (asked_.contains(other) || 4 * wordDistance(other, key) > key.size()) continue;
        rejectAt(&value, other, "is not a known key; did you mean " + std::string(key) + '?');
        return true;
    }
    return false;
}

void TomlTable::expectOneOf(std::string_view one, std::string_view other, const std::string& expected) {
    const bool hasOne = has(one), hasOther = has(other);
    if (hasOne != hasOther || (!hasOne && (rejectMisspelt(one) || rejectMisspelt(other)))) return;
    reject(hasOne ? one : other, "expected either " + expected);
}

void TomlTable::reject(std::string_view key, std::string cause) {
    const Value* const own = table_->find(key);
    if (own == nullptr && fallback_.find(key) != nullptr) cause += " (the key is of " + fallbackName_ + ')';
    rejectAt(own, key, std::move(cause));
}

void TomlTable::rejectElement(std::string_view key, std::size_t index, std::string cause) {
    const Value* node = table_->find(key);
    const Value::Array* array = node ? node->asArray() : nullptr;
    const Value* element = array && index < array->size() ? &(*array)[index] : node;
    rejectAt(element, std::string(key) + '[' + std::to_string(index + 1) + ']', std::move(cause));
}

void TomlTable::adopt(Error error) {
    if (!failed()) state_->error = std::move(error);
}

void TomlTable::rejectAt(const Value* node, std::string_view key, std::string cause) {
    if (failed()) return;
    const Value& where = node ? *node : *table_;
    state_->error = Error{state_->file, int(where.line), int(where.column), path_ + std::string(key), std::move(cause)};
}

std::optional<double> TomlTable::numberIn(const Value& node, std::string_view key, NumberRange range) {
    const auto value = numberOf(node);
    if (value && *value >= range.least && *value <= range.most && std::isfinite(*value)) return value;
    rejectAt(&node, key,
             value && std::isfinite(*value) ? "is " + numberText(*value) + "; expected " + numberText(range.least) +
                                                  " to " + numberText(range.most)
                                            : "expected a finite number");
    return std::nullopt;
}

double TomlTable::number(std::string_view key, NumberRange range) {
    const Value* node = find(key);
    return node ? numberIn(*node, key, range).value_or(0) : 0;
}

double TomlTable::numberOr(std::string_view key, double fallback, NumberRange range) {
    return has(key) ? number(key, range) : fallback;
}

std::int64_t TomlTable::integer(std::string_view key, std::int64_t least, std::int64_t most) {
    const Value* node = find(key);
    if (!node) return least;
    std::optional<std::int64_t> value;
    if (const std::int64_t* const whole = node->asInteger()) value = *whole;
    // What is drawn or swept is computed: 64.0.
    if (const double* const number = node->asFloat();
        number && std::abs(*number) < 1e15 && std::trunc(*number) == *number)
        value = static_cast<std::int64_t>(*number);
    if (value && *value >= least && *value <= most) return *value;
    rejectAt(node, key, "expected a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    return least;
}

std::int64_t TomlTable::integerOr(std::string_view key, std::int64_t fallback, std::int64_t least, std::int64_t most) {
    return has(key) ? integer(key, least, most) : fallback;
}

bool TomlTable::boolean(std::string_view key) {
    const Value* node = find(key);
    if (!node) return false;
    const bool* const value = node->asBoolean();
    if (!value) rejectAt(node, key, "expected true or false");
    return value && *value;
}

bool TomlTable::booleanOr(std::string_view key, bool fallback) { return has(key) ? boolean(key) : fallback; }

std::string TomlTable::string(std::string_view key) {
    const Value* node = find(key);
    if (!node) return {};
    const std::string* const value = node->asText();
    if (!value) rejectAt(node, key, "expected a text in quotes");
    return value ? *value : std::string();
}

std::string TomlTable::stringOr(std::string_view key, std::string fallback) {
    return has(key) ? string(key) : std::move(fallback);
}

namespace {

std::string noneOfText(const std::string& value, std::span<const std::string_view> choices) {
    std::string expected;
    for (const std::string_view c : choices) expected += (expected.empty() ? "\"" : ", \"") + std::string(c) + '"';
    return "is \"" + value + "\"; expected one of " + expected;
}

}  // namespace

std::size_t TomlTable::choice(std::string_view key, std::span<const std::string_view> choices) {
    const std::string value = string(key);
    const auto found = std::find(choices.begin(), choices.end(), value);
    if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
    reject(key, noneOfText(value, choices));
    return 0;
}

std::vector<std::size_t> TomlTable::someChoices(std::string_view key, std::span<const std::string_view> choices) {
    std::vector<std::size_t> chosen;
    const std::vector<std::string> values = strings(key);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto found = std::find(choices.begin(), choices.end(), values[i]);
        const auto choice = static_cast<std::size_t>(found - choices.begin());
        if (found == choices.end())
            rejectElement(key, i, noneOfText(values[i], choices));
        else if (std::find(chosen.begin(), chosen.end(), choice) != chosen.end())
            rejectElement(key, i, "is there twice: \"" + values[i] + '"');
        chosen.push_back(choice);
    }
    return chosen;
}

std::vector<std::string> TomlTable::strings(std::string_view key) {
    const Value* node = find(key);
    std::vector<std::string> values;
    if (!node) return values;
    const Value::Array* const array = node->asArray();
    if (!array) return rejectAt(node, key, "expected an array of texts"), values;
    for (const Value& element : *array) {
        const std::string* const value = element.asText();
        if (!value) rejectAt(&element, key, "expected a text in quotes");
        values.push_back(value ? *value : std::string());
    }
    return values;
}

void TomlTable::appendRow(const Value* node, std::string_view key, std::size_t count, NumberRange range,
                          std::vector<double>& out) {
    const Value::Array* array = node ? node->asArray() : nullptr;
    if (node && !array) rejectAt(node, key, "expected an array of numbers");
    if (!array) return;
    if (array->size() != count) {
        rejectAt(node, key,
                 "has " + std::to_string(array->size()) + (array->size() == 1 ? " number" : " numbers") +
                     "; expected " + std::to_string(count));
        return;
    }
    for (const Value& element : *array) {
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
    const Value* node = find(key);
    const Value::Array* array = node ? node->asArray() : nullptr;
    if (node && (!array || array->size() < least || array->size() > most))
        rejectAt(node, key, "expected " + std::to_string(least) + " to " + std::to_string(most) + " numbers");
    else if (array)
        appendRow(node, key, array->size(), range, values);
    return values;
}

std::vector<double> TomlTable::matrix(std::string_view key, std::size_t rows, std::size_t columns, NumberRange range) {
    std::vector<double> values;
    const Value* node = find(key);
    const Value::Array* array = node ? node->asArray() : nullptr;
    if (node && (!array || array->size() != rows))
        rejectAt(node, key, "expected " + std::to_string(rows) + " arrays of numbers");
    else if (array)
        for (const Value& row : *array) appendRow(&row, key, columns, range, values);
    values.resize(rows * columns);
    return values;
}

std::vector<double> TomlTable::rows(std::string_view key, std::size_t columns, std::size_t least, std::size_t most,
                                    NumberRange range) {
    const Value* node = find(key);
    const Value::Array* array = node ? node->asArray() : nullptr;
    if (node && (!array || array->size() < least || array->size() > most))
        rejectAt(node, key,
                 (array ? "has " + std::to_string(array->size()) + " elements; " : "") + "expected " +
                     std::to_string(least) + " to " + std::to_string(most) + " arrays of " + std::to_string(columns) +
                     " numbers");
    std::vector<double> values;
    if (!array || failed()) return values;
    for (const Value& row : *array) appendRow(&row, key, columns, range, values);
    return failed() ? std::vector<double>() : values;
}

TomlTable TomlTable::table(std::string_view key) {
    const Value* node = find(key);
    const bool found = node && node->asTable();
    if (node && !found) rejectAt(node, key, "expected a table");
    return {state_, found ? node : &emptyTable, path_ + std::string(key) + '.', place_ + std::string(key) + '.'};
}

TomlTable TomlTable::tableOrEmpty(std::string_view key) {
    if (has(key)) return table(key);
    return {state_, &emptyTable, path_ + std::string(key) + '.', place_ + std::string(key) + '.'};
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
    std::vector<TomlTable> found;
    const Value* node = find(key);
    if (!node) return found;
    const Value::Array* array = node->asArray();
    if (!array) rejectAt(node, key, "expected an array of tables");
    for (std::size_t i = 0; array && i < array->size(); ++i) {
        const Value& element = (*array)[i];
        const std::string numbered = std::string(key) + '[' + std::to_string(i + 1) + ']';
        if (element.asTable())
            found.push_back(
                TomlTable(state_, &element, path_ + elementKey(key, element, i) + '.', place_ + numbered + '.'));
        else
            rejectAt(&element, numbered, "expected a table");
    }
    return found;
}

std::vector<TomlTable> TomlTable::tablesOrNone(std::string_view key) {
    return has(key) ? tables(key) : std::vector<TomlTable>();
}

void TomlTable::resolve(std::string_view key, Value value) {
    state_->resolved.insert_or_assign(place_ + std::string(key), std::move(value));
}

Value TomlTable::resolved() const { return withPutIn(state_->root, "", state_->resolved); }

std::string TomlTable::text() const { return tomlText(*table_); }

std::string TomlTable::meantFor(std::string_view key) const {
    std::vector<std::string_view> candidates;
    for (const std::string& known : known_)
        if (!table_->find(known)) candidates.push_back(known);
    return std::string(nearestWord(key, candidates));
}

void TomlTable::rejectUnknown() {
    if (failed() && state_->lacking != table_) return;
    for (const auto& [key, node] : *table_->asTable()) {
        if (asked_.contains(key)) continue;
        const std::string meant = meantFor(key);
        // After an error not all keys need to have been asked for.
        if (failed() && meant.empty()) continue;
        state_->error.reset();
        state_->lacking = nullptr;
        std::string cause = "is not a known key";
        if (!meant.empty())
            cause += "; did you mean " + meant + '?';
        else if (!known_.empty())
            cause += "; expected one of " + listed(known_);
        return rejectAt(&node, key, std::move(cause));
    }
}

}  // namespace mrose
