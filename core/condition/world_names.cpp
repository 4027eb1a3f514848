#include "condition/world_names.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <span>
#include <string>
#include <vector>

#include <lua.hpp>

namespace mrose {
namespace {

/// All userdata of a condition: what a name stands for. It never changes; only what it reads does.
struct Handle {
    enum class Kind : std::uint32_t { robot, object, wall, collection };
    Kind kind = Kind::collection;
    std::uint32_t body = 0;  ///< number in the world, of robots and objects
};

const WorldView& viewOf(lua_State* lua) { return **static_cast<const WorldView**>(lua_getextraspace(lua)); }

const RobotState& robot(const WorldView& view, std::uint32_t body) { return view.state->robots[body]; }
const ObjectState& object(const WorldView& view, std::uint32_t body) {
    return view.state->objects[body - view.state->robots.size()];
}

/// Whether any of what the last step reports fits; there was no last step at a run's start.
template <class Report, class Fits>
bool any(const WorldView& view, std::vector<Report> StepTrace::*reports, Fits fits) {
    return view.trace != nullptr && std::any_of((view.trace->*reports).begin(), (view.trace->*reports).end(), fits);
}

bool meet(const WorldView& view, std::uint32_t a, std::uint32_t b) {
    return any(view, &StepTrace::contacts, [&](const ContactReport& contact) {
        return (contact.bodyA == a && contact.bodyB == b) || (contact.bodyA == b && contact.bodyB == a);
    });
}

double touching(const WorldView& view, std::uint32_t body) {
    return any(view, &StepTrace::contacts,
               [&](const ContactReport& contact) { return contact.bodyA == body || contact.bodyB == body; });
}

double kicked(const WorldView& view, std::uint32_t body) {
    return any(view, &StepTrace::kicks, [&](const StepTrace::Kicked& kick) { return kick.robot == body; });
}

Command commandOf(const WorldView& view, std::uint32_t body) {
    return view.scenario->commandsOf(*view.state, body).at(view.scenario->scene().timeOf(view.state->tick));
}

/// Where the real robot is, and how far the simulated one is from there. Of no number all comparisons are false.
template <class Of>
double besideReal(const WorldView& view, std::uint32_t body, Of of) {
    const Scene& scene = view.scenario->scene();
    const auto real = (*view.real)(scene.robots[body].name, scene.timeOf(view.state->tick));
    return real ? of(*real, robot(view, body).pose) : std::numeric_limits<double>::quiet_NaN();
}

struct Field {
    enum class Kind : std::uint8_t {
        number,
        flag,  ///< true or false
        real   ///< a number that a real log tells
    };
    const char* name;
    double (*read)(const WorldView& view, std::uint32_t body);
    Kind kind = Kind::number;
};

constexpr Field robotFields[] = {
    {"x", [](const WorldView& view, std::uint32_t i) { return robot(view, i).pose.x; }},
    {"y", [](const WorldView& view, std::uint32_t i) { return robot(view, i).pose.y; }},
    {"heading", [](const WorldView& view, std::uint32_t i) { return wrapAngle(robot(view, i).pose.heading); }},
    {"v", [](const WorldView& view, std::uint32_t i) { return robot(view, i).velocity_B.x; }},
    {"w", [](const WorldView& view, std::uint32_t i) { return robot(view, i).velocity_B.rotation; }},
    {"speed",
     [](const WorldView& view, std::uint32_t i) {
         return length({robot(view, i).velocity_B.x, robot(view, i).velocity_B.y});
     }},
    {"command_v", [](const WorldView& view, std::uint32_t i) { return commandOf(view, i).v; }},
    {"command_w", [](const WorldView& view, std::uint32_t i) { return commandOf(view, i).w; }},
    {"touching", touching, Field::Kind::flag},
    {"kicked", kicked, Field::Kind::flag},
    {"error",
     [](const WorldView& view, std::uint32_t i) {
         return besideReal(view, i, [](const Pose& real, const Pose& simulated) {
             return std::hypot(simulated.x - real.x, simulated.y - real.y);
         });
     },
     Field::Kind::real},
    {"heading_error",
     [](const WorldView& view, std::uint32_t i) {
         return besideReal(view, i, [](const Pose& real, const Pose& simulated) {
             return std::abs(wrapAngle(simulated.heading - real.heading));
         });
     },
     Field::Kind::real},
    {"real_x",
     [](const WorldView& view, std::uint32_t i) {
         return besideReal(view, i, [](const Pose& real, const Pose&) { return real.x; });
     },
     Field::Kind::real},
    {"real_y",
     [](const WorldView& view, std::uint32_t i) {
         return besideReal(view, i, [](const Pose& real, const Pose&) { return real.y; });
     },
     Field::Kind::real},
    {"real_heading",
     [](const WorldView& view, std::uint32_t i) {
         return besideReal(view, i, [](const Pose& real, const Pose&) { return wrapAngle(real.heading); });
     },
     Field::Kind::real},
};
/// Persons drive by no log: theirs are those before.
constexpr std::span<const Field> personFields{
    robotFields, std::find_if(std::begin(robotFields), std::end(robotFields),
                              [](const Field& field) { return field.kind == Field::Kind::real; })};

constexpr Field objectFields[] = {
    {"x", [](const WorldView& view, std::uint32_t i) { return object(view, i).pose.x; }},
    {"y", [](const WorldView& view, std::uint32_t i) { return object(view, i).pose.y; }},
    {"heading", [](const WorldView& view, std::uint32_t i) { return wrapAngle(object(view, i).pose.heading); }},
    {"vx", [](const WorldView& view, std::uint32_t i) { return object(view, i).velocity_W.x; }},
    {"vy", [](const WorldView& view, std::uint32_t i) { return object(view, i).velocity_W.y; }},
    {"w", [](const WorldView& view, std::uint32_t i) { return object(view, i).velocity_W.rotation; }},
    {"speed",
     [](const WorldView& view, std::uint32_t i) {
         return length({object(view, i).velocity_W.x, object(view, i).velocity_W.y});
     }},
    {"touching", touching, Field::Kind::flag},
};

/// A text that outlives a scenario may keep a body that the next one does not have.
void checkThere(lua_State* lua, const Handle& handle) {
    const WorldState& state = *viewOf(lua).state;
    const std::size_t robots = state.robots.size();
    const bool there = handle.kind == Handle::Kind::robot
                           ? handle.body < robots
                           : handle.body >= robots && handle.body < robots + state.objects.size();
    if (handle.kind != Handle::Kind::wall && !there) luaL_error(lua, "this body is of another scenario");
}

/// __index of bodies; upvalue 1 has their fields' indices by name, 2 is the array of Field, 3 what they are and have.
int readField(lua_State* lua) {
    const Handle& handle = *static_cast<const Handle*>(lua_touserdata(lua, 1));
    lua_pushvalue(lua, 2);
    if (lua_rawget(lua, lua_upvalueindex(1)) != LUA_TNUMBER)
        return luaL_error(lua, "there is no '%s': %s", luaL_tolstring(lua, 2, nullptr),
                          lua_tostring(lua, lua_upvalueindex(3)));
    const auto* const fields = static_cast<const Field*>(lua_touserdata(lua, lua_upvalueindex(2)));
    const Field& field = fields[lua_tointeger(lua, -1)];
    checkThere(lua, handle);
    const WorldView& view = viewOf(lua);
    if (field.kind == Field::Kind::real && (view.real == nullptr || !*view.real))
        return luaL_error(lua, "'%s' needs a real log beside the run: none is open", field.name);
    const double value = field.read(view, handle.body);
    if (field.kind == Field::Kind::flag)
        lua_pushboolean(lua, value != 0);
    else
        lua_pushnumber(lua, value);
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

/// The same of goals: members are their numbers from 0, and what is read is the balls in them.
int readGoal(lua_State* lua) {
    readMember(lua);
    lua_pushinteger(lua, viewOf(lua).state->goals[static_cast<std::size_t>(lua_tointeger(lua, -1))]);
    return 1;
}

/// The argument as a body.
Handle bodyAt(lua_State* lua, int index, bool wallToo) {
    const auto* const handle = static_cast<const Handle*>(lua_touserdata(lua, index));
    if (handle == nullptr || handle->kind == Handle::Kind::collection ||
        (handle->kind == Handle::Kind::wall && !wallToo)) {
        luaL_argerror(
            lua, index,
            wallToo ? "expected a robot, a person, an object or wall" : "expected a robot, a person or an object");
        return {};  // not reached
    }
    checkThere(lua, *handle);
    return *handle;
}

const Pose& poseAt(lua_State* lua, int index) {
    return Scenario::poseOf(*viewOf(lua).state, bodyAt(lua, index, false).body);
}

int distanceBetween(lua_State* lua) {
    lua_pushnumber(lua, distance(position(poseAt(lua, 1)), position(poseAt(lua, 2))));
    return 1;
}

int bearing(lua_State* lua) {
    const Pose &from = poseAt(lua, 1), &to = poseAt(lua, 2);
    lua_pushnumber(lua, wrapAngle(std::atan2(to.y - from.y, to.x - from.x) - from.heading));
    return 1;
}

int wrap(lua_State* lua) {
    lua_pushnumber(lua, wrapAngle(luaL_checknumber(lua, 1)));
    return 1;
}

int touchingBodies(lua_State* lua) {
    const Handle a = bodyAt(lua, 1, true), b = bodyAt(lua, 2, true);
    lua_pushboolean(lua, static_cast<int>(meet(viewOf(lua), a.body, b.body)));
    return 1;
}

int pushTime(lua_State* lua) {
    const WorldView& view = viewOf(lua);
    lua_pushnumber(lua, toSeconds(view.scenario->scene().timeOf(view.state->tick)));
    return 1;
}

int pushTick(lua_State* lua) {
    lua_pushinteger(lua, viewOf(lua).state->tick);
    return 1;
}

int pushSeed(lua_State* lua) {
    lua_pushinteger(lua, static_cast<lua_Integer>(viewOf(lua).state->seed));
    return 1;
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
        makeBodyMetatable("robot", "a robot", robotFields);
        makeBodyMetatable("person", "a person", personFields);
        makeBodyMetatable("object", "an object", objectFields);
        addRobots({"robot", "robot", "robots"}, false);
        addRobots({"person", "person", "persons"}, true);
        addObjects();
        addGoals();
        pushHandle(lua_, Handle::Kind::wall, noBody);
        nameType("wall");
        sandbox_.addName("wall");
        for (const auto& [name, function] : {luaL_Reg{"distance", distanceBetween},
                                             {"bearing", bearing},
                                             {"wrap", wrap},
                                             {"touching", touchingBodies}}) {
            lua_pushcfunction(lua_, function);
            sandbox_.addName(name);
        }
        sandbox_.addVariable("time", pushTime);
        sandbox_.addVariable("tick", pushTick);
        sandbox_.addVariable("seed", pushSeed);
    }

private:
    void makeBodyMetatable(const char* type, const std::string& subject, std::span<const Field> fields) {
        luaL_newmetatable(lua_, type);
        lua_newtable(lua_);
        std::string have = subject + " has ";
        for (std::size_t i = 0; i < fields.size(); ++i) {
            lua_pushinteger(lua_, static_cast<lua_Integer>(i));
            lua_setfield(lua_, -2, fields[i].name);
            have += (i == 0 ? "" : ", ") + std::string(fields[i].name);
        }
        lua_pushlightuserdata(lua_, const_cast<Field*>(fields.data()));
        lua_pushstring(lua_, have.c_str());
        lua_pushcclosure(lua_, readField, 3);
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
    void addCollection(const Words& words, const std::vector<std::string>& names, lua_CFunction read,
                       const std::string& numbers = {}) {
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
        lua_pushcclosure(lua_, read, 4);
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
            // Persons stand behind all robots, and nobody leaves one out.
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

    void addGoals() {
        lua_newtable(lua_);
        std::vector<std::string> names;
        const std::vector<Goal>& goals = scene_.environment.goals;
        for (std::size_t i = 0; i < goals.size(); ++i) {
            lua_pushinteger(lua_, static_cast<lua_Integer>(i));
            names.push_back(goals[i].name);
            addMember(names.size(), names.back());
        }
        addCollection({"goals", "goal", "goals"}, names, readGoal);
    }

    LuaSandbox& sandbox_;
    lua_State* lua_;
    const Scene& scene_;
};

}  // namespace

void addWorldNames(LuaSandbox& sandbox, const Scenario& scenario, const WorldView& view) {
    *static_cast<const WorldView**>(lua_getextraspace(sandbox.state())) = &view;
    NamesWriter(sandbox, scenario).write();
}

}  // namespace mrose
