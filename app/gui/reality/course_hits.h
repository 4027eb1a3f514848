#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "breaks/breakpoints.h"

namespace mrose::gui {

/// How often breakpoints were met in each of the courses of a log, as far as those were played or looked through. Who
/// comes to a course again finds nothing new.
class CourseHits {
public:
    void learn(std::size_t course, std::span<const BreakpointState> states);
    /// Of those before a course and after it.
    MetElsewhere elsewhere(std::size_t course) const;
    /// What was met of this text is another question now.
    void forget(const std::string& text) { hits_.erase(text); }
    void clear() { hits_.clear(); }

private:
    std::map<std::string, std::map<std::size_t, std::int64_t>> hits_;  ///< by text and course
};

}  // namespace mrose::gui
