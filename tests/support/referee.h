#pragma once

#include <optional>
#include <string>

namespace mrose {

/// What a command prints, errors too; nothing when it fails.
std::optional<std::string> outputOf(const std::string& command);

/// The command that runs the referee of the MRCLAM windows, a program independent of this one, which needs Python with
/// numpy: the script that the environment variable MROSE_REFEREE names, otherwise the one beside the repository.
std::optional<std::string> referee();

/// The queries of the referee of learned cameras on an MRCLAM data set in `folder`, a line each:
/// robot,t,subject,reported,range,bearing; the last two are nan where it was not reported, and no zero has a sign. Its
/// script is the one that MROSE_CAMERA_REFEREE names, otherwise score_perception.py beside the other one; nullopt:
/// there is none, or no numpy.
std::optional<std::string> cameraQueries(const std::string& folder, int dataset, const std::string& robots);

/// What that referee says of predictions in a file, for the same queries; nullopt likewise, or where it refuses them.
std::optional<std::string> cameraVerdict(const std::string& folder, int dataset, const std::string& robots,
                                         const std::string& file);

/// The number behind a label in a text; not a number where there is none.
double numberAfter(const std::string& text, const std::string& label);

}  // namespace mrose
