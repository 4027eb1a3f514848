#include "scripting/script_world.h"

#include <lua.hpp>

#include "frame/status_line.h"
#include "script/lua_math.h"
#include "widgets/field_view.h"

namespace mrose::gui {
namespace {

const ScriptWorld::View& shownIn(lua_State* lua) {
    return *static_cast<const ScriptWorld::View*>(*static_cast<const WorldView**>(lua_getextraspace(lua)));
}

template <std::string ScriptWorld::View::*text>
int pushText(lua_State* lua) {
    lua_pushstring(lua, (shownIn(lua).*text).c_str());
    return 1;
}

int pushBranches(lua_State* lua) {
    lua_pushinteger(lua, shownIn(lua).branches);
    return 1;
}

int pushPlaying(lua_State* lua) {
    lua_pushboolean(lua, static_cast<int>(shownIn(lua).playing));
    return 1;
}

/// Distinguishes worlds with other bodies and goals.
std::string bodiesOf(const Scene& scene) {
    std::string all;
    for (std::size_t i = 0; i < scene.robots.size(); ++i)
        all += scene.robots[i].name + (scene.typeOf(i).person ? "\tperson\n" : "\trobot\n");
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        all += scene.objects[i].name + (scene.typeOfObject(i).rolls ? "\tball\n" : "\tobject\n");
    for (const Goal& goal : scene.environment.goals) all += goal.name + "\tgoal\n";
    return all;
}

}  // namespace

ScriptWorld::ScriptWorld(LuaSandbox& sandbox, const ScriptedWindow& window) : sandbox_(sandbox), window_(window) {
    addMath(sandbox_);
    sandbox_.addVariable("branch", pushText<&View::branch>);
    sandbox_.addVariable("branches", pushBranches);
    sandbox_.addVariable("playing", pushPlaying);
    sandbox_.addVariable("selected", pushText<&View::selected>);
    sandbox_.addVariable("message", pushText<&View::message>);
    *static_cast<const WorldView**>(lua_getextraspace(sandbox.state())) = &view_;
    update();
}

void ScriptWorld::update() {
    const Shown* shown = window_.frame.shown();
    if (shown == nullptr) return;
    frame_ = shown->frame;
    view_.at = frame_->moment();
    view_.branch = shown->branch == 0 ? "the run" : shown->branches[shown->branch].name;
    view_.branches = listedBranches(shown->branches);
    view_.playing = shown->playing;
    view_.message = window_.frame.status.said().toStdString();
    const std::optional<std::size_t> body = window_.field.selected();
    view_.selected = body && *body < frame_->scene().bodyCount() ? frame_->nameOf(*body) : "";
    std::string bodies = bodiesOf(frame_->scene());
    if (bodies == bodies_) return;
    addWorldNames(sandbox_, *frame_->scenario, view_);
    bodies_ = std::move(bodies);
}

}  // namespace mrose::gui
