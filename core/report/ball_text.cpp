#include "report/ball_text.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "io/format.h"

namespace mrose {
namespace {

std::string errorText(const BallEstimate& of) { return "± " + fixed(of.error, 4) + ", " + counted(of.events, "event"); }

/// "sliding_friction = 0.3012 # ± 0.0004, 80 events\n", or why there is none.
std::string keyLine(const std::string& key, const BallEstimate& of, const std::string& more = {}) {
    if (!of.identified) return "# " + key + ": not identified: " + of.reason + '\n';
    return key + " = " + fixed(of.value, 4) + "  # " + errorText(of) + more + '\n';
}

/// `before` the line where it is one of another file.
std::string surfaceLine(const BallEstimate& of, const std::string& before = {}) {
    if (!of.identified) return "# surface = { restitution }: not identified: " + of.reason + '\n';
    return before + "surface = { restitution = " + fixed(std::clamp(of.value, 0.0, 1.0), 4) + " }  # " + errorText(of) +
           '\n';
}

/// Of the ball: the smaller one.
const BallEstimate& ownRestitution(const BallIdentification& found) {
    const BallEstimate &walls = found.wallRestitution, &robots = found.robotRestitution;
    if (!robots.identified) return walls;
    if (!walls.identified) return robots;
    return walls.value < robots.value ? walls : robots;
}

}  // namespace

std::vector<BallLine> ballLines(const BallIdentification& found) {
    return {
        {"rolling deceleration", "m/s2", &found.rollingDeceleration, "[floor] rolling_deceleration_mps2 (environment)"},
        {"sliding friction", "1", &found.slidingFriction, "[floor] sliding_friction (environment)"},
        {"speed kept until it rolls", "1", &found.kept, ""},
        {"time until it rolls", "s per m/s", &found.untilRolling, ""},
        {"inertia over m r2", "1", &found.inertia, "inertia ([[object]])"},
        {"restitution at walls", "1", &found.wallRestitution, "surface (environment)"},
        {"restitution at robots", "1", &found.robotRestitution, "surface (robot file)"}};
}

std::string ballKeysText(const BallIdentification& found, const std::string& source) {
    std::string text = "# Identified by mrose identify-ball of " + source;
    text += found.synthetic ? " (synthetic: no real ball rolled).\n" : ".\n";
    text +=
        "# What follows ± is one standard error. Nothing reads this file: its lines belong into those that it names.\n";
    text += "\n# Of an environment file.\n" + surfaceLine(found.wallRestitution);
    text += "\n[floor]\n" + keyLine("sliding_friction", found.slidingFriction);
    text += keyLine("rolling_deceleration_mps2", found.rollingDeceleration,
                    ", at " + fixed(found.rollingSpeed, 2) + " m/s in the mean");
    text += "\n# Of a scenario: the ball. Where two surfaces touch, the larger restitution counts.\n[[object]]\n";
    text += keyLine("inertia", found.inertia) + surfaceLine(ownRestitution(found));
    text += "\n# Of the robots' files:\n";
    return text + surfaceLine(found.robotRestitution, "# ");
}

std::vector<std::string> ballNotes(const BallIdentification& found) {
    std::vector<std::string> notes = found.unitDoubts;
    if (found.synthetic) notes.push_back("The log is synthetic: no real ball rolled.");
    if (!found.obstacles && found.oblique > 0)
        notes.push_back("Of " + counted(found.touches, "touch", "touches") + ", " + std::to_string(found.oblique) +
                        " were left out: at an angle, restitution needs to know how the surface lies. --environment "
                        "says it of walls.");
    if (found.unexplained > 0)
        notes.push_back(counted(found.unexplained, "touch", "touches") +
                        " happened where neither a robot nor anything of the environment is near.");
    if (found.misfits > 0)
        notes.push_back(counted(found.misfits, "stretch", "stretches") +
                        " of the track did not look like free motion and were left out.");
    if (found.rollingDeceleration.identified &&
        found.rollingDeceleration.spread > 0.15 * found.rollingDeceleration.value)
        notes.push_back("The rolling deceleration differs from stretch to stretch by " +
                        fixed(found.rollingDeceleration.spread, 2) +
                        " m/s2 (standard deviation) beyond errors: this ball or floor is no even one.");
    return notes;
}

std::string ballJson(const BallIdentification& found, const std::string& source) {
    nlohmann::json json{{"log", source},
                        {"synthetic", found.synthetic},
                        {"positions", found.positions},
                        {"tracks", found.tracks},
                        {"kicks", found.kicks},
                        {"touches", found.touches},
                        {"moved_s", found.moved},
                        {"tracker_noise_m", found.noise},
                        {"rolling_speed_mps", found.rollingSpeed},
                        {"notices", ballNotes(found)}};
    const auto add = [&](const char* key, const BallEstimate& of) {
        json[key] = {{"identified", of.identified}, {"events", of.events}};
        if (of.identified)
            json[key].update({{"value", of.value}, {"error", of.error}, {"spread", of.spread}});
        else
            json[key]["reason"] = of.reason;
    };
    add("rolling_deceleration_mps2", found.rollingDeceleration);
    add("sliding_friction", found.slidingFriction);
    add("speed_kept_until_rolling", found.kept);
    add("time_until_rolling_s_per_mps", found.untilRolling);
    add("inertia", found.inertia);
    add("wall_restitution", found.wallRestitution);
    add("robot_restitution", found.robotRestitution);
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace mrose
