#pragma once

#include <QString>
#include <string>

#include "debug/field_frame.h"

namespace mrose {

// What is said of bodies, in numbers whose digits do not come and go.

/// "3.20 m", "45 cm": of a length between two digits and three.
QString lengthText(double metres);
/// "x -1.09 m   y 0.88 m   12.3 deg", with the sign of a degree.
QString poseText(const Pose& pose);
/// The same of a body: without the heading of what is round and faces nowhere.
QString poseText(const FieldFrame& frame, std::size_t body, const Pose& pose);
/// "0.24 N s", "13.1 N s".
QString impulseText(double impulse);

/// Name, kind, pose and speed of a body, in three lines.
QString bodyReadout(const FieldFrame& frame, std::size_t body);
/// Of contacts, notes and kicks within `reach` metres of a point, a line each; empty: there are none.
QString signReadout(const FieldFrame& frame, const Point& at, double reach);

/// "kind 7, 16 B".
QString kindAndSize(const SentMessage& message);
/// "100 ms", in whole ones.
QString millisecondsText(Nanoseconds time);
/// "kind 7, 16 B, 100 ms": of a message that was due, how late it was, or that it was lost or out of range.
QString messageText(const FieldFrame& frame, const RadioLog::Entry& entry);

/// What a note on the field is called. One with a body's name is where its robot thinks that one to be: "red 3's ball".
QString noteText(const FieldFrame& frame, std::size_t robot, const Annotation& note);

}  // namespace mrose
