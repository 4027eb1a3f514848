#pragma once

#include <QColor>
#include <QVector>
#include <cstddef>

#include "geometry/shape.h"
#include "scene/scene.h"

namespace mrose {

/// Colours of everything that is drawn. Quiet surfaces, strong content: one accent for "now" and for what is selected,
/// a fixed colour for each robot, the same in field, plots and lists.
struct Theme {
    QColor surround;                ///< beyond the floor
    QColor panel, text, quietText;  ///< of docks, labels
    QColor line;                    ///< thin lines: axes, grid, frames
    QColor accent;                  ///< now, selection
    QColor contact, kick, target, warning;
    QColor onFloor, halo;  ///< writing on the floor, and what sets it off
    bool dark = false;

    static Theme light();
    static Theme darkOne();
};

/// The colour that a robot is known by: of eight that people with any colour vision can tell apart, then again from the
/// first. They are those of Okabe and Ito 2008, "Color Universal Design", but plum for its green, which is lost on a
/// green field, a lighter blue and a bluish white for its black.
QColor robotColour(std::size_t robot);
/// Of a robot of a scene, in which others may have been left out.
QColor robotColour(const Scene& scene, std::size_t robot);

/// The colour that a motion model is known by where several are laid over one another, then again from the first: dark
/// ones, so that none is taken for a robot's, which people with any colour vision can tell apart (after Tol 2021,
/// "Colour Schemes", muted). Beside it each has a way of dashing lines.
QColor modelColour(std::size_t model);
QVector<qreal> modelDashes(std::size_t model);  ///< empty: a solid line
Qt::PenStyle modelStyle(std::size_t model);     ///< the like of it in a plot

/// A colour that lies between two: `share` 0 ... 1 of the second.
QColor mixed(const QColor& one, const QColor& other, double share);
/// How well two colours are told apart: 1 ... 21, the contrast ratio of WCAG 2.1 with the channels' gamma taken as 2.2.
double contrast(const QColor& a, const QColor& b);
/// As much lighter on a dark ground, or darker on a light one, as it must be to be seen there; of the same hue.
QColor seenOn(const QColor& ground, QColor colour, double leastContrast);
/// Black or white, whichever a colour is seen better on.
QColor setOff(const QColor& colour);

inline QColor toQColor(const Colour& c) { return {c.red, c.green, c.blue}; }

}  // namespace mrose
