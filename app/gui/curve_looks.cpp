#include "curve_looks.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace mrose::gui {
namespace {

constexpr double leastContrast = 1.9;  // of a curve and its ground
constexpr std::array styles{Qt::SolidLine, Qt::DashLine, Qt::DotLine};

QColor groundOf(const Theme& theme) { return theme.dark ? theme.surround : QColor(Qt::white); }

/// One robot's curves on one axis are told apart by their lines, and by how light they are.
QColor variant(const QColor& colour, int which, const Theme& theme) {
    constexpr double apart = 2.2, leastOfVariant = 2.6;  // contrasts: with the first, and with the ground
    const auto shaded = [&](bool lighter) {
        QColor shade = colour;
        for (int i = 0; i < 16 && contrast(shade, colour) < apart; ++i) {
            const QColor next = lighter ? shade.lighter(112) : shade.darker(112);
            const double before = contrast(shade, groundOf(theme)), after = contrast(next, groundOf(theme));
            if (after < before && after < leastOfVariant) break;
            shade = next;
        }
        return shade;
    };
    const QColor darker = shaded(false), lighter = shaded(true);
    const bool darkerIsFarther = contrast(darker, colour) > contrast(lighter, colour);
    return which == 0 ? colour : darkerIsFarther == (which == 1) ? darker : lighter;
}

/// Of the overlaid motion model that a number is of; nothing: of none.
std::optional<std::size_t> modelOf(const ValueKey& key, const Reality* reality) {
    if (reality == nullptr || key.of.empty() || !readsReality(key)) return {};
    const std::vector<Reality::ModelCourse>& models = reality->models;
    const auto found = std::find_if(models.begin(), models.end(),
                                    [&](const Reality::ModelCourse& model) { return model.name == key.of; });
    if (found == models.end()) return {};
    return static_cast<std::size_t>(found - models.begin());
}

}  // namespace

std::vector<CurveLook> looksOf(std::span<const ValueKey> keys, std::span<const PlottedValue> values,
                               const Reality* reality, const Theme& theme) {
    std::vector<CurveLook> looks;
    std::map<std::pair<std::uint32_t, QString>, int> used;
    std::map<std::pair<std::size_t, QString>, int> usedOfModels;
    const std::array others{theme.text, theme.contact, theme.accent, theme.quietText};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const PlottedValue& value = values[i];
        if (const auto model = modelOf(keys[i], reality)) {
            const QColor base = seenOn(groundOf(theme), modelColour(*model), leastContrast);
            const int which = usedOfModels[{*model, value.unit}]++ % static_cast<int>(styles.size());
            looks.push_back({variant(base, which, theme), modelStyle(*model)});
            continue;
        }
        if (!value.colourOf) {
            looks.push_back({others[static_cast<std::size_t>(used[{noBody, {}}]++) % others.size()]});
            continue;
        }
        const QColor base = seenOn(groundOf(theme), robotColour(*value.colourOf), leastContrast);
        const int which = used[{*value.colourOf, value.unit}]++ % static_cast<int>(styles.size());
        looks.push_back({variant(base, which, theme), styles[static_cast<std::size_t>(which)]});
    }
    return looks;
}

}  // namespace mrose::gui
