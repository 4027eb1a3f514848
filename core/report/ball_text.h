#pragma once

#include <string>
#include <vector>

#include "identification/ball_identification.h"

namespace mrose {

/// What was identified of a ball, for people: a line for each quantity, with its key, unit and standard error.
struct BallLine {
    std::string name, unit;
    const BallEstimate* estimate = nullptr;
    std::string key;  ///< and where it stands: "floor.sliding_friction of an environment"; "": none has it
};
std::vector<BallLine> ballLines(const BallIdentification& found);

/// The keys of an environment file, of an [[object]] of a scenario, and in a comment those of robot files, with what
/// was identified (resources/README.md); what was not is named in a comment. Of two surfaces that touch the larger
/// restitution counts: the ball has the smaller one of what was identified.
std::string ballKeysText(const BallIdentification& found, const std::string& source);

/// What must be known before the figures are believed, a sentence each.
std::vector<std::string> ballNotes(const BallIdentification& found);

/// As `mrose identify-ball --json` prints it.
std::string ballJson(const BallIdentification& found, const std::string& source);

}  // namespace mrose
