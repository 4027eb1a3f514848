#include "scripting/export_script.h"

#include <QRegularExpression>

#include "export/report_export.h"
#include "export/sequence_export.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

using ScriptValues = std::span<const ScriptValue>;

tl::unexpected<Error> expectedAt(const char* kind, std::size_t place) {
    return fail("", "expected " + std::string(kind) + " as argument " + std::to_string(place + 1));
}

template <class T>
const T* valueAt(ScriptValues values, std::size_t place) {
    return place < values.size() ? std::get_if<T>(&values[place]) : nullptr;
}

/// Left out, or nil.
bool absent(ScriptValues values, std::size_t place) {
    return place >= values.size() || std::holds_alternative<std::monostate>(values[place]);
}

Expected<QSize> sizeFrom(const std::string& text) {
    const auto match = QRegularExpression("^(\\d{1,5})x(\\d{1,5})$").match(qtText(text));
    if (!match.hasMatch()) return fail("", '"' + text + "\" is no size; expected one as \"1280x720\"");
    return QSize(match.captured(1).toInt(), match.captured(2).toInt());
}

Expected<SequenceSettings> settingsFrom(ScriptValues values) {
    SequenceSettings settings;
    double from = 0, to = 0;
    double* const numbers[] = {nullptr, &from, &to, &settings.speed, &settings.framesPerSecond};
    for (std::size_t place = 1; place < std::size(numbers); ++place) {
        if (absent(values, place)) continue;
        const double* number = valueAt<double>(values, place);
        if (number == nullptr) return expectedAt("a number", place);
        *numbers[place] = *number;
    }
    if (!absent(values, 1)) settings.from = from;
    if (!absent(values, 2)) settings.to = to;
    if (!absent(values, 5)) {
        const std::string* text = valueAt<std::string>(values, 5);
        if (text == nullptr) return expectedAt("a size as text", 5);
        const auto size = sizeFrom(*text);
        if (!size) return tl::unexpected(size.error());
        settings.size = *size;
    }
    if (!absent(values, 6)) {
        const std::string* what = valueAt<std::string>(values, 6);
        if (what == nullptr || (*what != "window" && *what != "field")) return expectedAt("\"field\" or \"window\"", 6);
        settings.wholeWindow = *what == "window";
    }
    if (values.size() > 7) return fail("", "takes 7 arguments at the most");
    return settings;
}

Expected<void> sequence(const ScriptedWindow& window, bool film, ScriptValues values) {
    const std::string* path = valueAt<std::string>(values, 0);
    if (path == nullptr || path->empty()) return expectedAt(film ? "a file" : "a folder", 0);
    const auto settings = settingsFrom(values);
    if (!settings) return tl::unexpected(settings.error());
    const QString place = qtText(*path);
    return film ? exportFilm(window.exports, place, *settings) : exportFrames(window.exports, place, *settings);
}

/// The three texts that both reports begin with.
Expected<void> checkTexts(ScriptValues values, const char* usage) {
    for (std::size_t place = 0; place < 3; ++place)
        if (const std::string* text = valueAt<std::string>(values, place); text == nullptr || text->empty())
            return fail("", std::string("expected ") + usage);
    return {};
}

Expected<void> report(const ScriptedWindow& window, ScriptValues values) {
    if (auto fit = checkTexts(values, "a log, a network and a folder"); !fit) return fit;
    EvaluateRequest request{std::get<std::string>(values[1]), std::get<std::string>(values[0])};
    for (std::size_t place = 3; place < values.size(); ++place) {
        const std::string* other = valueAt<std::string>(values, place);
        if (other == nullptr) return expectedAt("a network", place);
        request.against.push_back(*other);
    }
    return exportReport(window.exports, request, qtText(std::get<std::string>(values[2])));
}

Expected<void> comparison(const ScriptedWindow& window, ScriptValues values) {
    if (auto fit = checkTexts(values, "a scenario, a log and a folder"); !fit) return fit;
    CompareRequest request{std::get<std::string>(values[0]), std::get<std::string>(values[1])};
    if (!absent(values, 3)) {
        const double* every = valueAt<double>(values, 3);
        if (every == nullptr || !(*every >= 0.1 && *every <= 1e7)) return expectedAt("a number of seconds", 3);
        request.every = *every;
    }
    return exportComparison(window.exports, request, qtText(std::get<std::string>(values[2])));
}

}  // namespace

std::optional<Expected<void>> exportByScript(const ScriptedWindow& window, const std::string& name,
                                             ScriptValues values) {
    if (name == "export_film") return sequence(window, true, values);
    if (name == "export_sequence") return sequence(window, false, values);
    if (name == "export_report") return report(window, values);
    if (name == "export_comparison") return comparison(window, values);
    return {};
}

}  // namespace mrose::gui
