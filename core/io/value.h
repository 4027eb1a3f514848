#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "io/error.h"

namespace mrose {

struct DescriptionFile;

/// What a description says, as a tree: of numbers, texts, arrays, tables, and whole files that it names. A value:
/// copies share what they hold, and a changed one copies the path to the change alone.
class Value {
public:
    using Array = std::vector<Value>;
    using Table = std::map<std::string, Value, std::less<>>;
    using File = std::shared_ptr<const DescriptionFile>;

    Value() = default;  ///< nothing that a description may hold
    Value(bool value) : content_(value) {}
    Value(int value) : content_(std::int64_t{value}) {}
    Value(std::int64_t value) : content_(value) {}
    Value(double value) : content_(value) {}
    Value(const char* text) : content_(std::string(text)) {}
    Value(std::string text) : content_(std::move(text)) {}
    Value(Array array) : content_(std::make_shared<const Array>(std::move(array))) {}
    Value(Table table) : content_(std::make_shared<const Table>(std::move(table))) {}
    Value(File file) : content_(std::move(file)) {}
    Value(const void*) = delete;  ///< no pointer is a truth

    const bool* asBoolean() const { return std::get_if<bool>(&content_); }
    const std::int64_t* asInteger() const { return std::get_if<std::int64_t>(&content_); }
    const double* asFloat() const { return std::get_if<double>(&content_); }
    const std::string* asText() const { return std::get_if<std::string>(&content_); }
    const Array* asArray() const { return pointerTo<Array>(); }
    const Table* asTable() const { return pointerTo<Table>(); }
    const DescriptionFile* asFile() const { return pointerTo<DescriptionFile>(); }
    /// The same, to be kept.
    File sharedFile() const;

    /// The value of a key; null where this is no table or has no such key.
    const Value* find(std::string_view key) const;

    /// The value at a path such as `robot[2].start.x_m` or `robot["keeper"].network`: elements count from 1, or are
    /// given by their key `name`, or all of them as `robot[*]`, of which this is the first; what a named file holds is
    /// reached through the key that names it. Null: there is none.
    const Value* at(std::string_view path) const;
    /// This value with another one at a path, whose last key may be new, and whose tables before it, too. Error: its
    /// key is the path; there is no such element, or something on the way is no table.
    Expected<Value> with(std::string_view path, Value value) const;
    /// This value without what is at a path; the same where there is none.
    Value without(std::string_view path) const;
    /// The places that a path leads to, or may lead to by a new key, each by the numbers of its elements and in one
    /// way of writing it: `robot[*].network` as `robot[1].network` and `robot[2].network`. None: there are none.
    std::vector<std::string> places(std::string_view path) const;

    /// Where a text that it was read from has it, from 1; 0: unknown. Equal values may lie elsewhere.
    std::uint32_t line = 0, column = 0;

    /// The same content, numbers to the last bit, whatever the files' names are.
    bool operator==(const Value& other) const;

private:
    template <class T>
    const T* pointerTo() const {
        const auto* const pointer = std::get_if<std::shared_ptr<const T>>(&content_);
        return pointer ? pointer->get() : nullptr;
    }

    std::variant<std::monostate, bool, std::int64_t, double, std::string, std::shared_ptr<const Array>,
                 std::shared_ptr<const Table>, File>
        content_;
};

/// A file that a description names, as it was read.
struct DescriptionFile {
    std::string name;       ///< by which it was found
    std::string reference;  ///< what the description says instead of it; empty: of the description itself
    Value content;          ///< a table, or the text of what is no description: a network
};

/// Whether each of some places (Value::places()), or something that it lies in, is among others; false of none.
bool areWithin(const std::vector<std::string>& places, const std::vector<std::string>& others);

/// What a table sets, in the order in which it is put into a description: paths of all elements, as `robot[*].network`,
/// before those of one, so that who names a robot has the last word; otherwise by their texts.
std::vector<std::pair<std::string, Value>> generalFirst(const Value::Table& sets);

}  // namespace mrose
