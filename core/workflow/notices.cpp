#include "workflow/notices.h"

#include <algorithm>

#include "logs/csv_format.h"
#include "logs/unit_doubts.h"
#include "motion/learned_model.h"
#include "workflow/resources.h"
#include "workflow/version.h"

namespace mrose {
namespace {

std::string listOf(const std::vector<std::string>& names) {
    if (names.size() == 1 && names[0] == defaultRobot) return "the " + names[0];
    std::string text = names.size() == 1 ? "robot " : "robots ";
    for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : ", ") + names[i];
    return text;
}

std::string ofOtherKind(const std::string& known, const std::string& kind, const std::string& whose) {
    if (kind.empty() || kind == "robot" || known == "robot" || kind == known) return {};
    return "The network is of another kind of robot (" + known + ") than " + whose + " (" + kind +
           "): its predictions mean little.";
}

std::string ofUnknownRobots(const std::vector<std::string>& known, const std::vector<std::string>& robots) {
    std::vector<std::string> unknown;
    for (const std::string& robot : robots)
        if (std::find(known.begin(), known.end(), robot) == known.end()) unknown.push_back(robot);
    if (unknown.empty() || known.empty()) return {};
    return "The network was not learned from " + listOf(unknown) +
           (known.size() == 1 ? ", which it takes for " : ", which it takes for the mean of ") + listOf(known) + '.';
}

std::vector<std::string> namesOf(const Log& log) {
    std::vector<std::string> names;
    for (const RobotLog& robot : log.robots) names.push_back(robot.robot);
    return names;
}

bool isKnownLog(const std::vector<NetworkSource>& known, const Log& log) {
    return std::ranges::any_of(log.files, [&](const LogFile& file) {
        return std::ranges::any_of(known, [&](const NetworkSource& source) { return source.hash == file.hash; });
    });
}

/// `howJudged`: what is said beside it.
std::string ofKnownLog(const std::vector<NetworkSource>& known, const Log& log, const std::string& howJudged) {
    if (!isKnownLog(known, log)) return {};
    return "The network was learned from this log: on another one its errors are larger." + howJudged;
}
std::string ofKnownLog(const MotionNetwork& network, const Log& log, const std::string& howJudged) {
    return ofKnownLog(network.training.logs, log, network.heldOut.part.holdsAny() ? howJudged : "");
}

std::string ofNoNoise(const MotionNetwork& network) {
    return network.noise ? "" : "The network knows its mean alone: it does not say how far real runs stray from it.";
}

}  // namespace

ReportContext contextOf(const NetworkTraining& training, const std::string& command) {
    ReportContext context;
    context.program = "mrose " MROSE_VERSION;
    context.commandLine = command;
    for (const NetworkSource& source : training.logs) context.trainingLogs.push_back({source.path, source.hash});
    return context;
}

std::vector<const MotionNetwork*> networksOf(const ScenarioParts& parts) {
    std::vector<const MotionNetwork*> networks;
    for (const LogPlayer& player : parts.players)
        if (const auto* learned = learnedModel(parts.scene.modelOf(player.robot)))
            if (std::find(networks.begin(), networks.end(), &learned->network()) == networks.end())
                networks.push_back(&learned->network());
    return networks;
}

std::string robotKind(const Log& log) {
    const auto kinds = robotKinds();
    const RobotKind* const kind = kinds ? kindOfLog(*kinds, log) : nullptr;
    return kind != nullptr ? kind->traits.type : "";
}

std::vector<std::string> noticesOf(const Log& log) {
    std::vector<std::string> notices = log.incomplete;
    for (std::string& doubt : unitDoubts(log)) notices.push_back(std::move(doubt));
    return notices;
}

std::vector<std::string> otherRobotNotices(const MotionNetwork& network, const Log& log) {
    std::vector<std::string> notices{ofOtherKind(network.robotType, robotKind(log), "the log"),
                                     ofUnknownRobots(network.robots, namesOf(log))};
    std::erase(notices, std::string());
    return notices;
}

std::vector<std::string> noticesOf(const MotionNetwork& network, const Log& log, bool heldOutOnly) {
    std::vector<std::string> notices = otherRobotNotices(network, log);
    if (!heldOutOnly)
        notices.push_back(ofKnownLog(network, log, " --held-out judges it by what was kept from learning."));
    notices.push_back(ofNoNoise(network));
    std::erase(notices, std::string());
    return notices;
}

std::string besideNotice(const std::string& name, const NetworkTraining& training, const Log& log) {
    return isKnownLog(training.logs, log) ? name + " was learned from this log: on another one its errors are larger."
                                          : "";
}

std::vector<std::string> noticesOf(const SensorNetwork& network, const Log& log,
                                   const std::vector<std::string>& robots) {
    std::vector<std::string> notices{ofOtherKind(network.robotType, robotKind(log), "the log"),
                                     ofUnknownRobots(network.robots, robots),
                                     ofKnownLog(network.learned.training.logs, log, "")};
    std::erase(notices, std::string());
    return notices;
}

std::vector<std::string> noticesOf(const MotionNetwork& network, const LogWorld& world) {
    Log compared;
    compared.files = world.log().files;
    for (const ComparedRobot& robot : world.robots()) compared.robots.push_back({robot.realName, {}, {}});
    std::vector<std::string> notices{
        otherKindNotice(network, world), ofUnknownRobots(network.robots, namesOf(compared)),
        ofKnownLog(network, compared, " mrose evaluate can judge it by what was kept."), ofNoNoise(network)};
    std::erase(notices, std::string());
    return notices;
}

std::string otherKindNotice(const MotionNetwork& network, const LogWorld& world) {
    const std::string kind = robotKind(world.log());
    const auto own = networksOf(world.parts());
    if (!kind.empty() || own.empty()) return ofOtherKind(network.robotType, kind, "the log");
    return ofOtherKind(network.robotType, own.front()->robotType, "the scenario's");
}

}  // namespace mrose
