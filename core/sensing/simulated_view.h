#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/point.h"
#include "geometry/shape.h"
#include "perception/sensed_state.h"
#include "perception/view.h"
#include "world/time.h"

namespace mrose {

struct BodyMap;
struct SensorView;

/// What a robot's sensor has before it at the instant SensorView::measured, as LoggedView says it of logs: landmarks
/// and other robots, with all bodies and obstacles that may hide them, by their exact shapes. Kept from look to look
/// for its memory.
class SimulatedView {
public:
    struct Subject {
        SubjectKind kind = SubjectKind::landmark;
        std::uint32_t index = 0;  ///< of the landmark (Environment) or the robot
        Point offset;             ///< from the sensor's robot, along the world's axes
        double range = 0, bearing = 0;
        bool counts = false;  ///< within the view itself, not just its margin
    };

    /// Looks for all within View::margin(), exactly.
    void look(const SensorView& view, const View& limits);
    /// Landmarks by their indices, then robots by theirs.
    std::span<const Subject> subjects() const { return subjects_; }
    /// Where the sensor's robot was.
    const Placement& eye() const { return eye_; }

    /// What is true of the subjects that are `asked` for; those that a wall, or another obstacle that is wide, hides
    /// completely are left out. `which`: their places among subjects().
    template <class Asked>
    void describe(const SensorView& view, const Velocity& own, Asked asked, std::vector<SensedState>& states,
                  std::vector<std::uint32_t>& which) {
        findObstructions(view);
        for (std::uint32_t i = 0; i < subjects_.size(); ++i) {
            if (!asked(subjects_[i])) continue;
            SensedState& state = states.emplace_back();
            state.velocity = own;
            if (describe(view, i, state))
                which.push_back(i);
            else
                states.pop_back();
        }
    }

private:
    /// A convex piece that may hide something: who has it, and where it is seen from the sensor.
    struct Obstruction {
        std::uint32_t owner = 0;
        bool obstacle = false, wall = false;
        Point centre;      ///< of a circle that holds it, from the sensor, along the world's axes
        double reach = 0;  ///< its radius
    };
    /// A polygon among them, in the frame of its body.
    struct Outline : Obstruction {
        const ConvexPiece* piece = nullptr;
        Placement frame;  ///< turned as the body, about where the sensor is in it
    };
    struct SightLine;

    void add(SubjectKind kind, std::uint32_t index, const Point& place);
    void placeBodies(const SensorView& view);
    void findObstructions(const SensorView& view);
    bool mayHide(const Point& centre, double reach) const;
    void addBody(const SensorView& view, std::uint32_t body, const Point& place);
    bool describe(const SensorView& view, std::size_t subject, SensedState& state) const;
    Placement frameOfObstacles() const;
    void passObstacle(const SensorView& view, std::uint32_t piece, SightLine& line) const;
    void alongObstacles(const SensorView& view, SightLine& line) const;
    void countOthers(std::size_t subject, SensedState& state) const;

    View limits_, margin_;
    Placement eye_;
    double halfCosine_ = -1, halfSine_ = 0;  ///< of half the margin's field of view
    bool walkObstacles_ = false;             ///< they are so many that each line looks for its own
    std::span<const Point> places_;          ///< of all bodies
    const BodyMap* map_ = nullptr;           ///< of them, where they are many
    std::vector<Point> ownPlaces_;
    std::vector<Subject> subjects_;
    double farthest_ = 0;  ///< m, of the subjects
    std::vector<Obstruction> circles_;
    std::vector<Outline> outlines_;
};

}  // namespace mrose
