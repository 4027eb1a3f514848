#pragma once

#include <string>

#include "assessment/compare.h"

namespace mrose {

/// The part of a comparison's page about what the sensors reported; nothing where no sensor was compared.
std::string streamSection(const Comparison& comparison);

/// What is said of a sensor's streams in a sentence or two, as plain text: for pages and terminals alike.
std::string streamsText(const Comparison& comparison, const ComparedSensor& sensor);
/// How its p values are to be read.
std::string testsText();
/// "0.034", "0.001 or less"; nothing where it is not known.
std::string probabilityText(const TwoSampleTest& test);

}  // namespace mrose
