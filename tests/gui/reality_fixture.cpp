#include "gui/reality_fixture.h"

#include <gtest/gtest.h>

#include "behaviour/command_player.h"
#include "motion/kinematic.h"
#include "support/scenes.h"
#include "widgets/field_fixture.h"

namespace mrose::gui {
namespace {

/// A scenario whose robots play all of a log's.
ScenarioParts playersOn(const Log& log, double gain) {
    ScenarioParts parts;
    parts.name = "overlaid";
    Scene& scene = parts.scene;
    scene.environment.floor.area = {{-5, -4}, {5, -4}, {5, 4}, {-5, 4}};
    ShapePart disc;
    disc.name = "disc";
    disc.radius = 0.3;
    disc.colour = bodyColour;
    RobotType type = discRobot(0.3);
    type.shape = std::make_shared<const Shape>(Shape::fromParts("disc", {disc}));
    scene.robotTypes = {type};
    KinematicParameters motion;
    motion.v.gain = gain;
    scene.models = {std::make_shared<const KinematicModel>(motion)};
    for (std::uint32_t i = 0; i < log.robots.size(); ++i) {
        SceneRobot robot;
        robot.name = "sim " + log.robots[i].robot;
        scene.robots.push_back(robot);
        parts.controllers.push_back(std::make_shared<CommandPlayer>(std::vector<StampedCommand>()));
        parts.players.push_back({i, {log.source, log.source, log.robots[i].robot, "", 0}});
    }
    return parts;
}

}  // namespace

std::shared_ptr<const Log> logOfDrives(const std::vector<RealDrive>& drives, double seconds, std::int64_t rate) {
    auto log = std::make_shared<Log>();
    log->source = "made-up";
    log->format = "csv";
    for (const RealDrive& drive : drives) {
        Trajectory trajectory;
        for (Nanoseconds t = 0; t <= fromSeconds(seconds); t += nanosecondsPerSecond / 10)
            trajectory.commands.push_back({t, drive.command});
        for (Nanoseconds t = 0; t <= fromSeconds(seconds); t += nanosecondsPerSecond / rate) {
            bool seen = true;
            for (const auto& [from, to] : drive.unseen) seen = seen && (toSeconds(t) <= from || toSeconds(t) >= to);
            // The heading goes on beyond half a turn, as a log's does.
            Pose pose = drive.poseAt(toSeconds(t));
            pose.heading = drive.start.heading + drive.command.w * toSeconds(t);
            if (seen) trajectory.poses.push_back({t, pose});
        }
        log->robots.push_back({drive.robot, {std::move(trajectory)}, {}});
    }
    return log;
}

OpenedRun overlaidRun(std::shared_ptr<const Log> log, double start, double duration, double gain) {
    const auto world = LogWorld::create(playersOn(*log, gain), log);
    if (!world) {
        ADD_FAILURE() << world.error().message();
        return {};
    }
    const LogWorld::Opened opened = world->openAt(0, fromSeconds(start), fromSeconds(duration), 1);
    OpenedRun run;
    run.name = "overlaid";
    run.setup = std::make_shared<const BranchSetup>(BranchSetup{{}, opened.scenario});
    run.start = opened.state;
    run.reality = std::make_shared<const Reality>(realityOf(*world, 0, fromSeconds(start)));
    return run;
}

}  // namespace mrose::gui
