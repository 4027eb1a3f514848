#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace mrose {

std::shared_ptr<const Shape> discOutline(double radius);
/// Each polygon is a part of its own.
std::shared_ptr<const Shape> outlineOf(const std::string& name, std::vector<Polygon> parts);

/// A needle that points along x, its point at the origin, its end `length` before that.
Polygon needle(double length, double width);
/// A body with two horns forward, thinner and nearer to each other than a ball is wide.
std::shared_ptr<const Shape> hornedOutline();
/// Pointed ones and ones of several pieces, with their centres of mass in and off the reference point; reach at most
/// 0.35 m.
const std::vector<std::shared_ptr<const Shape>>& trickyOutlines();

/// What slides with the given laws of touch.
ObjectType slidingBody(std::shared_ptr<const Shape> shape, double mass, const Surface& surface);
ObjectType rollingBody(double radius, double mass, const Surface& surface);
RobotType robotOf(std::shared_ptr<const Shape> shape, double mass = 10, const Surface& surface = {0.3, 0.1});

/// A place whose floor neither brakes what slides nor what rolls.
Environment onIce(Environment environment = {});
/// A convex obstacle in a place.
void addObstacle(Environment& environment, const std::string& name, Polygon corners, const Surface& surface);

}  // namespace mrose
