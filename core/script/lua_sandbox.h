#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "io/error.h"

struct lua_State;

namespace mrose {

/// What a text may use up.
struct LuaLimits {
    std::size_t memory = 1 << 20;  ///< bytes, of reading and running it, beside what the names take
    std::size_t block = 1 << 16;   ///< bytes, of one string or array: what one instruction can copy or compare
    int instructions = 10'000;     ///< of one evaluation
};

/// A value that is neither true or false, a number nor a text.
struct LuaOther {
    const char* type;            ///< "nil", "function", "robot"; lives as long as the sandbox
    const void* data = nullptr;  ///< of userdata: until the sandbox is asked again, or as long as a name holds it
};
using LuaValue = std::variant<bool, double, std::string, LuaOther>;

/// A Lua 5.4 interpreter for untrusted texts. They reach the names that were added and nothing else: there is no
/// library, no metatable, no way to a file, to bytecode or to a coroutine. No evaluation leaves anything behind for the
/// next. Results are the same on every processor: x^2 is there, but no other power by that operator (lua_tokens.h). One
/// thread at a time; each has its own.
class LuaSandbox {
public:
    explicit LuaSandbox(const LuaLimits& limits = {});
    ~LuaSandbox();
    LuaSandbox(LuaSandbox&&) noexcept;
    LuaSandbox& operator=(LuaSandbox&&) noexcept;

    // Names are added before the first text is read, through Lua's own interface. Their functions may raise Lua's
    // errors, and must own nothing then. All full userdata of the interpreter are theirs.

    lua_State* state() const;
    /// Takes the value on top of the stack.
    void addName(const char* name);
    /// A name whose value `function` (lua_State*) -> int pushes anew each time.
    void addVariable(const char* name, int (*function)(lua_State*));
    void addVariable(const char* name);  ///< the same of the function on top of the stack, which it takes

    /// A compiled expression.
    struct Expression {
        int reference = 0;
    };
    /// Reads a text that must be one expression. Error: file `source`, with line and column in the text and what does
    /// not fit there; the limits.
    Expected<Expression> load(std::string_view text, const std::string& source);

    /// Error: file `source`, the line and what is wrong; an unknown name; the limits.
    Expected<LuaValue> evaluate(Expression expression, const std::string& source);

    /// It will not be evaluated again.
    void forget(Expression expression);

    /// Statements under way, on a thread of Lua's own. `local` names hold what they keep; others cannot be assigned to.
    struct Statements {
        lua_State* thread = nullptr;
        int reference = 0;
        std::string source;
    };
    /// Reads a text of statements. Error: file `source`, line and column and what does not fit there; the limits.
    Expected<Statements> loadStatements(std::string_view text, const std::string& source);
    /// Goes on until a function of the names yields (true: the values are all that is on the thread's stack, and are to
    /// be taken from there) or the text ends (false). That function then returns the `given` values that lie there. The
    /// limit of instructions is anew each time, that of memory is one; names may be added in between.
    Expected<bool> proceed(const Statements& statements, int given = 0);
    /// Where they stand, or failed.
    int lineOf(const Statements& statements) const;
    void forget(const Statements& statements);

private:
    struct Interpreter;
    std::unique_ptr<Interpreter> interpreter_;
};

}  // namespace mrose
