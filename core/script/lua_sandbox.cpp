#include "script/lua_sandbox.h"

#include <array>
#include <cstdlib>
#include <new>
#include <vector>

#include <lua.hpp>

#include "io/nearest_word.h"
#include "io/text_position.h"
#include "script/lua_tokens.h"

namespace mrose {
namespace {

/// What the allocator counts by.
struct Budget {
    LuaLimits limits;
    std::size_t used = 0;
    std::size_t most = 0;  ///< of `used`, while `capped`
    bool capped = false;
};

void* allocate(void* data, void* block, std::size_t oldSize, std::size_t newSize) {
    Budget& budget = *static_cast<Budget*>(data);
    const std::size_t old = block != nullptr ? oldSize : 0;
    if (newSize == 0) {
        std::free(block);
        budget.used -= old;
        return nullptr;
    }
    if (budget.capped && newSize > old && (newSize > budget.limits.block || budget.used - old + newSize > budget.most))
        return nullptr;
    void* const fresh = std::realloc(block, newSize);
    if (fresh != nullptr) budget.used += newSize - old;
    return fresh;
}

Budget& budgetOf(lua_State* lua) {
    void* data = nullptr;
    lua_getallocf(lua, &data);
    return *static_cast<Budget*>(data);
}

void onTooMany(lua_State* lua, lua_Debug* /*where*/) {
    luaL_error(lua, "does not end within %d instructions", budgetOf(lua).limits.instructions);
}

/// The same of statements, with the line: a hook runs above the function that it interrupts.
void onTooManyHere(lua_State* lua, lua_Debug* where) {
    lua_getinfo(lua, "l", where);
    lua_pushfstring(lua, "c:%d: does not end within %d instructions", where->currentline,
                    budgetOf(lua).limits.instructions);
    lua_error(lua);
}

int refuseAssignment(lua_State* lua) { return luaL_error(lua, "names cannot be assigned to"); }

void collectNames(lua_State* lua, int table, std::vector<std::string_view>& names) {
    for (lua_pushnil(lua); lua_next(lua, table) != 0; lua_pop(lua, 1))
        if (lua_type(lua, -2) == LUA_TSTRING) names.emplace_back(lua_tostring(lua, -2));
}

/// The name that the unknown one at index 2 is meant for, of the names at 1 and the variables; nullptr: none.
const char* meantName(lua_State* lua) {
    std::vector<std::string_view> names;
    collectNames(lua, 1, names);
    collectNames(lua, lua_upvalueindex(1), names);
    return nearestWord(lua_tostring(lua, 2), names).data();
}

/// __index of the names: upvalue 1 has the functions of variables.
int findVariable(lua_State* lua) {
    lua_pushvalue(lua, 2);
    if (lua_rawget(lua, lua_upvalueindex(1)) == LUA_TFUNCTION) {
        lua_call(lua, 0, 1);
        return 1;
    }
    if (lua_type(lua, 2) != LUA_TSTRING) return luaL_error(lua, "unknown name '?'");
    const char* const meant = meantName(lua);
    return luaL_error(lua, meant != nullptr ? "unknown name '%s'; did you mean %s?" : "unknown name '%s'",
                      lua_tostring(lua, 2), meant);
}

/// Memory is limited only while Lua catches its own errors.
class Capped {
public:
    explicit Capped(Budget& budget) : budget_(budget) { budget_.capped = true; }
    Capped(const Capped&) = delete;
    Capped& operator=(const Capped&) = delete;
    ~Capped() { budget_.capped = false; }

private:
    Budget& budget_;
};

/// Gives a text to Lua byte by byte, so that it is known how far Lua has read.
struct Feed {
    std::array<std::string_view, 3> parts;
    std::size_t read = 0;
};

const char* nextByte(lua_State* /*lua*/, void* data, std::size_t* size) {
    Feed& feed = *static_cast<Feed*>(data);
    std::size_t at = feed.read++;
    *size = 1;
    for (const std::string_view part : feed.parts) {
        if (at < part.size()) return part.data() + at;
        at -= part.size();
    }
    *size = 0;
    return nullptr;
}

/// The length of what stands at the end of "... near 'text'".
std::size_t nearLength(std::string_view message) {
    const auto near = message.rfind(" near '");
    if (near == std::string_view::npos || !message.ends_with('\'')) return 0;
    const std::string_view token = message.substr(near + 7, message.size() - near - 8);
    return token.starts_with("<\\") ? 1 : token.size();
}

constexpr const char* chunkName = "=c";
constexpr std::string_view messagePrefix = "c:";

/// "c:12: cause" in parts; `line` stays as it is where the message names none.
std::string withoutPosition(std::string_view message, int& line) {
    if (!message.starts_with(messagePrefix)) return std::string(message);
    const auto colon = message.find(": ", messagePrefix.size());
    if (colon == std::string_view::npos) return std::string(message);
    line = std::atoi(std::string(message.substr(messagePrefix.size(), colon)).c_str());
    return std::string(message.substr(colon + 2));
}

std::string memoryCause(const LuaLimits& limits) {
    return "needs more memory than the " + std::to_string(limits.memory / 1024) + " KB (" +
           std::to_string(limits.block / 1024) + " KB in one piece) that it may use";
}

/// The error on top of the stack, which is taken.
Error takeError(lua_State* lua, int status, const std::string& source) {
    Error error{source, 0, 0, "", "failed"};
    if (status == LUA_ERRMEM)
        error.cause = memoryCause(budgetOf(lua).limits);
    else if (lua_type(lua, -1) == LUA_TSTRING)
        error.cause = withoutPosition(lua_tostring(lua, -1), error.line);
    lua_pop(lua, 1);
    return error;
}

/// The same of what lua_load could not read: where Lua stood gives the column. It reads one byte beyond a token.
Error readingError(lua_State* lua, int status, const Feed& feed, const std::string& source) {
    const std::size_t length = nearLength(lua_type(lua, -1) == LUA_TSTRING ? lua_tostring(lua, -1) : "");
    Error error = takeError(lua, status, source);
    if (status != LUA_ERRSYNTAX) return error;
    const std::size_t before = feed.parts[0].size() + 1 + length;
    const TextPosition where = positionIn(feed.parts[1], feed.read > before ? feed.read - before : 0);
    error.line = where.line;
    error.column = where.column;
    if (const auto end = error.cause.find("<eof>"); end != std::string::npos) error.cause.replace(end, 5, "the end");
    return error;
}

Expected<void> refusePowers(std::string_view text, const std::string& source) {
    const auto found = findPower(text);
    if (!found) return {};
    const TextPosition where = positionIn(text, *found);
    return tl::unexpected(Error{source, where.line, where.column, "", "x^y is there for y = 2 alone; write pow(x, y)"});
}

LuaValue valueAt(lua_State* lua, int index) {
    switch (lua_type(lua, index)) {
        case LUA_TBOOLEAN:
            return lua_toboolean(lua, index) != 0;
        case LUA_TNUMBER:
            return static_cast<double>(lua_tonumber(lua, index));
        case LUA_TSTRING: {
            std::size_t size = 0;
            const char* const text = lua_tolstring(lua, index, &size);
            return std::string(text, size);
        }
        default:
            break;
    }
    LuaOther other{luaL_typename(lua, index), lua_touserdata(lua, index)};
    if (luaL_getmetafield(lua, index, "__name") == LUA_TSTRING) {
        other.type = lua_tostring(lua, -1);
        lua_pop(lua, 1);
    }
    return other;
}

}  // namespace

struct LuaSandbox::Interpreter {
    Budget budget;
    lua_State* lua = nullptr;
    int names = 0, variables = 0, environment = 0;  ///< tables in the registry
    std::size_t usedByText = 0;                     ///< memory at the end of the last piece of statements

    explicit Interpreter(const LuaLimits& limits) : budget{limits}, lua(lua_newstate(allocate, &budget)) {
        if (lua == nullptr) throw std::bad_alloc();
        makeTables();
    }
    Interpreter(const Interpreter&) = delete;
    Interpreter& operator=(const Interpreter&) = delete;
    ~Interpreter() { lua_close(lua); }

    /// Texts see an empty table that leads to the names and takes no assignment.
    void makeTables() {
        lua_newtable(lua);
        variables = luaL_ref(lua, LUA_REGISTRYINDEX);
        lua_newtable(lua);
        lua_newtable(lua);
        lua_rawgeti(lua, LUA_REGISTRYINDEX, variables);
        lua_pushcclosure(lua, findVariable, 1);
        lua_setfield(lua, -2, "__index");
        lua_setmetatable(lua, -2);
        names = luaL_ref(lua, LUA_REGISTRYINDEX);
        lua_newtable(lua);
        lua_newtable(lua);
        lua_rawgeti(lua, LUA_REGISTRYINDEX, names);
        lua_setfield(lua, -2, "__index");
        lua_pushcfunction(lua, refuseAssignment);
        lua_setfield(lua, -2, "__newindex");
        lua_setmetatable(lua, -2);
        environment = luaL_ref(lua, LUA_REGISTRYINDEX);
    }

    /// lua_load of text; leaves the function or the error.
    int read(Feed& feed) {
        if (budget.most == 0) budget.most = budget.used + budget.limits.memory;
        const Capped capped(budget);
        return lua_load(lua, nextByte, &feed, chunkName, "t");
    }

    int run() {
        const Capped capped(budget);
        return lua_pcall(lua, 0, 1, 0);
    }
};

LuaSandbox::LuaSandbox(const LuaLimits& limits) : interpreter_(std::make_unique<Interpreter>(limits)) {}
LuaSandbox::~LuaSandbox() = default;
LuaSandbox::LuaSandbox(LuaSandbox&&) noexcept = default;
LuaSandbox& LuaSandbox::operator=(LuaSandbox&&) noexcept = default;

lua_State* LuaSandbox::state() const { return interpreter_->lua; }

void LuaSandbox::addName(const char* name) {
    lua_State* const lua = interpreter_->lua;
    lua_rawgeti(lua, LUA_REGISTRYINDEX, interpreter_->names);
    lua_pushstring(lua, name);
    lua_pushvalue(lua, -3);
    lua_rawset(lua, -3);
    lua_pop(lua, 2);
}

void LuaSandbox::addVariable(const char* name, int (*function)(lua_State*)) {
    lua_pushcfunction(interpreter_->lua, function);
    addVariable(name);
}

void LuaSandbox::addVariable(const char* name) {
    lua_State* const lua = interpreter_->lua;
    lua_rawgeti(lua, LUA_REGISTRYINDEX, interpreter_->variables);
    lua_pushvalue(lua, -2);
    lua_setfield(lua, -2, name);
    lua_pop(lua, 2);
}

Expected<LuaSandbox::Expression> LuaSandbox::load(std::string_view text, const std::string& source) {
    lua_State* const lua = interpreter_->lua;
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
        return fail(source, "is empty; expected an expression");
    // What fits both frames is one expression: the first refuses what would close the brackets of the second, the
    // second refuses statements, lists and comments that never end.
    Feed plain{{"return ", text, ""}}, bracketed{{"return (", text, "\n)"}};
    if (const int status = interpreter_->read(plain); status != LUA_OK)
        return tl::unexpected(readingError(lua, status, plain, source));
    if (const int status = interpreter_->read(bracketed); status != LUA_OK) {
        Error error = readingError(lua, status, bracketed, source);
        if (status == LUA_ERRSYNTAX) error.cause = "is more than one expression";
        lua_pop(lua, 1);
        return tl::unexpected(error);
    }
    lua_pop(lua, 1);
    if (const auto portable = refusePowers(text, source); !portable) {
        lua_pop(lua, 1);
        return tl::unexpected(portable.error());
    }
    return Expression{luaL_ref(lua, LUA_REGISTRYINDEX)};
}

Expected<LuaValue> LuaSandbox::evaluate(Expression expression, const std::string& source) {
    lua_State* const lua = interpreter_->lua;
    lua_rawgeti(lua, LUA_REGISTRYINDEX, expression.reference);
    // A function in the text may have put something else in the environment's place.
    lua_rawgeti(lua, LUA_REGISTRYINDEX, interpreter_->environment);
    lua_setupvalue(lua, -2, 1);
    lua_sethook(lua, onTooMany, LUA_MASKCOUNT, interpreter_->budget.limits.instructions);
    const int status = interpreter_->run();
    if (status != LUA_OK) return tl::unexpected(takeError(lua, status, source));
    LuaValue value = valueAt(lua, -1);
    lua_pop(lua, 1);
    return value;
}

void LuaSandbox::forget(Expression expression) {
    luaL_unref(interpreter_->lua, LUA_REGISTRYINDEX, expression.reference);
}

Expected<LuaSandbox::Statements> LuaSandbox::loadStatements(std::string_view text, const std::string& source) {
    lua_State* const lua = interpreter_->lua;
    Feed feed{{"", text, ""}};
    if (const int status = interpreter_->read(feed); status != LUA_OK)
        return tl::unexpected(readingError(lua, status, feed, source));
    if (const auto portable = refusePowers(text, source); !portable) {
        lua_pop(lua, 1);
        return tl::unexpected(portable.error());
    }
    lua_rawgeti(lua, LUA_REGISTRYINDEX, interpreter_->environment);
    lua_setupvalue(lua, -2, 1);
    lua_State* const thread = lua_newthread(lua);
    lua_insert(lua, -2);
    lua_xmove(lua, thread, 1);
    interpreter_->usedByText = interpreter_->budget.used;
    return Statements{thread, luaL_ref(lua, LUA_REGISTRYINDEX), source};
}

Expected<bool> LuaSandbox::proceed(const Statements& statements, int given) {
    lua_State* const thread = statements.thread;
    Budget& budget = interpreter_->budget;
    budget.most += budget.used - interpreter_->usedByText;  // names that came are not the text's
    lua_sethook(thread, onTooManyHere, LUA_MASKCOUNT, budget.limits.instructions);
    int results = 0;
    const int status = [&] {
        const Capped capped(budget);
        return lua_resume(thread, nullptr, given, &results);
    }();
    interpreter_->usedByText = budget.used;
    if (status == LUA_OK || status == LUA_YIELD) return status == LUA_YIELD;
    Error error = takeError(thread, status, statements.source);
    if (error.line == 0) error.line = lineOf(statements);
    return tl::unexpected(error);
}

int LuaSandbox::lineOf(const Statements& statements) const {
    lua_Debug where{};
    for (int level = 0; lua_getstack(statements.thread, level, &where) != 0; ++level) {
        lua_getinfo(statements.thread, "l", &where);
        if (where.currentline > 0) return where.currentline;
    }
    return 0;
}

void LuaSandbox::forget(const Statements& statements) {
    luaL_unref(interpreter_->lua, LUA_REGISTRYINDEX, statements.reference);
}

}  // namespace mrose
