#include "recording/body_names.h"

#include <set>
#include <string_view>

namespace mrose {
namespace {

std::string plain(std::string_view name) {
    constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    std::string text(name);
    for (char& c : text)
        if (allowed.find(c) == std::string_view::npos) c = '_';
    return text;
}

}  // namespace

std::vector<std::string> bodyNames(const Scene& scene) {
    std::vector<std::string> names;
    std::set<std::string> taken{"world"};
    const auto add = [&](const std::string& name, const char* kind) {
        const std::string base = name.empty() ? kind : plain(name);
        std::string unique = base;
        for (int k = 2; !taken.insert(unique).second; ++k) unique = base + '_' + std::to_string(k);
        names.push_back(unique);
    };
    for (const SceneRobot& robot : scene.robots) add(robot.name, "robot");
    for (const SceneObject& object : scene.objects) add(object.name, "object");
    return names;
}

}  // namespace mrose
