#pragma once

#include <memory>

#include "recording/recording.h"
#include "scenario/scenario.h"

namespace mrose::gui {

/// What a branch runs in: all that is constant, and the value that says so.
struct Course {
    ScenarioValuePointer value;
    std::shared_ptr<const Scenario> scenario;

    const Scene& scene() const { return scenario->scene(); }
};
using CoursePointer = std::shared_ptr<const Course>;

}  // namespace mrose::gui
