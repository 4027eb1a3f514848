#include "io/value.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <functional>
#include <optional>
#include <span>

namespace mrose {
namespace {

/// One step of a path: a key of a table, or an element of an array by its number from 0 or its name, or all of them.
struct Step {
    std::string key;
    std::optional<std::size_t> index = {};
    bool name = false;  ///< the key is an element's name
    bool all = false;

    bool ofArray() const { return index || name || all; }
};

bool isKeyLetter(char letter) { return letter != '.' && letter != '[' && letter != ']' && letter != '"'; }

/// `[2]` or `["keeper"]` off the front of a path.
std::optional<Step> takeElement(std::string_view& path) {
    if (path.starts_with("[*]")) {
        path.remove_prefix(3);
        return Step{{}, {}, false, true};
    }
    if (path.starts_with("[\"")) {
        const std::size_t end = path.find("\"]", 2);
        if (end == std::string_view::npos) return {};
        Step step{std::string(path.substr(2, end - 2)), {}, true};
        path.remove_prefix(end + 2);
        return step;
    }
    const std::size_t end = path.find(']');
    std::size_t number = 0;
    if (end == std::string_view::npos) return {};
    const auto parsed = std::from_chars(path.data() + 1, path.data() + end, number);
    if (parsed.ptr != path.data() + end || parsed.ec != std::errc{} || number == 0) return {};
    path.remove_prefix(end + 1);
    return Step{{}, number - 1};
}

/// nullopt: it is no path.
std::optional<std::vector<Step>> stepsOf(std::string_view path) {
    std::vector<Step> steps;
    while (!path.empty()) {
        if (path.front() == '[' && !steps.empty()) {
            const auto step = takeElement(path);
            if (!step) return {};
            steps.push_back(*step);
            continue;
        }
        if (!steps.empty() && path.front() != '.') return {};
        if (!steps.empty()) path.remove_prefix(1);
        std::size_t size = 0;
        while (size < path.size() && isKeyLetter(path[size])) ++size;
        if (size == 0) return {};
        steps.push_back({std::string(path.substr(0, size))});
        path.remove_prefix(size);
    }
    if (steps.empty()) return {};
    return steps;
}

/// What a value holds for who looks into it: of a file its content.
const Value& inside(const Value& value) {
    const DescriptionFile* const file = value.asFile();
    return file ? file->content : value;
}

/// Whether a step names the element of an array at a place.
bool names(const Step& step, const Value::Array& array, std::size_t place) {
    if (!step.name) return step.all || step.index == place;
    const Value* const name = array[place].find("name");
    return name && name->asText() && *name->asText() == step.key;
}

/// The first element that a step names.
std::optional<std::size_t> elementOf(const Value::Array& array, const Step& step) {
    for (std::size_t i = 0; i < array.size(); ++i)
        if (names(step, array, i)) return i;
    return {};
}

const Value* childOf(const Value& value, const Step& step) {
    const Value& content = inside(value);
    if (!step.ofArray()) return content.find(step.key);
    const Value::Array* const array = content.asArray();
    const auto element = array ? elementOf(*array, step) : std::nullopt;
    return element ? &(*array)[*element] : nullptr;
}

/// With `changed` in the place of a value's content.
Value repacked(const Value& value, Value changed) {
    if (const DescriptionFile* const file = value.asFile())
        changed = std::make_shared<const DescriptionFile>(DescriptionFile{file->name, file->reference, changed});
    changed.line = value.line;
    changed.column = value.column;
    return changed;
}

using Steps = std::span<const Step>;

/// nullopt: the path does not exist. `value` nothing: what is there is taken away.
std::optional<Value> changed(const Value& from, Steps steps, const std::optional<Value>& value) {
    if (steps.empty()) return value;
    const Step& step = steps.front();
    const Value& content = inside(from);
    if (step.ofArray()) {
        const Value::Array* const array = content.asArray();
        if (!array || !elementOf(*array, step)) return {};
        Value::Array copy;
        bool found = false;
        for (std::size_t i = 0; i < array->size(); ++i) {
            if (!names(step, *array, i) || (found && !step.all)) {
                copy.push_back((*array)[i]);
                continue;
            }
            found = true;
            if (steps.size() == 1 && !value) continue;
            auto child = changed((*array)[i], steps.subspan(1), value);
            if (!child) return {};
            copy.push_back(std::move(*child));
        }
        return repacked(from, std::move(copy));
    }
    const Value::Table* const table = content.asTable();
    if (!table) return {};
    const auto found = table->find(step.key);
    if (found == table->end() && (!value || (steps.size() > 1 && steps[1].ofArray()))) return {};
    Value::Table copy = *table;
    if (steps.size() == 1 && !value) {
        copy.erase(step.key);
    } else {
        static const Value empty = Value::Table();
        auto child = changed(found == table->end() ? empty : found->second, steps.subspan(1), value);
        if (!child) return {};
        copy.insert_or_assign(step.key, std::move(*child));
    }
    return repacked(from, std::move(copy));
}

void addPlaces(const Value* from, Steps steps, const std::string& before, std::vector<std::string>& places) {
    if (steps.empty()) return places.push_back(before);
    const Step& step = steps.front();
    const Value* const content = from != nullptr ? &inside(*from) : nullptr;
    if (!step.ofArray())
        return addPlaces(content != nullptr ? content->find(step.key) : nullptr, steps.subspan(1),
                         before + (before.empty() ? "" : ".") + step.key, places);
    const Value::Array* const array = content != nullptr ? content->asArray() : nullptr;
    for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
        if (!names(step, *array, i)) continue;
        addPlaces(&(*array)[i], steps.subspan(1), before + '[' + std::to_string(i + 1) + ']', places);
        if (!step.all) return;
    }
}

std::ptrdiff_t starsIn(std::string_view path) {
    const auto steps = stepsOf(path);
    return steps ? std::ranges::count_if(*steps, &Step::all) : 0;
}

}  // namespace

Value::File Value::sharedFile() const {
    const File* const file = std::get_if<File>(&content_);
    return file ? *file : nullptr;
}

const Value* Value::find(std::string_view key) const {
    const Table* const table = asTable();
    if (!table) return nullptr;
    const auto found = table->find(key);
    return found == table->end() ? nullptr : &found->second;
}

const Value* Value::at(std::string_view path) const {
    const auto steps = stepsOf(path);
    if (!steps) return nullptr;
    const Value* value = this;
    for (const Step& step : *steps)
        if (!(value = childOf(*value, step))) return nullptr;
    return value;
}

Expected<Value> Value::with(std::string_view path, Value value) const {
    const auto steps = stepsOf(path);
    auto result = steps ? changed(*this, *steps, std::move(value)) : std::nullopt;
    if (!result)
        return fail("",
                    steps ? "names nothing that there is; expected a path such as robot[2].network"
                          : "is no path; expected one such as robot[2].network",
                    0, std::string(path));
    return std::move(*result);
}

Value Value::without(std::string_view path) const {
    const auto steps = stepsOf(path);
    return steps ? changed(*this, *steps, std::nullopt).value_or(*this) : *this;
}

std::vector<std::string> Value::places(std::string_view path) const {
    std::vector<std::string> places;
    if (const auto steps = stepsOf(path)) addPlaces(this, *steps, "", places);
    return places;
}

bool Value::operator==(const Value& other) const {
    if (content_.index() != other.content_.index()) return false;
    if (const double* const number = asFloat())
        return std::bit_cast<std::uint64_t>(*number) == std::bit_cast<std::uint64_t>(*other.asFloat());
    if (const Array* const array = asArray()) return array == other.asArray() || *array == *other.asArray();
    if (const Table* const table = asTable()) return table == other.asTable() || *table == *other.asTable();
    if (const DescriptionFile* const file = asFile())
        return file == other.asFile() || file->content == other.asFile()->content;
    return content_ == other.content_;
}

bool areWithin(const std::vector<std::string>& places, const std::vector<std::string>& others) {
    return !places.empty() && std::ranges::all_of(places, [&](const std::string& place) {
        return std::ranges::any_of(others, [&](const std::string& other) {
            return place.starts_with(other) &&
                   (place.size() == other.size() || place[other.size()] == '.' || place[other.size()] == '[');
        });
    });
}

std::vector<std::pair<std::string, Value>> generalFirst(const Value::Table& sets) {
    std::vector<std::pair<std::string, Value>> ordered(sets.begin(), sets.end());
    std::ranges::stable_sort(ordered, std::greater(), [](const auto& set) { return starsIn(set.first); });
    return ordered;
}

}  // namespace mrose
