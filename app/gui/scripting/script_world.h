#pragma once

#include <string>

#include "condition/world_names.h"
#include "debug/field_frame.h"
#include "scripting/scripted_window.h"

namespace mrose::gui {

/// What the names of a script stand for: the shown state, with those of conditions, and the window's own (branch,
/// branches, playing, selected, message).
class ScriptWorld {
public:
    ScriptWorld(LuaSandbox& sandbox, const ScriptedWindow& window);
    ScriptWorld(const ScriptWorld&) = delete;
    ScriptWorld& operator=(const ScriptWorld&) = delete;

    /// Looks at what is shown now. Not while Lua runs.
    void update();

    struct View : WorldView {
        std::string branch, selected, message;
        int branches = 0;
        bool playing = false;
    };

private:
    LuaSandbox& sandbox_;
    const ScriptedWindow& window_;
    View view_;
    std::shared_ptr<const FieldFrame> frame_;
    std::string bodies_;  ///< for which the names are
};

}  // namespace mrose::gui
