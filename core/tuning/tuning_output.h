#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tuning/paired_statistics.h"
#include "tuning/tuner.h"
#include "tuning/tuning_file.h"

namespace mrose {

/// What a tuning came to in the trials held out, with 95 % intervals over trials.
struct TuningEvidence {
    MeanInterval before, after;
    MeanInterval change;  ///< after - before, paired by trial
};
/// Of a complete result.
TuningEvidence evidenceOf(const TunerResult& result);

/// A settings file (settings_file.h) with the best candidate's values, and the evidence for it. `made`: further lines
/// of that, each a key with its text: by what program and command.
std::string settingsText(const Tuning& tuning, const TunerResult& result,
                         const std::vector<std::pair<std::string, std::string>>& made);

/// candidates.csv: a row for each candidate, in the order in which they were tried.
std::string candidatesText(const Tuning& tuning, const TunerResult& result);

}  // namespace mrose
