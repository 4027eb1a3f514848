#include "panels/curve_looks.h"

#include <QObject>
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "diagnosis/other_models.h"
#include "widgets/qt_text.h"

namespace mrose::gui {

QColor groundOf(const Theme& theme) { return theme.dark ? theme.surround : QColor(Qt::white); }

namespace {

constexpr std::array styles{Qt::SolidLine, Qt::DashLine, Qt::DotLine};

/// Of a curve and its ground: on a light one less, where a robot's yellow would else be brown.
double leastContrast(const Theme& theme) { return theme.dark ? 4.5 : 3; }

/// One robot's curves on one axis are told apart by their lines, and by how light they are: the second is darker where
/// that is still seen.
QColor variant(const QColor& colour, int which, const Theme& theme) {
    constexpr double apart = 1.5;  // contrast with the first
    const auto shaded = [&](bool lighter) {
        QColor shade = colour;
        for (int i = 0; i < 16 && contrast(shade, colour) < apart; ++i) {
            const QColor next = lighter ? shade.lighter(112) : shade.darker(112);
            const double before = contrast(shade, groundOf(theme)), after = contrast(next, groundOf(theme));
            if (after < before && after < leastContrast(theme)) break;
            shade = next;
        }
        return shade;
    };
    const QColor darker = shaded(false), lighter = shaded(true);
    const bool darkerFirst = contrast(darker, colour) >= apart;
    return which == 0 ? colour : darkerFirst == (which == 1) ? darker : lighter;
}

/// What a real robot did, beside what is simulated of it.
bool isReal(const ValueKey& key) { return key.quantity.starts_with("real_"); }

/// Of the overlaid motion model that a number is of; nullopt: of none.
std::optional<std::size_t> modelOf(const ValueKey& key, const Reality* reality) {
    if (reality == nullptr || key.of.empty() || !readsReality(key)) return {};
    const std::vector<Reality::ModelRollout>& models = reality->models;
    const auto found = std::find_if(models.begin(), models.end(),
                                    [&](const Reality::ModelRollout& model) { return model.name == key.of; });
    if (found == models.end()) return {};
    return static_cast<std::size_t>(found - models.begin());
}

}  // namespace

std::vector<CurveLook> looksOf(std::span<const ValueKey> keys, std::span<const PlottedValue> values,
                               const Reality* reality, const Theme& theme) {
    std::vector<CurveLook> looks;
    std::map<std::pair<std::uint32_t, std::string>, int> used;
    std::map<std::pair<std::size_t, std::string>, int> usedOfModels;
    std::map<std::string, int> usedOfReal;
    const std::array others{theme.text, theme.contact, theme.accent, theme.quietText};
    std::map<std::string, std::set<std::uint32_t>> robots;  // of each unit
    for (const PlottedValue& value : values)
        if (value.colourOf) robots[value.unit].insert(*value.colourOf);
    const double seen = leastContrast(theme);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const PlottedValue& value = values[i];
        if (const auto model = modelOf(keys[i], reality)) {
            const QColor base = seenOn(groundOf(theme), modelColour(*model), seen);
            const int which = usedOfModels[{*model, value.unit}]++ % static_cast<int>(styles.size());
            looks.push_back({variant(base, which, theme), modelStyle(*model)});
            continue;
        }
        if (!value.colourOf) {
            looks.push_back({others[static_cast<std::size_t>(used[{noBody, {}}]++) % others.size()]});
            continue;
        }
        // The real one of a robot alone is in the colour of writing; of several the colours tell which robot it is.
        if (isReal(keys[i]) && robots[value.unit].size() == 1) {
            const auto which = static_cast<std::size_t>(usedOfReal[value.unit]++) % styles.size();
            looks.push_back({theme.text, styles[which]});
            continue;
        }
        const QColor base = seenOn(groundOf(theme), robotColour(*value.colourOf), seen);
        const int which = used[{*value.colourOf, value.unit}]++ % static_cast<int>(styles.size());
        looks.push_back({variant(base, which, theme), styles[static_cast<std::size_t>(which)]});
    }
    return looks;
}

namespace {

bool isExpression(const ValueKey& key) { return key.quantity == expressionQuantity; }

/// What the names of several quantities end with, in whole words: of "v" and "real_v" it is "v".
QString commonEnd(const std::set<QString>& quantities) {
    if (quantities.size() < 2) return {};
    QStringList common = quantities.begin()->split('_');
    for (const QString& quantity : quantities) {
        const QStringList words = quantity.split('_');
        int same = 0;
        while (same < std::min(words.size(), common.size()) &&
               words[words.size() - 1 - same] == common[common.size() - 1 - same])
            ++same;
        common = common.mid(common.size() - same);
    }
    return common.join('_');
}

/// Quantities that end alike differ in the rest of their names.
QString reportingPart(const QString& quantity, const std::set<QString>& all, const Reality* reality) {
    const QString end = commonEnd(all);
    if (end.isEmpty()) return quantity;
    if (quantity != end) {
        const QString left = quantity.chopped(end.size() + 1);
        return left == "real" && reality != nullptr ? reality->real() : left;
    }
    return all.count("real_" + end) > 0 ? QObject::tr("simulated") : quantity;
}

/// A value's name without its body and its model.
QString quantityOf(const ValueKey& key, const PlottedValue& value) {
    if (isExpression(key)) return {};
    const QString body = qtText(key.body) + "  ", model = qtText(key.of) + ": ";
    QString words = qtText(value.name);
    if (words.startsWith(body)) words.remove(0, body.size());
    if (isError(key) && words.startsWith(model)) words.remove(0, model.size());
    return words;
}

}  // namespace

std::vector<CurveWords> wordsOf(std::span<const ValueKey> keys, std::span<const PlottedValue> values,
                                const Reality* reality, const QString& own, ModelNames names) {
    const auto called = [&](const std::string& model) {
        return qtText(names == ModelNames::brief ? briefName(model) : model);
    };
    std::set<std::string> bodies;
    std::map<std::string, std::set<QString>> quantities;  // of each unit
    bool models = !own.isEmpty();
    for (std::size_t i = 0; i < values.size(); ++i) {
        bodies.insert(keys[i].body);
        quantities[values[i].unit].insert(quantityOf(keys[i], values[i]));
        models = models || (isError(keys[i]) && !keys[i].of.empty());
    }
    std::vector<CurveWords> words;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const QString body = qtText(keys[i].body), quantity = quantityOf(keys[i], values[i]);
        if (isExpression(keys[i])) {
            const QString name = qtText(values[i].name);
            words.push_back({name, {}, {}, name, name});
            continue;
        }
        const std::set<QString>& beside = quantities[values[i].unit];
        const QString end = commonEnd(beside), measured = end.isEmpty() ? quantity : end;
        QStringList parts;
        if (beside.size() > 1) parts << reportingPart(quantity, beside, reality);
        if (models && isError(keys[i]))
            parts << (!keys[i].of.empty() ? called(keys[i].of) : !own.isEmpty() ? own : QObject::tr("run"));
        // An axis of different quantities has no title that tells whose they are.
        const bool nothing = parts.isEmpty(), several = bodies.size() > 1 || (end.isEmpty() && beside.size() > 1);
        CurveWords& one = words.emplace_back();
        one.quantity = several || nothing ? measured : body + ": " + measured;
        one.axis = measured;
        if (nothing) parts << body;
        one.inGroup = parts.join("  ");
        one.label = several && !nothing ? body + "  " + one.inGroup : one.inGroup;
        if (several && !nothing) one.group = body;
    }
    // Under a body's name nothing is called by that.
    const bool grouped = std::any_of(words.begin(), words.end(), [](const auto& one) { return !one.group.isEmpty(); });
    for (std::size_t i = 0; grouped && i < words.size(); ++i)
        if (words[i].group.isEmpty() && !isExpression(keys[i])) {
            words[i].group = qtText(keys[i].body);
            words[i].inGroup = words[i].axis;
        }
    return words;
}

}  // namespace mrose::gui
