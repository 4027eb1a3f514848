#include "scene/object_model.h"

#include "scene/scene.h"

namespace mrose {

ObjectState heldInPlace(const ObjectModel& model, const ObjectInput& input) {
    ObjectState after = model.after(input);
    // The velocity of its reference point is as its centre of mass moves, and as it lies.
    const Point centre = input.type.shape->centroid;
    const Point turned = Placement(after.pose).rotate(centre) - Placement(input.state.pose).rotate(centre);
    after.velocity_W.x -= after.velocity_W.rotation * turned.y;
    after.velocity_W.y += after.velocity_W.rotation * turned.x;
    after.pose = input.state.pose;
    return after;
}

}  // namespace mrose
