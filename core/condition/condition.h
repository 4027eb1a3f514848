#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "condition/world_names.h"
#include "io/error.h"

namespace mrose {

class WorldExpression;

/// A question about the world, as a Lua expression: "robot[2].speed > 0.5 and distance(robot[2], ball) < 0.3".
/// README.md lists the names. It is answered from a state and the step that led to it, and remembers nothing, so that a
/// run and its replay agree. For one thread at a time; another thread compiles its own from the same text.
class Condition {
public:
    Condition(Condition&&) noexcept;
    Condition& operator=(Condition&&) noexcept;
    ~Condition();

    const std::string& text() const;

    /// Whether it holds. `scenario` must have the bodies and goals of the one that it was compiled for, and `state`
    /// must be of it; `trace` is of the step that led to it, and nothing at a run's start, where nothing touches.
    /// Error: the text's source, the line and what is wrong; it needs too many instructions or bytes; it is neither
    /// true nor false.
    Expected<bool> holds(const Scenario& scenario, const WorldState& state, const StepTrace* trace);

private:
    friend Expected<Condition> compileCondition(std::string_view, const Scenario&, const std::string&,
                                                const RealPoses&);
    explicit Condition(std::unique_ptr<WorldExpression> expression);

    std::unique_ptr<WorldExpression> expression_;
};

/// Error: `source` in the file's place, line and column in the text, and what is wrong: no expression, a name or a body
/// that the scenario does not have, or what holds() would say of the scenario's start. Functions defined in the text
/// may have names of their own, so that unknown ones there may come to light only in holds(). What is asked of the real
/// log is answered by `real`.
Expected<Condition> compileCondition(std::string_view text, const Scenario& scenario,
                                     const std::string& source = "condition", const RealPoses& real = {});

/// A number of the world, as such an expression: "distance(robot[2], ball)". True is 1, false is 0.
class WorldValue {
public:
    WorldValue(WorldValue&&) noexcept;
    WorldValue& operator=(WorldValue&&) noexcept;
    ~WorldValue();

    const std::string& text() const;

    /// Arguments and errors as of Condition::holds(); it may be infinite or no number, as Lua computes.
    Expected<double> value(const Scenario& scenario, const WorldState& state, const StepTrace* trace);

private:
    friend Expected<WorldValue> compileWorldValue(std::string_view, const Scenario&, const std::string&,
                                                  const RealPoses&);
    explicit WorldValue(std::unique_ptr<WorldExpression> expression);

    std::unique_ptr<WorldExpression> expression_;
};

/// Errors as of compileCondition().
Expected<WorldValue> compileWorldValue(std::string_view text, const Scenario& scenario,
                                       const std::string& source = "expression", const RealPoses& real = {});

}  // namespace mrose
