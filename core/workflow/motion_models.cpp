#include "workflow/motion_models.h"

#include <algorithm>
#include <filesystem>

#include "workflow/resources.h"

namespace mrose {
namespace {

/// Network files that ship, by name.
std::vector<std::filesystem::path> networksThatShip() {
    std::vector<std::filesystem::path> files;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(resourceFolder() / "nets", ignored))
        if (entry.path().extension() == ".net") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

bool isOfTheirType(const MotionNetwork& network, const LogWorld& world) {
    for (std::size_t i = 0; i < world.robots().size(); ++i)
        if (const MotionNetwork* own = networkOf(world, i); own != nullptr && own->robotType == network.robotType)
            return true;
    return false;
}

/// Unless no robot would move otherwise, or it is there already.
void addNetwork(const std::filesystem::path& file, MotionNetwork network, const LogWorld& world,
                std::vector<OtherModel>& models) {
    const std::string name = file.filename().string();
    const auto motion = std::make_shared<const LearnedMotion>(std::move(network));
    OtherModel other = otherNetwork(name, motion, world);
    const auto isNull = [](const auto& model) { return model == nullptr; };
    if (std::all_of(other.byRobot.begin(), other.byRobot.end(), isNull)) return;
    if (std::none_of(models.begin(), models.end(), [&](const OtherModel& m) { return m.name == name; }))
        models.push_back(std::move(other));
}

}  // namespace

Expected<std::vector<OtherModel>> modelsToTry(const LogWorld& world, const std::vector<std::string>& networks) {
    std::vector<OtherModel> models;
    for (const std::string& named : networks) {
        const std::filesystem::path file = placeOfNetwork(named);
        auto network = loadNetwork(file);
        if (!network) return tl::unexpected(network.error());
        addNetwork(file, std::move(*network), world, models);
    }
    for (const std::filesystem::path& file : networksThatShip())
        if (auto network = loadNetwork(file); network && isOfTheirType(*network, world))
            addNetwork(file, std::move(*network), world, models);
    for (OtherModel& kinematics : otherKinematics(world)) models.push_back(std::move(kinematics));
    return models;
}

}  // namespace mrose
