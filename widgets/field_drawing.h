#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "debug/field_frame.h"
#include "debug/sensor_looks.h"
#include "debug/sensor_scans.h"
#include "simulation/motion_bands.h"
#include "widgets/field_canvas.h"
#include "widgets/field_layers.h"
#include "widgets/label_placer.h"

namespace mrose {

/// Where robots may be, as far as that is known.
struct RobotBands {
    std::shared_ptr<const MotionBands> bands;  ///< null: it is not
    /// All of a run, whose noise began at the bands' first tick: they lie behind the robots, too. Otherwise what lies
    /// ahead of that tick, or of one shortly after it.
    bool ofRun = false;

    bool tellOf(const FieldFrame& frame) const;
    bool operator==(const RobotBands&) const = default;
};

/// What the eye of the user is on.
struct FieldFocus {
    std::optional<std::size_t> selected, hovered;  ///< bodies
    std::optional<Pose> moved;                     ///< where the selected body is being dragged to
    bool turnable = false;                         ///< the selected robot has a knob to be turned by
    std::vector<std::size_t> lit;                  ///< bodies that an answer is about: all others are quiet; or none
    /// Where each body is in another branch that is looked at beside this one; nullopt: at the same place.
    std::vector<std::optional<Point>> elsewhere;
    RobotBands bands;
    QRectF covered;  ///< pixels over which something else lies: nothing to be read is drawn there

    bool isQuiet(std::size_t body) const;
};

/// Where that knob is: before the robot, on a short stalk.
constexpr double knobRadius = 5;  // pixels
bool hasKnob(const FieldFrame& frame, const FieldFocus& focus);
QPointF knobAt(const ViewTransform& view, const FieldFrame& frame, std::size_t robot);
QRectF knobBox(const ViewTransform& view, const FieldFrame& frame, std::size_t robot);

/// Along the upper and the left edge, where the grid is shown.
constexpr double rulerWidth = 30, rulerHeight = 17;  // pixels

/// A few words beside something; placed when all of a picture are known.
struct FieldLabel {
    std::uint64_t key = 0;  ///< see LabelPlacer
    Point at;
    double clearance = 0;  ///< pixels
    QString text;
    QColor colour;
    std::optional<QColor> chip;  ///< the colour that its robot is known by
    bool first = false;          ///< chooses its place before others
    bool last = false;           ///< chooses it after others
    bool quiet = false;          ///< drawn faintly
    bool note = false;  ///< what a robot believes, not what is there: slanted, with the sign of a note for a chip
};

/// More visible bodies than these are drawn in the plain and fast way.
constexpr std::size_t mostSmooth = 200;
/// Names and numbers of more than these would hide the picture.
constexpr std::size_t mostNames = 80;

/// The length, in pixels, of the arrow of an impulse in N s at so many pixels a metre: weak and strong ones are told
/// apart, and none is longer than longestImpulse, or than 0.6 m where robots are small.
constexpr double longestImpulse = 44;
double impulsePixels(double impulse, double scale);

// The layers of the field's picture, from below to above; each leaves smoothing switched on.

/// The floor's colour as it is drawn.
QColor floorColour(const Environment& environment, const Theme& theme);
/// All that is drawn of an environment, in metres.
Area areaOf(const Environment& environment);
void drawGround(const FieldCanvas& canvas, const Environment& environment);
/// Lines at round metres, and rulers along two edges.
void drawGrid(const FieldCanvas& canvas);
/// How wide and far one looks for others, by what every robot has and by its further cameras; but for those that look
/// nowhere, or everywhere.
std::vector<const BodySight*> sightsOf(const RobotType& type);
void drawSensors(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus);
/// What the sensors of a robot reported last.
struct RobotLooks {
    std::size_t robot = 0;
    std::vector<SensorLook> simulated, real;
};
/// Of all robots where that layer is shown, but only of the selected one where they are too many; without the layer of
/// the selected one beside a real log, if what is real is shown.
std::vector<RobotLooks> shownLooks(const FieldFrame& frame, const FieldLayers& layers, const FieldFocus& focus);
/// From where a sensor was to what it reported: dashed of real robots.
void drawRays(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus,
              const std::vector<RobotLooks>& looks);
/// What was reported, filled of simulated robots and hollow of real ones, with a line to where that truly was.
void drawReadings(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus,
                  const std::vector<RobotLooks>& looks);
/// Of the marks at a place in pixels, a line each; empty: there are none.
QString readingReadout(const ViewTransform& view, const FieldFrame& frame, const std::vector<RobotLooks>& looks,
                       const QPointF& pixels);
/// A mark of them.
constexpr double readingRadius = 3.4;  // pixels
void drawReadingMark(const FieldCanvas& canvas, const QPointF& at, const QColor& colour, bool real,
                     double radius = readingRadius);
/// What the sensors of a robot gave last of its surroundings.
struct RobotScans {
    std::size_t robot = 0;
    std::vector<SensorScan> scans;
};
/// Of all robots those whose layers are shown; where robots are too many, of the selected one alone.
std::vector<RobotScans> shownScans(const FieldFrame& frame, const FieldLayers& layers, const FieldFocus& focus);
bool hasScan(const std::vector<RobotScans>& scans, FieldLayer layer);
/// Below bodies: what a laser's beams passed, from where sonars' echoes came, how much light came back.
void drawScanAreas(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus,
                   const std::vector<RobotScans>& scans);
/// Above them: what beams met; bumpers; rows of pixels.
void drawScanMarks(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus,
                   const std::vector<RobotScans>& scans);
/// How an echo, a bumper and pixels look; angles as Qt's arcs have them, in 1/16 degree.
void drawEcho(QPainter& painter, const QRectF& circle, int first, int span, const QColor& colour);
void drawBumperSegment(const FieldCanvas& canvas, const QPolygonF& line, bool pressed);
/// Neighbouring pixels of a line camera.
void drawPixelStrip(const FieldCanvas& canvas, const QPolygonF& line, ColourClass colourClass);
/// Of the echoes at a place in pixels, a line each; empty: there are none.
QString scanReadout(const ViewTransform& view, const FieldFrame& frame, const std::vector<RobotScans>& scans,
                    const QPointF& pixels);
/// The newest message from each robot to each other one that was due in the last moments; where one is selected, its
/// own above the others. Of many robots the selected one's alone.
std::vector<const RadioLog::Entry*> shownMessages(const FieldFrame& frame, const FieldFocus& focus);
void drawRadio(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus);
/// Of the messages at a place in pixels, a line each; empty: there are none.
QString radioReadout(const ViewTransform& view, const FieldFrame& frame, const FieldFocus& focus,
                     const QPointF& pixels);
/// How one of them looks: `end`: in pixels, where a message out of range ends.
void drawMessage(const FieldCanvas& canvas, const QPointF& from, const QPointF& to, const QColor& colour, double width,
                 Transmission::Outcome outcome, double end);
void drawTrails(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus);
void drawGhosts(const FieldCanvas& canvas, const FieldFrame& frame);
void drawPredicted(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus);
/// Where robots may be, the selected one's above the others: the inner band in the outer one, over the next seconds
/// and, of all of a run, behind them; rings at whole seconds ahead.
void drawBands(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus);
/// Of bands of all of a run, rings about where robots may be now.
void drawRegionsNow(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus);
/// How far ahead the selected robot's reach, at their end.
struct PlacedLabel {
    QRectF box;
    FieldLabel label;
};
std::optional<PlacedLabel> bandLabel(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus);
/// In a robot's colour, on a floor of another one.
void drawBand(QPainter& painter, const QPainterPath& outer, const QPainterPath& inner, const QColor& colour,
              double strength = 1);
/// Where a robot may be at the end of the bands, or that nothing is known of that; empty: there are none.
QString bandReadout(const FieldFrame& frame, const RobotBands& bands, std::size_t body);
/// Where real robots came from and go to in the next seconds, hollow where those of simulated ones are solid.
void drawRealWays(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus);
void drawModelWays(const FieldCanvas& canvas, const FieldFrame& frame);
void drawBodies(const FieldCanvas& canvas, const FieldFrame& frame, bool headings);
void drawFocus(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus);
/// Outlines, and lines from simulated robots to real ones that are elsewhere.
void drawRealRobots(const FieldCanvas& canvas, const FieldFrame& frame, bool headings);
void drawModelRobots(const FieldCanvas& canvas, const FieldFrame& frame, bool headings);
/// How far those in focus are off, and which robots are there in reality only.
void addRealNames(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus,
                  std::vector<FieldLabel>& labels);
void drawBeliefs(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus);
void drawNotes(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus,
               std::vector<FieldLabel>& labels);
void drawContacts(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus,
                  std::vector<FieldLabel>& labels);
void drawKicks(const FieldCanvas& canvas, const FieldFrame& frame, std::vector<FieldLabel>& labels);

void addNames(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus,
              std::vector<FieldLabel>& labels);
/// Off one another and, where that can be, off bodies; never in `kept`, which are others' places.
void drawLabels(const FieldCanvas& canvas, const FieldFrame& frame, std::vector<FieldLabel> labels, LabelPlacer& placer,
                const std::vector<QRectF>& kept = {});
/// Another, where it is described.
void drawPlate(const FieldCanvas& canvas, const QRectF& box, const FieldLabel& label);
QSizeF plateSize(const FieldCanvas& canvas, const FieldLabel& label);
QFont plateFont(const QPainter& painter, bool note = false);

/// The visible bodies, in order.
std::vector<std::size_t> visibleBodies(const FieldCanvas& canvas, const FieldFrame& frame);

}  // namespace mrose
