#include "condition/world_names.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include <lua.hpp>

#include "quantities/catalogue.h"
#include "quantities/part.h"

namespace mrose {
namespace {

/// All userdata of a condition: what a name stands for. It never changes; only what it reads does.
struct Handle {
    enum class Kind : std::uint32_t { robot, object, wall, collection, items };
    Kind kind = Kind::collection;
    std::uint32_t body = noBody;         ///< number in the world, of robots and objects
    const Quantity* quantity = nullptr;  ///< of items
    std::uint32_t part = noBody;         ///< of items that a part remembers
};

const WorldView& viewOf(lua_State* lua) { return **static_cast<const WorldView**>(lua_getextraspace(lua)); }

/// Pushes what a quantity gives; an error where the moment does not have what it needs.
int pushValue(lua_State* lua, const Quantity& quantity, const Subject& subject) {
    if (quantity.needs == Quantity::Needs::real && subject.at.real == nullptr)
        return luaL_error(lua, "'%s' needs a real log beside the run: none is open", quantity.name);
    const bool remembered = &quantity == &partQuantity() && subject.other < firstSensorPart;
    if (quantity.needs == Quantity::Needs::control && subject.at.insights.empty() && !remembered)
        return luaL_error(lua, "what robots saw, decided and remember is not known here: its name must be written out");
    if (const auto* const number = std::get_if<double (*)(const Subject&)>(&quantity.read)) {
        lua_pushnumber(lua, (*number)(subject));
    } else if (const auto* const truth = std::get_if<bool (*)(const Subject&)>(&quantity.read)) {
        lua_pushboolean(lua, static_cast<int>((*truth)(subject)));
    } else if (const auto* const count = std::get_if<std::int64_t (*)(const Subject&)>(&quantity.read)) {
        lua_pushinteger(lua, (*count)(subject));
    } else {
        double value = 0;
        bool text = false;
        {
            QuantityValue read = quantity.value(subject);
            text = std::holds_alternative<std::string>(read);
            if (text)
                viewOf(lua).text = std::move(std::get<std::string>(read));
            else
                value = numberOf(read);
        }
        if (text)
            lua_pushlstring(lua, viewOf(lua).text.data(), viewOf(lua).text.size());
        else
            lua_pushnumber(lua, value);
    }
    return 1;
}

const Quantity& quantityIn(lua_State* lua, int index) {
    return *static_cast<const Quantity*>(lua_touserdata(lua, index));
}

/// A text that outlives a scenario may keep a body that the next one does not have.
void checkThere(lua_State* lua, const Handle& handle) {
    const WorldState& state = *viewOf(lua).at.state;
    const std::size_t robots = state.robots.size();
    const bool there = handle.kind == Handle::Kind::object
                           ? handle.body >= robots && handle.body < robots + state.objects.size()
                           : handle.body < robots;
    if (handle.kind != Handle::Kind::wall && !there) luaL_error(lua, "this body is of another scenario");
}

/// The items of a quantity, or the memory of a part.
int pushItems(lua_State* lua, std::uint32_t body, const Quantity& quantity, std::uint32_t part) {
    new (lua_newuserdatauv(lua, sizeof(Handle), 0)) Handle{Handle::Kind::items, body, &quantity, part};
    luaL_setmetatable(lua, "items");
    return 1;
}

/// The place of a body's part of the name at index 2; noBody: it has none.
std::uint32_t partAt(lua_State* lua, std::uint32_t body) {
    if (lua_type(lua, 2) != LUA_TSTRING) return noBody;
    const auto part = partNamed(*viewOf(lua).at.scenario, body, lua_tostring(lua, 2));
    return part ? static_cast<std::uint32_t>(*part) : noBody;
}

/// What is said of a name that a body does not have.
const char* whatThereIs(lua_State* lua, const Handle& handle, const char* written) {
    const WorldView& view = viewOf(lua);
    const Scene& scene = view.at.scene();
    const bool robot = handle.body < scene.robots.size();
    view.text = !robot ? "an object" : scene.typeOf(handle.body).person ? "a person" : "a robot";
    view.text += " has " + nearestNames(written, quantityNames(*view.at.scenario, handle.body));
    return view.text.c_str();
}

/// __index of bodies; upvalue 1 has their quantities by name.
int readQuantity(lua_State* lua) {
    const Handle& handle = *static_cast<const Handle*>(lua_touserdata(lua, 1));
    checkThere(lua, handle);
    lua_pushvalue(lua, 2);
    if (lua_rawget(lua, lua_upvalueindex(1)) == LUA_TLIGHTUSERDATA) {
        const Quantity& quantity = quantityIn(lua, -1);
        if (quantity.of == Quantity::Of::items) return pushItems(lua, handle.body, quantity, noBody);
        return pushValue(lua, quantity, {viewOf(lua).at, handle.body});
    }
    const std::uint32_t part = handle.kind == Handle::Kind::wall ? noBody : partAt(lua, handle.body);
    if (part != noBody) return pushItems(lua, handle.body, partQuantity(), part);
    const char* const written = luaL_tolstring(lua, 2, nullptr);
    return luaL_error(lua, "there is no '%s': %s", written, whatThereIs(lua, handle, written));
}

/// The items that a body can have; nullopt: that is not known.
std::optional<std::vector<std::string>> itemsOf(const Quantity& quantity, const Subject& subject) {
    if (&quantity == &partQuantity()) {
        std::vector<std::string> names;
        for (const MemoryEntry& entry : knownEntries(subject.at, subject.body, subject.other))
            names.push_back(entry.name);
        return names.empty() ? std::nullopt : std::optional(std::move(names));
    }
    if (quantity.itemsChange) return std::nullopt;
    std::vector<std::string> names;
    for (const Quantity::Item& item : quantity.items(subject)) names.push_back(item.name);
    return names;
}

/// Whether there cannot be such an item; then what there is lies in the view's text.
bool lacksItem(const WorldView& view, const Quantity& quantity, const Subject& subject) {
    const auto items = itemsOf(quantity, subject);
    if (!items || std::find(items->begin(), items->end(), subject.item) != items->end()) return false;
    view.text = items->empty() ? "it has none" : "it has ";
    for (const std::string& item : *items) view.text += (&item == items->data() ? "'" : ", '") + item + '\'';
    return true;
}

/// Of what has items: its quantity, or the part. In the memory of Lua, where it stays as long as it is needed.
const char* nameOf(lua_State* lua, const Handle& handle) {
    if (handle.quantity != &partQuantity()) return handle.quantity->name;
    return lua_pushstring(lua, partNames(*viewOf(lua).at.scenario, handle.body)[handle.part].c_str());
}

/// __index of items.
int readItem(lua_State* lua) {
    const Handle& handle = *static_cast<const Handle*>(lua_touserdata(lua, 1));
    checkThere(lua, handle);
    std::size_t size = 0;
    const char* const name = luaL_checklstring(lua, 2, &size);
    const Subject subject{viewOf(lua).at, handle.body, handle.part, {name, size}};
    pushValue(lua, *handle.quantity, subject);
    const bool known = lua_type(lua, -1) != LUA_TNUMBER || !std::isnan(lua_tonumber(lua, -1));
    if (!known && lacksItem(viewOf(lua), *handle.quantity, subject))
        return luaL_error(lua, "there is no '%s' in '%s': %s", name, nameOf(lua, handle), viewOf(lua).text.c_str());
    return 1;
}

/// ", called a, b ..."; nothing where there are none.
std::string listed(const std::vector<std::string>& names) {
    constexpr std::size_t most = 12;
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
        text += (i == 0 ? ", called '" : ", '") + names[i] + '\'';
    return names.size() > most ? text + " ..." : text;
}

/// __len of collections; upvalue 1 is the number.
int countMembers(lua_State* lua) {
    lua_pushvalue(lua, lua_upvalueindex(1));
    return 1;
}

/// __index of collections; upvalue 1 has the members by number and name, 2 says what one is, 3 how many there are, 4
/// their names.
int readMember(lua_State* lua) {
    lua_pushvalue(lua, 2);
    if (lua_rawget(lua, lua_upvalueindex(1)) != LUA_TNIL) return 1;
    const bool named = lua_type(lua, 2) == LUA_TSTRING;
    return luaL_error(lua, named ? "there is no %s '%s': %s%s" : "there is no %s %s: %s%s",
                      lua_tostring(lua, lua_upvalueindex(2)), luaL_tolstring(lua, 2, nullptr),
                      lua_tostring(lua, lua_upvalueindex(3)), named ? lua_tostring(lua, lua_upvalueindex(4)) : "");
}

/// The same of goals: members are their numbers from 0; upvalue 5 is what is read of them.
int readGoal(lua_State* lua) {
    readMember(lua);
    const auto goal = static_cast<std::uint32_t>(lua_tointeger(lua, -1));
    return pushValue(lua, quantityIn(lua, lua_upvalueindex(5)), {viewOf(lua).at, goal});
}

/// The argument as a body.
std::uint32_t bodyAt(lua_State* lua, int index, Quantity::Of of) {
    const auto* const handle = static_cast<const Handle*>(lua_touserdata(lua, index));
    const bool wallToo = of == Quantity::Of::touchingPair, robot = of == Quantity::Of::seenPair && index == 1;
    const auto is = [&](Handle::Kind kind) { return handle != nullptr && handle->kind == kind; };
    if (!is(Handle::Kind::robot) && (robot || !is(Handle::Kind::object)) && (!wallToo || !is(Handle::Kind::wall)))
        luaL_argerror(lua, index,
                      robot     ? "expected a robot or a person"
                      : wallToo ? "expected a robot, a person, an object or wall"
                                : "expected a robot, a person or an object");
    checkThere(lua, *handle);
    return handle->body;
}

/// A function of two bodies; upvalue 1 is the quantity.
int readPair(lua_State* lua) {
    const Quantity& quantity = quantityIn(lua, lua_upvalueindex(1));
    const std::uint32_t first = bodyAt(lua, 1, quantity.of), second = bodyAt(lua, 2, quantity.of);
    // Between two of what stands still nothing is known.
    return pushValue(lua, quantity, {viewOf(lua).at, first, second});
}

/// A variable of the run; upvalue 1 is the quantity.
int readOfRun(lua_State* lua) { return pushValue(lua, quantityIn(lua, lua_upvalueindex(1)), {viewOf(lua).at}); }

/// A value of a trial by its name, at index 2; `what` it is.
int pushTrialValue(lua_State* lua, const DrawnValues& values, const char* what) {
    const WorldView& view = viewOf(lua);
    const char* const name = luaL_tolstring(lua, 2, nullptr);
    for (const DrawnValue& one : values) {
        if (one.name != name) continue;
        if (const double* const number = one.value.asFloat()) return lua_pushnumber(lua, *number), 1;
        if (const std::int64_t* const whole = one.value.asInteger())
            return lua_pushnumber(lua, static_cast<double>(*whole)), 1;
        if (const bool* const truth = one.value.asBoolean()) return lua_pushboolean(lua, static_cast<int>(*truth)), 1;
        if (const std::string* const text = one.value.asText())
            return lua_pushlstring(lua, text->data(), text->size()), 1;
        return luaL_error(lua, "%s '%s' is neither a number nor a text", what, name);
    }
    view.text = values.empty() ? "there is none" : "there are ";
    for (const DrawnValue& one : values) view.text += (&one == values.data() ? "'" : ", '") + one.name + '\'';
    return luaL_error(lua, "there is no %s '%s': %s", what, name, view.text.c_str());
}

/// __index of `draw`: what was drawn for the trial.
int readDrawn(lua_State* lua) {
    const DrawnValues* const drawn = viewOf(lua).at.drawnValues();
    if (drawn == nullptr) return luaL_error(lua, "'draw' is known in experiments alone");
    return pushTrialValue(lua, *drawn, "draw");
}

/// __index of `measure`: what it gave.
int readMeasured(lua_State* lua) {
    const DrawnValues* const measured = viewOf(lua).at.measured;
    if (measured == nullptr) return luaL_error(lua, "'measure' is known in measures at a trial's end alone");
    return pushTrialValue(lua, *measured, "measure above");
}

int noBall(lua_State* lua) { return luaL_error(lua, "there is no ball: no object rolls"); }

void pushHandle(lua_State* lua, Handle::Kind kind, std::uint32_t body) {
    new (lua_newuserdatauv(lua, sizeof(Handle), 0)) Handle{kind, body};
}

class NamesWriter {
public:
    NamesWriter(LuaSandbox& sandbox, const Scenario& scenario)
        : sandbox_(sandbox), lua_(sandbox.state()), scene_(scenario.scene()) {}

    void write() {
        addBodyType("robot", [](const Quantity& q) { return q.of != Quantity::Of::object; });
        addBodyType("person",
                    [](const Quantity& q) { return q.of != Quantity::Of::object && q.needs != Quantity::Needs::real; });
        addBodyType("object",
                    [](const Quantity& q) { return q.of == Quantity::Of::object || q.of == Quantity::Of::body; });
        luaL_newmetatable(lua_, "items");
        lua_pushcfunction(lua_, readItem);
        lua_setfield(lua_, -2, "__index");
        lua_pop(lua_, 1);
        addRobots({"robot", "robot", "robots"}, false);
        addRobots({"person", "person", "persons"}, true);
        addObjects();
        for (const Quantity& quantity : quantities())
            if (quantity.of == Quantity::Of::goal) addGoals(quantity);
        pushHandle(lua_, Handle::Kind::wall, noBody);
        nameType("wall");
        sandbox_.addName("wall");
        addTrialValues("draw", readDrawn);
        addTrialValues("measure", readMeasured);
        for (const Quantity& quantity : quantities())
            if (quantity.isPair() || quantity.of == Quantity::Of::run) {
                lua_pushlightuserdata(lua_, const_cast<Quantity*>(&quantity));
                lua_pushcclosure(lua_, quantity.isPair() ? readPair : readOfRun, 1);
                quantity.isPair() ? sandbox_.addName(quantity.name) : sandbox_.addVariable(quantity.name);
            }
    }

private:
    /// A metatable with what `fits` a kind of body.
    template <class Fits>
    void addBodyType(const char* type, Fits fits) {
        luaL_newmetatable(lua_, type);
        lua_newtable(lua_);
        for (const Quantity& quantity : quantities())
            if (quantity.isOfBody() && fits(quantity)) {
                lua_pushlightuserdata(lua_, const_cast<Quantity*>(&quantity));
                lua_setfield(lua_, -2, quantity.name);
            }
        lua_pushcclosure(lua_, readQuantity, 1);
        lua_setfield(lua_, -2, "__index");
        lua_pop(lua_, 1);
    }

    /// Gives what is on top of the stack a metatable that holds its name, for messages, and nothing else.
    void nameType(const char* name) {
        luaL_newmetatable(lua_, name);
        lua_setmetatable(lua_, -2);
    }

    /// Puts what is on top of the stack into the table below it, by number from 1 and by name; takes it.
    void addMember(std::size_t number, const std::string& name) {
        lua_pushvalue(lua_, -1);
        lua_rawseti(lua_, -3, static_cast<lua_Integer>(number));
        lua_pushlstring(lua_, name.data(), name.size());
        lua_insert(lua_, -2);
        lua_rawset(lua_, -3);
    }

    struct Words {
        const char *name, *one, *many;
    };

    /// A name for the table of members on top of the stack, which it takes.
    /// `numbers`: of the members, where others are left out; empty: all are there.
    /// `quantity`: what is read of a member.
    void addCollection(const Words& words, const std::vector<std::string>& names, lua_CFunction read,
                       const std::string& numbers = {}, const Quantity* quantity = nullptr) {
        const std::size_t count = names.size();
        const std::string many = words.many, number = count == 0 ? "no" : std::to_string(count);
        pushHandle(lua_, Handle::Kind::collection, 0);
        luaL_newmetatable(lua_, ("list of " + many).c_str());
        lua_pushvalue(lua_, -3);
        lua_pushstring(lua_, words.one);
        const std::string there =
            count == 1        ? "there is " + (numbers.empty() ? "1 " + std::string(words.one) : words.one + numbers)
            : numbers.empty() ? "there are " + number + ' ' + many
                              : "there are " + many + numbers;
        lua_pushstring(lua_, there.c_str());
        lua_pushstring(lua_, listed(names).c_str());
        lua_pushlightuserdata(lua_, const_cast<Quantity*>(quantity));
        lua_pushcclosure(lua_, read, 5);
        lua_setfield(lua_, -2, "__index");
        lua_pushinteger(lua_, static_cast<lua_Integer>(count));
        lua_pushcclosure(lua_, countMembers, 1);
        lua_setfield(lua_, -2, "__len");
        lua_setmetatable(lua_, -2);
        sandbox_.addName(words.name);
        lua_pop(lua_, 1);
    }

    void addRobots(const Words& words, bool persons) {
        lua_newtable(lua_);
        std::vector<std::string> names;
        std::string numbers;
        bool gaps = false;
        for (std::uint32_t i = 0; i < scene_.robots.size(); ++i) {
            if (scene_.typeOf(i).person != persons) continue;
            pushHandle(lua_, Handle::Kind::robot, i);
            luaL_setmetatable(lua_, words.name);
            names.push_back(scene_.robots[i].name);
            // Persons come after all robots, and are never left out.
            const std::size_t number = persons ? names.size() : scene_.placeOf(i) + 1;
            addMember(number, names.back());
            gaps = gaps || number != names.size();
            numbers += (names.size() == 1 ? " " : ", ") + std::to_string(number);
        }
        addCollection(words, names, readMember, gaps ? numbers : std::string());
    }

    void addObjects() {
        lua_newtable(lua_);
        std::vector<std::string> names;
        bool ball = false;
        for (std::uint32_t i = 0; i < scene_.objects.size(); ++i) {
            pushHandle(lua_, Handle::Kind::object, static_cast<std::uint32_t>(scene_.robots.size()) + i);
            luaL_setmetatable(lua_, "object");
            if (!ball && scene_.typeOfObject(i).rolls) {
                ball = true;
                lua_pushvalue(lua_, -1);
                sandbox_.addName("ball");
            }
            names.push_back(scene_.objects[i].name);
            addMember(names.size(), names.back());
        }
        if (!ball) {
            lua_pushnil(lua_);
            sandbox_.addName("ball");
            sandbox_.addVariable("ball", noBall);
        }
        addCollection({"object", "object", "objects"}, names, readMember);
    }

    void addTrialValues(const char* name, lua_CFunction read) {
        pushHandle(lua_, Handle::Kind::collection, 0);
        luaL_newmetatable(lua_, name);
        lua_pushcfunction(lua_, read);
        lua_setfield(lua_, -2, "__index");
        lua_setmetatable(lua_, -2);
        sandbox_.addName(name);
    }

    void addGoals(const Quantity& quantity) {
        lua_newtable(lua_);
        std::vector<std::string> names;
        const std::vector<Goal>& goals = scene_.environment.goals;
        for (std::size_t i = 0; i < goals.size(); ++i) {
            lua_pushinteger(lua_, static_cast<lua_Integer>(i));
            names.push_back(goals[i].name);
            addMember(names.size(), names.back());
        }
        addCollection({quantity.name, "goal", "goals"}, names, readGoal, {}, &quantity);
    }

    LuaSandbox& sandbox_;
    lua_State* lua_;
    const Scene& scene_;
};

}  // namespace

std::optional<std::uint32_t> bodyOf(const LuaValue& value) {
    const auto* const other = std::get_if<LuaOther>(&value);
    const auto* const handle = other != nullptr ? static_cast<const Handle*>(other->data) : nullptr;
    if (handle == nullptr || handle->kind == Handle::Kind::collection || handle->kind == Handle::Kind::items)
        return std::nullopt;
    return handle->body;
}

void addWorldNames(LuaSandbox& sandbox, const Scenario& scenario, const WorldView& view) {
    *static_cast<const WorldView**>(lua_getextraspace(sandbox.state())) = &view;
    NamesWriter(sandbox, scenario).write();
}

}  // namespace mrose
