#pragma once

#include <string>
#include <vector>

#include "workflow/evaluate_network.h"

namespace mrose {

/// Of which network and which of a team's logs a page is wanted.
struct SheetRequest {
    std::string network, log;
    std::vector<std::string> robots = {};  ///< of the log, by name; empty: all
    bool heldOut = false;                  ///< only the part of the log that was kept from learning
    std::string output = {};               ///< the page
    bool overwrite = false;                ///< of a file that is there already
    std::string command = {};              ///< what the page says that it was made by
};

/// Evaluates the network on the log and writes the page. Error: as of evaluateNetwork(); the page cannot be written; it
/// was cancelled.
Expected<NetworkEvaluation> writeSheet(const SheetRequest& request, const Progress& progress = {});

}  // namespace mrose
