#include "drawing/rollout_drawing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "drawing/scene_marks.h"

namespace mrose {
namespace {

using Entry = SvgDrawing::LegendEntry;

constexpr Colour realPath{240, 168, 40}, realArrow{158, 92, 0}, simulated{0, 91, 156}, quietMark{90, 96, 106};
constexpr double realWidth = 7, simulatedWidth = 2.2, missWidth = 2;          // pixels
constexpr double realPointer = 13, simulatedPointer = 11, startRadius = 6.5;  // pixels

const SvgDrawing::Style realStyle{.stroke = realPath, .strokeWidth = realWidth, .labelsAvoid = true};
const SvgDrawing::Style simulatedStyle{.stroke = simulated, .strokeWidth = simulatedWidth, .labelsAvoid = true};
const SvgDrawing::Style missStyle{.stroke = quietMark, .strokeWidth = missWidth, .dotted = true, .labelsAvoid = true};
const SvgDrawing::Style startStyle{.fill = white, .stroke = quietMark, .strokeWidth = 2.5, .labelsAvoid = true};

// Upon one another the half is the stronger.
const SvgDrawing::Style regionStyle{.fill = simulated, .opacity = 0.2};

constexpr Colour leaving{213, 94, 0};
const SvgDrawing::Style leavesStyle{.fill = white, .stroke = leaving, .strokeWidth = 3, .labelsAvoid = true};

bool isKnown(const Pose& pose) { return isFinite(position(pose)); }

/// With half a metre to spare, 3 m wide and high at least; nullopt where there are no paths.
std::optional<Area> areaRound(std::span<const DrawnRollout> rollouts) {
    constexpr double margin = 0.5, least = 3;
    Area area{{1, 1}, {-1, -1}};
    for (const DrawnRollout& rollout : rollouts)
        for (const PoseRegion& region : rollout.regions)
            for (const Point& corner : region.outline(RegionShare::most)) area.include(corner);
    for (const DrawnRollout& rollout : rollouts)
        for (const std::vector<Pose>* const poses : {&rollout.real, &rollout.simulated})
            for (const Pose& pose : *poses)
                if (isKnown(pose)) area.include(position(pose));
    if (area.empty()) return std::nullopt;
    const Point middle = area.middle(), size = area.most - area.least;
    const Point half{std::max(least / 2, size.x / 2 + margin), std::max(least / 2, size.y / 2 + margin)};
    return Area{middle - half, middle + half};
}

void addPath(SvgDrawing& drawing, const std::vector<Pose>& poses, const SvgDrawing::Style& style) {
    Polygon points;
    for (const Pose& pose : poses) points.push_back(position(pose));
    drawing.line(points, style);
}

/// Along the way and at the end; not at the start, where there is a mark.
void addPointers(SvgDrawing& drawing, const std::vector<Pose>& poses, std::size_t every, double pixels,
                 const Colour& colour) {
    for (std::size_t i = 1; i < poses.size(); ++i)
        if ((i % std::max<std::size_t>(1, every) == 0 || i + 1 == poses.size()) && isKnown(poses[i]))
            drawing.pointer(position(poses[i]), poses[i].heading, pixels, colour);
}

void addMiss(SvgDrawing& drawing, const DrawnRollout& rollout) {
    if (rollout.simulated.empty() || !isKnown(rollout.real.back()) || !isKnown(rollout.simulated.back())) return;
    const Point ends[] = {position(rollout.real.back()), position(rollout.simulated.back())};
    drawing.line(ends, missStyle);
    if (!rollout.miss.empty()) drawing.labelBeside(0.5 * (ends[0] + ends[1]), rollout.miss);
}

std::vector<Entry> legend(const RolloutPicture& picture, bool anyRegions, bool anyLeaves) {
    using Symbol = Entry::Symbol;
    std::vector<Entry> entries{{Symbol::line, realStyle, picture.real + " path"},
                               {Symbol::line, simulatedStyle, "simulated path"},
                               {Symbol::dot, startStyle, "start"},
                               {Symbol::pointer, {.fill = simulated}, "heading, " + picture.arrowInterval},
                               {Symbol::line, missStyle, "error at the end"}};
    if (anyRegions) {
        SvgDrawing::Style sample{.stroke = simulated, .strokeWidth = 9, .opacity = regionStyle.opacity};
        entries.push_back({Symbol::line, sample, "90 % of runs; half of them: darker"});
    }
    if (anyLeaves) entries.push_back({Symbol::dot, leavesStyle, "leaves the " + picture.real + " trajectory"});
    return entries;
}

}  // namespace

std::string drawRollouts(const Environment& environment, const RolloutPicture& picture,
                         std::span<const DrawnRollout> rollouts) {
    SvgDrawing drawing;
    addEnvironment(drawing, environment, {}, true);
    for (const DrawnRollout& rollout : rollouts)
        for (const RegionShare share : {RegionShare::most, RegionShare::half})
            drawing.area(swathOf(rollout.regions, share), regionStyle);
    for (const DrawnRollout& rollout : rollouts) addPath(drawing, rollout.real, realStyle);
    for (const DrawnRollout& rollout : rollouts) addPath(drawing, rollout.simulated, simulatedStyle);
    for (const DrawnRollout& rollout : rollouts) {
        addPointers(drawing, rollout.real, picture.arrowEvery, realPointer, realArrow);
        addPointers(drawing, rollout.simulated, picture.arrowEvery, simulatedPointer, simulated);
        const auto start = std::find_if(rollout.real.begin(), rollout.real.end(), isKnown);
        if (start == rollout.real.end()) continue;
        drawing.dot(position(*start), startRadius, startStyle);
        drawing.labelBeside(position(*start), rollout.name);
    }
    const bool anyRegions =
        std::any_of(rollouts.begin(), rollouts.end(), [](const auto& rollout) { return !rollout.regions.empty(); });
    bool anyLeaves = false;
    for (const DrawnRollout& rollout : rollouts) {
        addMiss(drawing, rollout);
        if (!rollout.leaves) continue;
        drawing.dot(position(rollout.simulated[*rollout.leaves]), startRadius, leavesStyle);
        anyLeaves = true;
    }
    return drawing.text({.title = picture.title,
                         .subtitle = picture.subtitle,
                         .legend = legend(picture, anyRegions, anyLeaves),
                         .longestSide = 760,
                         .shown = areaRound(rollouts)});
}

}  // namespace mrose
