#pragma once

#include <initializer_list>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"
#include "io/value.h"

namespace mrose {

struct NumberRange {
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
};

/// A table of a description read strictly: every read names its key, says what was expected, and remembers the first
/// thing wrong with file, line and column; of a table that lacks one key and has another one that is not known, the
/// latter. Elements of arrays are given by their names, "robot[\"keeper\"].start", or counted from 1. After an error
/// reads return neutral values, so that a loader checks once, at its end.
class TomlTable {
public:
    /// Parses a whole file's text. A syntax error is remembered like any other.
    TomlTable(std::string_view text, std::string file);
    /// The same of what was parsed before, or was never a text: `file` is what errors call it.
    static TomlTable of(Value root, std::string file);

    bool has(std::string_view key);
    /// One of these two must be there, and not both; `expected` names them as they are written.
    void expectOneOf(std::string_view one, std::string_view other, const std::string& expected);
    double number(std::string_view key, NumberRange range = {});
    double numberOr(std::string_view key, double fallback, NumberRange range = {});
    std::int64_t integer(std::string_view key, std::int64_t least, std::int64_t most);
    std::int64_t integerOr(std::string_view key, std::int64_t fallback, std::int64_t least, std::int64_t most);
    bool boolean(std::string_view key);
    bool booleanOr(std::string_view key, bool fallback);
    std::string string(std::string_view key);
    std::string stringOr(std::string_view key, std::string fallback);
    /// One of `choices`; its index.
    std::size_t choice(std::string_view key, std::span<const std::string_view> choices);
    std::size_t choice(std::string_view key, std::initializer_list<std::string_view> choices) {
        return choice(key, std::span(choices.begin(), choices.size()));
    }
    /// An array of some of `choices`, none twice; their indices.
    std::vector<std::size_t> someChoices(std::string_view key, std::span<const std::string_view> choices);
    std::vector<std::string> strings(std::string_view key);
    /// Exactly `count` finite numbers in `range`.
    std::vector<double> numbers(std::string_view key, std::size_t count, NumberRange range = {});
    /// `least` to `most` of them.
    std::vector<double> someNumbers(std::string_view key, std::size_t least, std::size_t most, NumberRange range = {});
    /// `rows` arrays of `columns` finite numbers each, one after the other.
    std::vector<double> matrix(std::string_view key, std::size_t rows, std::size_t columns, NumberRange range = {});
    /// `least` to `most` arrays of `columns` finite numbers each, one after the other; empty after an error.
    std::vector<double> rows(std::string_view key, std::size_t columns, std::size_t least, std::size_t most,
                             NumberRange range = {});
    TomlTable table(std::string_view key);
    TomlTable tableOrEmpty(std::string_view key);         ///< an empty one where the key is missing
    std::vector<TomlTable> tables(std::string_view key);  ///< an array of tables
    std::vector<TomlTable> tablesOrNone(std::string_view key);

    /// From now on a key that this table lacks is read from another one, which was checked before: unknown keys in it
    /// are none of this table's. `called`: as messages about its keys name it.
    void fallBackOn(Value table, std::string called) {
        fallback_ = std::move(table), fallbackName_ = std::move(called);
    }

    /// The value of a key as it is; null, after remembering that it is missing, where there is none.
    const Value* value(std::string_view key) { return find(key); }
    /// Notes that what a key holds is the same as `value`: the file that it names. resolved() has it in that place.
    void resolve(std::string_view key, Value value);
    /// The whole file's table with all that resolve() recorded, in this table and others of the file.
    Value resolved() const;

    /// The table's own text in TOML.
    std::string text() const;

    /// Remembers an error about a key of this table, or about element `index`, from 0, of the array that it holds.
    void reject(std::string_view key, std::string cause);
    void rejectElement(std::string_view key, std::size_t index, std::string cause);
    /// Remembers an error of another file, which this one needs.
    void adopt(Error error);
    /// Rejects keys that nothing above asked for: most are misspelt, and a missing one is what they were meant for.
    void rejectUnknown();

    bool failed() const { return state_->error.has_value(); }
    const Error& error() const { return *state_->error; }

private:
    struct State {
        Value root;
        std::string file;
        std::optional<Error> error;
        const Value* lacking = nullptr;         ///< the table that the error says a key is missing in
        std::map<std::string, Value> resolved;  ///< by their places
    };
    TomlTable(std::shared_ptr<State> state, const Value* table, std::string path, std::string place);

    /// A key that was probably meant to be this one; whether there was such.
    bool rejectMisspelt(std::string_view key);
    const Value* find(std::string_view key);
    /// As it is; null: it is not there.
    const Value* lookUp(std::string_view key) const;
    void rejectAt(const Value* node, std::string_view key, std::string cause);
    /// The key that a misspelt one is meant for; "" where none is near.
    std::string meantFor(std::string_view key) const;
    /// A finite number in `range`; nothing, after remembering the error, for anything else.
    std::optional<double> numberIn(const Value& node, std::string_view key, NumberRange range);
    void appendRow(const Value* node, std::string_view key, std::size_t count, NumberRange range,
                   std::vector<double>& out);

    std::shared_ptr<State> state_;
    const Value* table_;  ///< a table
    Value fallback_;      ///< another one, or nothing
    std::string fallbackName_;
    std::string path_;                          ///< as messages name it, with a dot at its end
    std::string place_;                         ///< the same with the numbers of elements
    std::set<std::string, std::less<>> asked_;  ///< keys read
    std::vector<std::string> known_;            ///< those and the ones looked for
};

}  // namespace mrose
