#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "io/error.h"
#include "quantities/moment.h"

namespace mrose {

class WorldExpression;

/// A question about the world, as a Lua expression: "robot[2].speed > 0.5 and distance(robot[2], ball) < 0.3".
/// README.md lists the names. It is answered from what is known at a tick, and remembers nothing, so that a run and its
/// replay agree. For one thread at a time; another thread compiles its own from the same text.
class Condition {
public:
    Condition(Condition&&) noexcept;
    Condition& operator=(Condition&&) noexcept;
    ~Condition();

    const std::string& text() const;

    /// Whether it holds. The scenario must have the bodies and goals of the one that it was compiled for. At a run's
    /// start nothing touches. Error: the text's source, the line and what is wrong; it needs too many instructions or
    /// bytes; it is neither true nor false.
    Expected<bool> holds(const Moment& at);

private:
    friend Expected<Condition> compileCondition(std::string_view, const Scenario&, const std::string&,
                                                const RealRobots*, const DrawnValues*, bool);
    explicit Condition(std::unique_ptr<WorldExpression> expression);

    std::unique_ptr<WorldExpression> expression_;
};

/// Whether a text names what controllers saw, decided or remember: then it needs Moment::insights, and controllers that
/// were asked.
bool readsControl(std::string_view text, const Scenario& scenario);
/// The same of what controllers and motion models remember left out, which the state has: then it needs the insights.
bool readsInsights(std::string_view text, const Scenario& scenario);

/// Error: `source` in the file's place, line and column in the text, and what is wrong: no expression, a name or a body
/// that the scenario does not have, or what holds() would say of the scenario's start. Functions defined in the text
/// may have names of their own, so that unknown ones there may come to light only in holds(). Without `real` no real
/// log is open, and asking for it is an error that says so; likewise what was drawn for a trial, where neither `drawn`
/// nor the scenario has it: later ones must have the same names. Not `tried`: what holds() would say of the start is
/// not looked at.
Expected<Condition> compileCondition(std::string_view text, const Scenario& scenario,
                                     const std::string& source = "condition", const RealRobots* real = nullptr,
                                     const DrawnValues* drawn = nullptr, bool tried = true);

/// A number of the world, as such an expression: "distance(robot[2], ball)". True is 1, false is 0.
class WorldValue {
public:
    WorldValue(WorldValue&&) noexcept;
    WorldValue& operator=(WorldValue&&) noexcept;
    ~WorldValue();

    const std::string& text() const;

    /// Arguments and errors as of Condition::holds(); it may be infinite or no number, as Lua computes.
    Expected<double> value(const Moment& at);

private:
    friend Expected<WorldValue> compileWorldValue(std::string_view, const Scenario&, const std::string&,
                                                  const RealRobots*, const DrawnValues*, const DrawnValues*, bool);
    explicit WorldValue(std::unique_ptr<WorldExpression> expression);

    std::unique_ptr<WorldExpression> expression_;
};

/// Errors as of compileCondition(). Without `measured`, what a trial's measures gave, asking for these is one, too.
Expected<WorldValue> compileWorldValue(std::string_view text, const Scenario& scenario,
                                       const std::string& source = "expression", const RealRobots* real = nullptr,
                                       const DrawnValues* drawn = nullptr, const DrawnValues* measured = nullptr,
                                       bool tried = true);

}  // namespace mrose
