#include "report/evaluation_prose.h"

#include "drawing/markup.h"
#include "io/format.h"
#include "report/page.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

std::string boundsText(const Floor& floor) {
    return cat(fixed(1000 * floor.options.pathBound, 0), " mm and ", fixed(1000 * floor.options.rotationBound, 0),
               " mrad");
}

std::string countsText(const Floor& floor) {
    return cat("Of ", std::to_string(floor.tried), " stretches, ", std::to_string(floor.candidates),
               " pairs match; <b>", std::to_string(floor.pairs.size()),
               "</b> of them, best match first, share no instant and are counted. ");
}

double meanRotation(const Floor& floor) {
    double rotation = 0;
    for (const FloorPair& pair : floor.pairs) rotation += pair.rotation;
    return rotation / static_cast<double>(floor.pairs.size());
}

}  // namespace

std::string floorText(const Floor& floor) {
    std::string text = cat(
        "Which part of the error could no model avoid? Pairs of stretches of ", secondsText(floor.horizon, 0),
        " s of the same robot were sought whose commands are nearly the same: the integrals of v and of w differ by "
        "less than ",
        boundsText(floor), " at every instant, from ", secondsText(floor.options.lead, 0),
        " s before the start to the end. ", countsText(floor));
    if (floor.pairs.empty()) return cat(text, "So there is no such estimate for this log.");
    text += cat("They turn by ", fixed(meanRotation(floor), 2),
                " rad each on average. Two outcomes differ by the chance of "
                "both, which is called the spread here; a prediction of their mean would be off by 1/√2 of that, "
                "the floor: about what a model that sees commands alone can reach.");
    if (floor.pairs.size() < 20) text += " <b>With so few pairs this is a rough estimate.</b>";
    return text;
}

std::string turningFloorText(const Floor& floor) {
    std::string text =
        cat("Such pairs go straight as a rule, which says little of turning. So the same was done with stretches of ",
            secondsText(floor.horizon, 0), " s in which the robot turns by at least ",
            fixed(floor.options.leastTurnRate, 2), " rad/s on average, within ", boundsText(floor), ". ",
            countsText(floor));
    if (floor.pairs.empty()) return text;
    text += cat("They turn by ", fixed(meanRotation(floor), 2), " rad each on average.");
    if (floor.pairs.size() < 20) text += " <b>With so few pairs this is a rough estimate.</b>";
    return text;
}

std::string definitions(const Evaluation& evaluation) {
    const WindowOptions& options = evaluation.log.options;
    std::string list;
    list += definition(
        "window",
        cat("A stretch of ", secondsText(options.horizon, 0),
            " s with ground truth throughout in which the robot drives at least ", fixed(options.leastPath, 2),
            " m or turns at least ", fixed(options.leastRotation, 2),
            " rad (in proportion to its length). Windows of one robot do not overlap. Trajectories too short to "
            "be cut are one window each: their end, or all of them."));
    list +=
        definition("prediction",
                   "Open loop: it knows pose and velocity at the start, measured from truth at or before it, and each "
                   "command once it is issued. Nothing is aligned afterwards.");
    list += definition("P", cat("Sum over the windows of the position error’s time-mean (every ",
                                secondsText(options.step), " s), divided by the sum of the path lengths."));
    list += definition("Hd",
                       "Sum over the windows of the absolute heading error’s time-mean, divided by the sum of the "
                       "absolute rotations.");
    list += definition("from", "Seconds since the first stamp of the drive. Files have the log’s own clock.");
    list += definition("path, rotation", "Summed over steps of 0.5 s, because a robot’s wobble inflates shorter ones.");
    list += definition("interval", "Bootstrap: the middle 95 % of 1000 drawings of as many windows, with replacement.");
    list += definition("offset at the end",
                       "Mean of the signed error in the real robot’s frame: ahead of it, to its left, "
                       "turned counter-clockwise. It shows a bias that absolute errors hide.");
    list += definition("hard switch",
                       "Somewhere in the window v or w goes within 0.1 s from full (0.7 of the robot’s "
                       "largest command) to zero (0.1 of it) or to the other sign (0.25 on both sides), held "
                       "0.3 s before and after.");
    list += definition("straight, turning", "Other windows: commanded rotation below and above 0.5 rad in 10 s.");
    return element("dl", "", list);
}

}  // namespace mrose
