#pragma once

#include <memory>
#include <string>

#include "comparison/course_requests.h"
#include "scenario/scenario_value.h"

namespace mrose {

/// One course of a log world as a scenario that stands by itself: the world's, without the robots that are not in the
/// course, with what each of the others is told from there on, and the state at its start. Made from the value alone it
/// begins as the course does, to the last bit, and goes on so: recordings and reports of the course need no log. Saved
/// as a file, it plays the log from that instant.
struct OpenedCourse {
    ScenarioValuePointer value;
    std::shared_ptr<const Scenario> scenario;
    WorldState state;
};

/// `world` is what `value` gives where logs are not played. `log` is the place of the log as the course names it. The
/// commands last for `duration`, which may be longer than the course, the scenario for `length`. Error: no robot has
/// ground truth there; the value is of another world.
Expected<OpenedCourse> openCourse(const LogWorld& world, const ScenarioValue& value, const std::string& log,
                                  const CourseRequest& course, std::uint64_t seed, Nanoseconds length,
                                  Nanoseconds duration);

}  // namespace mrose
