#pragma once

#include <QColor>
#include <span>
#include <vector>

#include "assessment/reality.h"
#include "debug/plotted_value.h"
#include "widgets/theme.h"

namespace mrose::gui {

/// What curves are drawn on, as far as something has happened.
QColor groundOf(const Theme& theme);

struct CurveLook {
    QColor colour;
    Qt::PenStyle style = Qt::SolidLine;
};

/// How the curves of values are told apart: a model's colour and dashes, or a robot's colour; more curves of one robot
/// on one axis differ in line and lightness, and the real robot's, beside those of no other, in colour. What is no
/// robot's has none of those colours. `values` are those of `keys`; `reality` may be null.
std::vector<CurveLook> looksOf(std::span<const ValueKey> keys, std::span<const PlottedValue> values,
                               const Reality* reality, const Theme& theme);

/// What curves are called beside each other.
struct CurveWords {
    QString label;     ///< what tells one from the others
    QString quantity;  ///< what its axis may be called, with the only body that all are of
    QString group;     ///< the body under whose name it may be listed; empty: none
    QString inGroup;   ///< what it is called there
    QString axis;      ///< the quantity alone
};
/// `own` is the motion model by which the run's robots are moved; empty: not known. Models have their brief names, or
/// all of them. `reality` may be null.
enum class ModelNames { brief, whole };
std::vector<CurveWords> wordsOf(std::span<const ValueKey> keys, std::span<const PlottedValue> values,
                                const Reality* reality, const QString& own, ModelNames names);

}  // namespace mrose::gui
