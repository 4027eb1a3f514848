#include "robot_traits.h"

#include "workflow/resources.h"

namespace mrose::cli {
namespace {

/// What a robot file says, as it is given or among those that ship; nullopt where there is none.
Expected<std::optional<RobotKind>> kindOfFile(const std::string& name) {
    DiskDescriptions source = openDescriptions();
    for (const std::string& place : {name, joinedName(std::string(shippedPrefix) + "resources/robots/", name)}) {
        const auto text = source.text(place);
        if (!text) return tl::unexpected(text.error());
        if (!*text) continue;
        auto kind = parseRobotKind(**text, name, source.shown(place));
        if (kind && !*kind)
            return fail(source.shown(place), "has no section [kind], which says what is to be known of such robots");
        return kind;
    }
    return std::nullopt;
}

}  // namespace

Expected<RobotTraits> traitsOf(const std::string& type, const Log& log) {
    const auto kinds = robotKinds();
    if (!kinds) return tl::unexpected(kinds.error());
    const RobotKind* const kind = type.empty() ? kindOfLog(*kinds, log) : kindNamed(*kinds, type);
    if (kind != nullptr) return kind->traits;
    if (type.empty()) return RobotTraits{"robot", {}, 0, false};
    const auto ofFile = kindOfFile(type);
    if (!ofFile) return tl::unexpected(ofFile.error());
    if (*ofFile) return (*ofFile)->traits;
    std::string names;
    for (const RobotKind& known : *kinds) names += known.traits.type + ", ";
    return fail("", "is no kind of robot; expected " + names + "or a robot file", 0, "--type " + type);
}

}  // namespace mrose::cli
