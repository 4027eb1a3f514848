#include "diagnosis/log_defects_near.h"

#include <algorithm>
#include <cmath>

#include "assessment/truth_jumps.h"
#include "diagnosis/command_jumps.h"
#include "io/format.h"
#include "logs/conditioning.h"

namespace mrose {
namespace {

constexpr std::size_t mostBlips = 8, mostTruthJumps = 4;
constexpr Nanoseconds poseGap = 200'000'000;
/// Truth behind a gap from which a velocity is measured.
constexpr Nanoseconds settled = 100'000'000;

Nanoseconds usualPause(const std::vector<StampedCommand>& commands) {
    std::vector<Nanoseconds> pauses;
    for (std::size_t i = 1; i < commands.size(); ++i) pauses.push_back(commands[i].time - commands[i - 1].time);
    if (pauses.empty()) return 0;
    const auto middle = pauses.begin() + static_cast<std::ptrdiff_t>(pauses.size() / 2);
    std::nth_element(pauses.begin(), middle, pauses.end());
    return *middle;
}

struct Pause {
    Nanoseconds begin = 0, end = 0;
};

/// Those of at least `limit` that overlap (from, to).
template <class Sample>
std::vector<Pause> pausesOf(const std::vector<Sample>& samples, Nanoseconds from, Nanoseconds to, Nanoseconds limit) {
    Sample key{};
    key.time = from;
    std::vector<Pause> pauses;
    for (auto at = std::upper_bound(samples.begin(), samples.end(), key, earlier<Sample>); at != samples.end(); ++at) {
        if (at == samples.begin()) continue;
        const Pause pause{std::prev(at)->time, at->time};
        if (pause.begin >= to) break;
        if (pause.end - pause.begin >= limit) pauses.push_back(pause);
    }
    return pauses;
}

}  // namespace

DefectsNear defectsNear(const Trajectory& trajectory, const MotionModel& model, const ComparedRollout& rollout,
                        Nanoseconds step, Nanoseconds divergence) {
    const Nanoseconds start = rollout.real.start, end = start + divergence;
    const Nanoseconds since = start - commandsShowFor(model);
    DefectsNear found;
    for (const StampedCommand& blip : trajectory.blips)
        if (blip.time >= since && blip.time < end) found.blips.push_back(blip);
    if (found.blips.size() > mostBlips)
        found.blips.erase(found.blips.begin(), found.blips.end() - static_cast<std::ptrdiff_t>(mostBlips));

    const std::vector<Pose>& truth = rollout.real.truth;
    const int steps = static_cast<int>(rollout.simulated.size());
    const auto known = [&](int k) { return k == 0 || std::isfinite(truth[static_cast<std::size_t>(k)].x); };
    const auto add = [&](const std::string& what, Nanoseconds begin, Nanoseconds over) {
        int from = static_cast<int>(std::max<Nanoseconds>(0, begin - start) / step);
        int to = static_cast<int>((over - start + step - 1) / step);
        while (from > 0 && !known(from)) --from;
        while (to < steps && !known(to)) ++to;
        if (to >= steps || !known(from) || !known(to) || to <= from) return;
        found.gaps.push_back({what, from, to});
    };
    const auto addPause = [&](const Pause& pause, Nanoseconds over, const char* without) {
        add("carried over " + fixed(toSeconds(pause.end - pause.begin), 2) + " s without " + without + " from " +
                fixed(toSeconds(pause.begin - start), 2) + " s on",
            pause.begin, over);
    };
    const Nanoseconds commandGap = std::max<Nanoseconds>(500'000'001, 3 * usualPause(trajectory.commands));
    for (const Pause& pause : pausesOf(trajectory.commands, since, end, commandGap))
        addPause(pause, pause.end + commandsShowFor(model), "commands");
    for (const Pause& pause : pausesOf(trajectory.poses, start, end, poseGap))
        addPause(pause, pause.end + settled, "ground truth");
    std::vector<TruthJump> jumps = truthJumps(trajectory, start, end + truthSmoothed);
    if (jumps.size() > mostTruthJumps)
        jumps.erase(jumps.begin(), jumps.end() - static_cast<std::ptrdiff_t>(mostTruthJumps));
    for (const TruthJump& jump : jumps)
        add("carried over the ground truth's jump at " + fixed(toSeconds(jump.after - start), 2) + " s (" +
                fixed(100 * jump.distance, 0) + " cm, " + fixed(degrees * jump.turn, 0) + "°)",
            jump.before - truthSmoothed, jump.after + 2 * truthSmoothed);
    return found;
}

}  // namespace mrose
