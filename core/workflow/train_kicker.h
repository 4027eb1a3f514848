#pragma once

#include <string>
#include <vector>

#include "identification/kick_trainer.h"
#include "io/progress.h"

namespace mrose {

/// From which logs a kicker is learned, and how.
struct TrainKickerRequest {
    std::vector<std::string> logs;
    std::string output;                    ///< the network file; empty: it is written nowhere
    bool overwrite = false;                ///< of a file that is there already
    std::vector<std::string> robots = {};  ///< whose kicks; empty: of all
    std::string robotKind = {};            ///< a name or a robot file; empty: what the log says
    KickTrainerOptions training = {};
    std::string command = {};  ///< what the network says that it was made by
};

struct TrainedKicker {
    KickNetwork network;
    KickSamples samples;                    ///< that it was learned from
    std::vector<std::string> notices = {};  ///< what must be known of it, a sentence each
};

/// A sentence for each kind of kicks that were left out.
std::vector<std::string> noticesOf(const KickSamples& samples);

/// Error: a log cannot be read, has no kicks or no ball, no such robot; the file cannot be written, is there already or
/// one of the logs; too few kicks; `progress` ended it.
Expected<TrainedKicker> trainKicker(const TrainKickerRequest& request, const Progress& progress = {});

}  // namespace mrose
