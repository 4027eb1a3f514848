#pragma once

#include <string>
#include <string_view>

#include "assessment/assess.h"

namespace mrose {

// What the classes of the figures' marks mean, as markup. Labels are plain text.

/// CSS class of the n-th series: s0 is the one that the report is about, the others are what it is compared with.
std::string seriesClass(std::size_t series);

/// An assessment's name behind a sample of its line.
std::string seriesName(const Assessment& assessment, std::size_t series);

/// The same of anything else that has a name.
std::string seriesName(std::string_view name, std::size_t series);

/// A sample of a line of a class, and what it is.
std::string lineEntry(std::string_view cssClass, std::string_view label);
/// A sample of an area.
std::string boxEntry(std::string_view cssClass, std::string_view label);
/// A sample of a round mark.
std::string dotEntry(std::string_view cssClass, std::string_view label);
std::string arrowEntry(std::string_view cssClass, std::string_view label);

std::string legend(std::string_view entries);

}  // namespace mrose
