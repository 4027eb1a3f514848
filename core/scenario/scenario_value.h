#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"
#include "io/value.h"

namespace mrose {

/// Another value at a path.
struct ScenarioOverride {
    std::string path;
    Value value;
};
/// "PATH=VALUE", the value as in TOML; a text needs no quotes. Error: it is not that.
Expected<ScenarioOverride> parseOverride(std::string_view assignment);

/// All that a scenario's run is made from, as a value: its description with those of all that it names, and the
/// commands and states that it begins with. It gives the same scenario again without any disk (scenario_file.h); TOML
/// is one way in, state_scenario.h one way out. Paths are as in Value: `robot[2].network`, `robot["keeper"].start.x_m`,
/// `seed`.
class ScenarioValue {
public:
    ScenarioValue() : ScenarioValue("", Value::Table()) {}  ///< says nothing
    /// Of the scenario's own description.
    explicit ScenarioValue(Value::File file) : file_(std::move(file)) {}
    ScenarioValue(std::string name, Value content);

    const std::string& name() const { return file_->name; }
    const Value& content() const { return file_->content; }
    const Value* at(std::string_view path) const { return content().at(path); }

    /// As of Value::places().
    std::vector<std::string> places(std::string_view path) const { return content().places(path); }

    /// The same with another value at a path. What it says is checked when a scenario is made of it. Error: as of
    /// Value::with().
    Expected<ScenarioValue> with(std::string_view path, Value value) const;
    ScenarioValue without(std::string_view path) const;
    /// With what a person writes (parseOverride()). Error: it is not that; as of with().
    Expected<ScenarioValue> overridden(std::string_view assignment) const;

    /// The path of the robot, person or object of that name: `robot[2]`; "" where there is none.
    std::string bodyPath(std::string_view name) const;

    /// All files that it is made of, its own last.
    std::vector<Value::File> files() const;

    /// Canonical: equal scenarios have equal bytes but for names of files. Of files known to the reader, too, only a
    /// hash is in them.
    std::string bytes(std::span<const Value::File> known = {}) const;
    /// nullopt: they are not sound.
    static std::optional<ScenarioValue> parse(std::string_view bytes, std::span<const Value::File> known = {});
    /// Of what it says, whatever its files are called.
    std::uint64_t hash() const;

    bool operator==(const ScenarioValue& other) const { return content() == other.content(); }

private:
    Value::File file_;
};

using ScenarioValuePointer = std::shared_ptr<const ScenarioValue>;

}  // namespace mrose
