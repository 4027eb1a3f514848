#pragma once

#include "comparison/course_requests.h"
#include "scenario/description_texts.h"

namespace mrose {

/// One course of a log world as a scenario that stands by itself: its text is the world's, without the robots that are
/// not in the course, with what each of the others is told from there on, and the state at its start. Loaded from these
/// texts alone it begins as the course does, to the last bit, and goes on so: recordings and reports of the course need
/// no log. Saved as a file, it plays the log from that instant.
struct DescribedCourse {
    Descriptions descriptions;
    std::shared_ptr<const Scenario> scenario;  ///< as loaded from them
    WorldState state;
};

/// `opened` as LogWorld::openAt() gave it for the course's take and start and for `duration`, which may be longer than
/// the course; `descriptions` are what the world's parts
/// were loaded from, without logs; `log` the place of the log as it is written into the text. The scenario lasts for
/// `length`. Error: the scenario's
/// text cannot be edited so.
Expected<DescribedCourse> describeCourse(const LogWorld& world, const LogWorld::Opened& opened,
                                         const Descriptions& descriptions, const std::string& log,
                                         const CourseRequest& course, Nanoseconds length, Nanoseconds duration);

}  // namespace mrose
