#include "workflow/divergence_request.h"

#include "io/format.h"
#include "workflow/motion_models.h"

namespace mrose {

Expected<DivergenceOptions> divergenceOptions(const LogWorld& world, const DivergenceRequest& request) {
    DivergenceOptions options;
    options.bound.held = fromSeconds(request.held);
    options.fromHeldOut = !request.position && !request.heading;
    if (request.position) options.bound.constant.position = *request.position;
    if (request.heading) options.bound.constant.heading = *request.heading / degrees;
    if (request.noCauses) {
        options.diagnosed = 0;
        return options;
    }
    auto models = modelsToTry(world, request.models);
    if (!models) return tl::unexpected(models.error());
    options.models = std::move(*models);
    return options;
}

}  // namespace mrose
