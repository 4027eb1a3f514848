#pragma once

#include <string>
#include <vector>

#include "debug/judged_model.h"

namespace mrose {

/// `named`: a network's file, or the name of one that ships; or a kinematic model's (modelsToTry()). Error: there is no
/// such network, or it does not suit the scenario's ticks.
Expected<JudgedModel> openModel(const PlayedLog& log, const std::string& named);
/// What may be added without any file at hand.
std::vector<std::string> modelNames(const PlayedLog& log);
/// What the robots of a log might have moved by, to explain why they leave it: what suits them, and what is laid over.
std::vector<OtherModel> causeModels(const PlayedLog& log, const std::vector<JudgedModel>& laidOver);

}  // namespace mrose
