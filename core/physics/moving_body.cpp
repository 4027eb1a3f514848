#include "physics/moving_body.h"

namespace mrose {

MovingBody::MovingBody(const ContactBody& b, double duration)
    : body(&b), inverseMass(1 / b.mass), inverseInertia(1 / b.inertia), heading(b.pose.heading), frame(b.pose) {
    centre = frame.place(b.centre);
    Point way = position(b.planned) - position(b.pose);
    if (!(b.centre == Point{})) way = Placement(b.planned).place(b.centre) - centre;
    velocity = (1 / duration) * way;
    rotation = (b.planned.heading - b.pose.heading) / duration;
}

Pose MovingBody::poseAt(double time) const {
    const double later = time - since;
    return {centre.x + later * velocity.x, centre.y + later * velocity.y, heading + later * rotation};
}

Placement MovingBody::movedFrame(double time) const {
    const Pose pose = poseAt(time);
    Placement later = rotation == 0 ? frame : Placement(pose);
    later.origin = position(pose) - later.rotate(body->centre);
    return later;
}

void MovingBody::advance(double time) {
    if (time == since) return;
    const Pose pose = poseAt(time);
    travel += distance(centre, position(pose)) + body->reach * std::abs(pose.heading - heading);
    frame = frameAt(time);
    centre = position(pose);
    heading = pose.heading;
    since = time;
    known = -1;
}

void MovingBody::displace(const Point& by, double angle) {
    travel += length(by) + body->reach * std::abs(angle);
    centre = centre + by;
    heading += angle;
    frame = Placement({centre.x, centre.y, heading});
    frame.origin = centre - frame.rotate(body->centre);
    displaced = true;
    known = -1;
}

}  // namespace mrose
