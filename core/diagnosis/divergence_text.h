#pragma once

#include <span>
#include <string>

#include "diagnosis/compared_divergences.h"

namespace mrose {

// `real` is what the robots of the log are called: LogWindows::real().

/// "leaves the real trajectory after 12.3 s: 10.4 cm and 3.2° off, beyond 10.0 cm"; with the time since when nothing is
/// known where the ground truth has a gap there.
std::string divergenceText(const Divergence& divergence, const std::string& real = "real");

/// "dead time 20 ms longer, which explains 93 % of the error"; "none of these; dead time 20 ms longer explains 34 % of
/// the error".
std::string causeText(const Diagnosis& diagnosis);

/// "93 % of the error at leaving arose from 0.9 to 1.4 s, when the real robot went 2.0 cm less and turned 4.1° more to
/// the left than the simulated one"; empty where it is not known.
std::string onsetText(const Diagnosis& diagnosis, const std::string& real = "real");

/// "defect of the log 14, dead time 2, none of these 28": of the rollouts whose causes were looked for.
std::string causeCounts(const ComparedDivergences& divergences);

/// "28 %", of an error.
std::string explainedText(const CauseTrial& trial);
/// What was tried and explains less than half a percent, in a list; empty where everything does more.
std::string uselessText(const Diagnosis& diagnosis);
/// The others, the best first; of many the best ones.
std::span<const CauseTrial> usefulTrials(const Diagnosis& diagnosis);

/// What it is to leave the real trajectory, in a sentence.
std::string boundText(const ComparedDivergences& divergences, const std::string& real = "real");

}  // namespace mrose
