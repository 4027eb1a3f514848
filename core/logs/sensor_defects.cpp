#include "logs/sensor_defects.h"

#include <iterator>

namespace mrose {
namespace {

constexpr SensorDefectCount sensorCounts[] = {
    {&SensorDefects::outOfOrder, "out_of_order", "stamp", "stamps", " out of order, sorted"},
    {&SensorDefects::joinedStamps, "joined_stamps", "stamp", "stamps", " shortly after another, taken for one look"},
    {&SensorDefects::repeated, "repeated", "report", "reports", " repeated, last kept"},
    {&SensorDefects::unknownSubjects, "unknown_subjects", "reading", "readings", " of unknown subjects, dropped"},
    {&SensorDefects::emptyLooks, "empty_looks", "look", "looks", " without a row, added"},
    {&SensorDefects::headingWraps, "heading_wraps", "heading wrap", "heading wraps", ", unwrapped"},
    {&SensorDefects::cutLines, "cut_lines", "last line", "last lines", " cut off, left out"}};
static_assert(sizeof(SensorDefects) == std::size(sensorCounts) * sizeof(std::int64_t), "a count is missing");

}  // namespace

std::span<const SensorDefectCount> sensorDefectCounts() { return sensorCounts; }

std::string misfitCause(const std::string& sensor, const std::string& robots, std::int64_t gross,
                        std::int64_t readings) {
    return "the readings of \"" + sensor + "\" of " + robots +
           " do not fit the ground truth: " + std::to_string(gross) + " of " + std::to_string(readings) +
           " are more than 1 m or 0.15 rad off; are their stamps of another clock, or columns swapped?";
}

void addDefects(SensorDefects& sum, const SensorDefects& more) {
    for (const SensorDefectCount& count : sensorCounts) sum.*count.count += more.*count.count;
}

}  // namespace mrose
