#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "control/controller.h"
#include "geometry/pose.h"
#include "io/error.h"

// Stands in for core/behaviour and core/plugin until they are merged: the same names, robots that stand.
namespace mrose {

struct Standing : Controller {
    void decide(const Observation&, std::span<std::byte>, Decision& decision) const override {
        decision.command = Command{};
    }
};
struct CommandPlayer : Standing {
    explicit CommandPlayer(std::vector<StampedCommand>) {}
};
struct GoToPose : Standing {
    struct Options {
        std::vector<Pose> targets;
        bool loop = false;
        double speed = 0.4, rotation = 1, tolerance = 0.05, headingTolerance = 0.1;
    };
    explicit GoToPose(Options) {}
};
struct ChaseBall : Standing {
    struct Options {
        Point target;
        double speed = 0.4, rotation = 1;
        bool kicks = true;
    };
    explicit ChaseBall(Options) {}
};
struct Wander : Standing {
    struct Options {
        double speed = 0.3, rotation = 1, changeEvery = 2;
    };
    explicit Wander(Options) {}
};
inline Expected<std::shared_ptr<const Controller>> loadPlugin(const std::string& path, const std::string&) {
    return fail(path, "plug-ins are not here yet");
}

}  // namespace mrose
