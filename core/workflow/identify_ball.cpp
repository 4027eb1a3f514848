#include "workflow/identify_ball.h"

#include <algorithm>

#include "io/file.h"
#include "logs/unit_doubts.h"
#include "report/ball_text.h"
#include "scenario/description_file.h"
#include "workflow/log_files.h"
#include "workflow/outputs.h"
#include "workflow/resources.h"

namespace mrose {
namespace {

Expected<std::vector<ConvexPiece>> obstaclesOf(const std::string& file) {
    std::vector<ConvexPiece> pieces;
    if (file.empty()) return pieces;
    DiskDescriptions source = openDescriptions({});
    const auto description = loadDescription(file, source);
    if (!description) return tl::unexpected(description.error());
    const auto* const environment = std::get_if<Environment>(&*description);
    if (environment == nullptr) return fail(file, "describes something else; expected an environment");
    for (const Obstacle& obstacle : environment->obstacles)
        pieces.insert(pieces.end(), obstacle.shape.pieces.begin(), obstacle.shape.pieces.end());
    if (pieces.empty()) return fail(file, "has neither walls nor obstacles");
    return pieces;
}

}  // namespace

Expected<BallIdentification> identifyBall(const IdentifyBallRequest& request, const Progress& progress) {
    std::vector<std::string> inputs{placeOfLog(request.log)};
    if (!request.environment.empty()) inputs.push_back(request.environment);
    if (!request.output.empty())
        if (auto can = checkOutput(request.output, inputs, request.overwrite); !can) return tl::unexpected(can.error());
    BallIdentificationOptions options;
    auto obstacles = obstaclesOf(request.environment);
    if (!obstacles) return tl::unexpected(obstacles.error());
    options.obstacles = std::move(*obstacles);
    const auto log = openLog(request.log, request.robots);
    if (!log) return tl::unexpected(log.error());
    if (!mayGoOn(progress, 0)) return fail(log->source, "was not looked through: cancelled");
    auto found = identifyBall(*log, options);
    if (!found) {
        found.error().cause = withUnitDoubts(found.error().cause, *log);
        return found;
    }
    found->unitDoubts = unitDoubts(*log);
    if (!mayGoOn(progress, 1)) return fail(log->source, "was not looked through: cancelled");
    const std::vector<BallLine> lines = ballLines(*found);
    const bool any =
        std::any_of(lines.begin(), lines.end(), [](const BallLine& line) { return line.estimate->identified; });
    if (!request.output.empty() && !any)
        return fail(log->source, "tells nothing of its ball that " + request.output + " could hold; " +
                                     withUnitDoubts(lines.front().name + ": " + lines.front().estimate->reason, *log));
    if (!request.output.empty())
        if (auto written = writeFileAtomically(request.output, ballKeysText(*found, log->source)); !written)
            return tl::unexpected(written.error());
    return found;
}

}  // namespace mrose
