#include "scene/radio.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "scene/scene.h"

namespace mrose {

std::vector<std::uint32_t> teamsOf(const Scene& scene) {
    std::map<std::string_view, std::uint32_t> numbers;
    for (const SceneRobot& robot : scene.robots)
        if (!robot.team.empty()) numbers.emplace(robot.team, static_cast<std::uint32_t>(numbers.size()));
    std::vector<std::uint32_t> teams;
    for (const SceneRobot& robot : scene.robots)
        teams.push_back(numbers.empty() ? 0 : robot.team.empty() ? noTeam : numbers.at(robot.team));
    return teams;
}

}  // namespace mrose
