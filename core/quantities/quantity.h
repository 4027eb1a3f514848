#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "quantities/moment.h"

namespace mrose {

/// A unit of the SI, and how people are shown what has it: angles, which go round, in degrees.
struct Unit {
    const char* name = "";   ///< "m", "rad"; empty: it has none
    int digits = 3;          ///< after the point, of what is shown
    const char* other = "";  ///< the unit in which it is shown instead: "cm"
    double factor = 1;       ///< into that one

    bool isAngle() const { return std::string_view(name) == "rad"; }
    const char* shown() const;            ///< the unit in which it is shown
    double inShown(double number) const;  ///< a number in that unit
};
inline constexpr const char* degreeSign = "\u00b0";
double inDegrees(double radians);  ///< from -180, without it, to 180

/// A number, truth, count or text. A number that is not known is NaN, so that all comparisons with it are false.
using QuantityValue = std::variant<double, bool, std::int64_t, std::string>;

/// What a quantity is read of.
struct Subject {
    const Moment& at;
    std::uint32_t body = noBody;   ///< robots first, then objects; of a goal its number
    std::uint32_t other = noBody;  ///< of a pair the second body; noBody: what stands still
    std::string_view item = {};    ///< of what has several values, each by a name
};

/// Something that can be read of a run at a tick, by the name that conditions have for it. Numbers are in SI units and
/// radians.
struct Quantity {
    /// What has it, and so how it is written.
    enum class Of : std::uint8_t {
        run,           ///< time
        goal,          ///< goals.left
        body,          ///< robot[1].x, ball.x
        robot,         ///< robot[1].v; of a person too, unless it is read from the real robot
        object,        ///< ball.vx
        items,         ///< robot[1].note.distance: values by names that are the robot's own
        pair,          ///< distance(robot[1], ball)
        touchingPair,  ///< touching(robot[1], wall)
        seenPair       ///< seen_x(robot[1], ball): what a robot knows of another body
    };
    /// What of a Moment it is read from, beside scenario, state and trace.
    enum class Needs : std::uint8_t {
        nothing,
        control,  ///< insights; and sensors and controllers must have been asked since then: their memories count
        real      ///< the real robots
    };
    /// A value of its own among the items of a robot.
    struct Item {
        std::string name, unit;
    };
    using Read = std::variant<double (*)(const Subject&), bool (*)(const Subject&), std::int64_t (*)(const Subject&),
                              QuantityValue (*)(const Subject&)>;

    const char* name;
    Unit unit;
    const char* what;  ///< in a line, for people
    Of of;
    Read read;
    bool sampled = false;                                  ///< in every sample of a recording's /bodies
    std::vector<Item> (*items)(const Subject&) = nullptr;  ///< those that there are now, of Of::items
    bool itemsChange = false;                              ///< they come and go with time
    const char* section = "";                              ///< where the inspector lists it; empty: by hand, or nowhere
    Needs needs = Needs::nothing;

    bool isPair() const { return of == Of::pair || of == Of::touchingPair || of == Of::seenPair; }
    /// Of some body alone, or of its items.
    bool isOfBody() const { return of == Of::body || of == Of::robot || of == Of::object || of == Of::items; }
    QuantityValue value(const Subject& subject) const;
};

/// As a plot has it: true is 1; NaN of a text.
double numberOf(const QuantityValue& value);

}  // namespace mrose
