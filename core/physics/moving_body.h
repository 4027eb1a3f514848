#pragma once

#include <vector>

#include "physics/contact_task.h"

namespace mrose {

/// A body within a tick: it moves straight and turns evenly from `since` on, about its centre of mass.
struct MovingBody {
    MovingBody(const ContactBody& body, double duration);

    /// Of the reference point, at a time within the tick, s.
    Placement frameAt(double time) const {
        return time == since ? frame : time == known ? knownFrame : movedFrame(time);
    }
    /// Makes frameAt(time) quick until the body moves otherwise.
    void know(double time) {
        if (known == time) return;
        knownFrame = movedFrame(time);
        known = time;
    }
    Placement movedFrame(double time) const;
    Pose poseAt(double time) const;  ///< of the centre of mass
    /// Makes `time` the one since which it moves as it does.
    void advance(double time);
    /// By a vector and an angle, where it is.
    void displace(const Point& by, double angle);

    Point velocityAt(const Point& point_W) const {
        const Point arm = point_W - centre;
        return {velocity.x - rotation * arm.y, velocity.y + rotation * arm.x};
    }

    const ContactBody* body;
    double inverseMass, inverseInertia;
    double since = 0;    ///< s
    Point centre;        ///< of mass, in the world, then
    double heading = 0;  ///< then
    Placement frame;     ///< of the reference point, then
    Point velocity;      ///< of the centre, m/s
    double rotation = 0;
    double travel = 0;  ///< m, until `since`
    double known = -1;  ///< s; see know()
    Placement knownFrame;
    bool pushed = false;     ///< by impulses
    bool displaced = false;  ///< out of an overlap
};

}  // namespace mrose
