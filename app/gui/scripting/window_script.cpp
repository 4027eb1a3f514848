#include "scripting/window_script.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QTimer>
#include <QWindow>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include <lua.hpp>

#include "condition/condition.h"
#include "export/view_export.h"
#include "frame/actions.h"
#include "frame/docks.h"
#include "panels/plot_panel.h"
#include "panels/time_bar.h"
#include "reality/error_plot.h"
#include "reality/overlay.h"
#include "scripting/export_script.h"
#include "scripting/overlay_script.h"
#include "scripting/script_world.h"
#include "widgets/field_view.h"
#include "widgets/qt_text.h"

// As Qt's own tests send keys: through the window system's queue, so that shortcuts are looked at, too. Qt exports it
// for them and declares it in no header.
QT_BEGIN_NAMESPACE
Q_GUI_EXPORT void qt_handleKeyEvent(QWindow* window, QEvent::Type type, int key, Qt::KeyboardModifiers modifiers,
                                    const QString& text, bool autorepeat, ushort count);
QT_END_NAMESPACE

namespace mrose::gui {
namespace {

/// Of a call: what Lua gave, and gets.
using Value = ScriptValue;
using Values = std::vector<Value>;

constexpr LuaLimits scriptLimits{std::size_t{16} << 20, std::size_t{1} << 20, 1'000'000};
/// More are no tour but a loop without an end.
constexpr int mostCalls = 100'000;

/// A function of a script yields its own name and what it was given.
int yieldCall(lua_State* lua) {
    lua_pushvalue(lua, lua_upvalueindex(1));
    lua_insert(lua, 1);
    return lua_yield(lua, lua_gettop(lua));
}

Values takeValues(lua_State* lua) {
    Values values;
    for (int i = 1; i <= lua_gettop(lua); ++i) {
        switch (lua_type(lua, i)) {
            case LUA_TBOOLEAN:
                values.emplace_back(lua_toboolean(lua, i) != 0);
                break;
            case LUA_TNUMBER:
                values.emplace_back(static_cast<double>(lua_tonumber(lua, i)));
                break;
            case LUA_TSTRING:
                values.emplace_back(std::string(lua_tostring(lua, i)));
                break;
            default:
                values.emplace_back();
        }
    }
    lua_settop(lua, 0);
    return values;
}

void giveValue(lua_State* lua, const Value& value) {
    if (const bool* truth = std::get_if<bool>(&value))
        lua_pushboolean(lua, static_cast<int>(*truth));
    else if (const double* number = std::get_if<double>(&value))
        lua_pushnumber(lua, *number);
    else if (const std::string* text = std::get_if<std::string>(&value))
        lua_pushlstring(lua, text->data(), text->size());
    else
        lua_pushnil(lua);
}

/// What a call was given, taken by place from 0. The first thing that does not fit is kept.
class Given {
public:
    explicit Given(const Values& values) : values_(values) {}

    std::string text(std::size_t i) { return take<std::string>(i, "a text"); }
    double number(std::size_t i) { return take<double>(i, "a number"); }
    bool truth(std::size_t i) { return take<bool>(i, "true or false"); }
    bool has(std::size_t i) const { return i < values_.size(); }
    const Value& any(std::size_t i) const { return values_[i]; }
    const std::optional<Error>& error() const { return error_; }

private:
    template <class T>
    T take(std::size_t i, const char* kind) {
        const T* value = has(i) ? std::get_if<T>(&values_[i]) : nullptr;
        if (value != nullptr) return *value;
        if (!error_)
            error_ = Error{"", 0, 0, "", "expected " + std::string(kind) + " as argument " + std::to_string(i + 1)};
        return T{};
    }

    const Values& values_;
    std::optional<Error> error_;
};

std::string plainNumber(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.10g", value);
    return text;
}

void sendKey(QWindow* window, int key, Qt::KeyboardModifiers modifiers, const QString& text) {
    qt_handleKeyEvent(window, QEvent::KeyPress, key, modifiers, text, false, 1);
    qt_handleKeyEvent(window, QEvent::KeyRelease, key, modifiers, text, false, 1);
}

class WindowScript {
public:
    WindowScript(const ScriptedWindow& window, const std::string& source, const ScriptOutput& output)
        : window_(window), source_(source), output_(output), sandbox_(scriptLimits), world_(sandbox_, window) {
        for (const std::string& name : scriptFunctions(window.frame.actions)) addFunction(name);
    }

    Expected<ScriptOutcome> run(std::string_view text) {
        lines_ = text;
        const auto statements = sandbox_.loadStatements(text, source_);
        if (!statements) return tl::unexpected(statements.error());
        settle();
        for (int calls = 0, given = 0;; given = 1) {
            world_.update();
            const auto more = sandbox_.proceed(*statements, given);
            if (!more) return tl::unexpected(more.error());
            if (!*more) return outcome_;
            line_ = sandbox_.lineOf(*statements);
            Values values = takeValues(statements->thread);
            const std::string name = std::get<std::string>(values.front());
            values.erase(values.begin());
            const auto answer = ++calls > mostCalls
                                    ? fail("", "is one call too many: a script ends after " + std::to_string(mostCalls))
                                    : call(name, values);
            if (!answer) return fail(source_, name + "(): " + answer.error().message(), line_);
            settle();
            if (!window_.frame.window.isVisible()) return outcome_;
            giveValue(statements->thread, *answer);
        }
    }

    using Function = Expected<Value> (WindowScript::*)(Given&);
    static const std::map<std::string, Function>& functions() {
        static const std::map<std::string, Function> all{
            {"select", &WindowScript::select},
            {"open_log", &WindowScript::openLog},
            {"reality", &WindowScript::reality},
            {"worst", &WindowScript::worst},
            {"plot", &WindowScript::plot},
            {"drag", &WindowScript::drag},
            {"pause", &WindowScript::pause},
            {"seek", &WindowScript::seek},
            {"seek_tick", &WindowScript::seekTick},
            {"run_until", &WindowScript::runUntil},
            {"speed", &WindowScript::speed},
            {"wait", &WindowScript::wait},
            {"screenshot", &WindowScript::screenshot},
            {"press", &WindowScript::press},
            {"type", &WindowScript::type},
            {"expect", &WindowScript::expect},
            {"hash", &WindowScript::hash},
            {"say", &WindowScript::say},
        };
        return all;
    }

private:
    void addFunction(const std::string& name) {
        lua_State* const lua = sandbox_.state();
        lua_pushstring(lua, name.c_str());
        lua_pushcclosure(lua, yieldCall, 1);
        sandbox_.addName(name.c_str());
    }

    void settle() { gui::settle(window_); }

    Expected<Value> call(const std::string& name, const Values& values) {
        const auto found = functions().find(name);
        if (const auto exported = exportByScript(window_, name, values)) {
            if (!*exported) return tl::unexpected(exported->error());
            return Value{};
        }
        if (found == functions().end()) return perform(name, values);
        Given given(values);
        auto answer = (this->*found->second)(given);
        if (given.error()) return tl::unexpected(*given.error());
        return answer;
    }

    Expected<Value> perform(const std::string& name, const Values& values) {
        Actions::Argument argument;
        if (values.size() > 1) return fail("", "takes one argument");
        if (!values.empty()) {
            const Value& value = values.front();
            if (const bool* on = std::get_if<bool>(&value)) argument = *on;
            if (const std::string* text = std::get_if<std::string>(&value)) argument = qtText(*text);
            if (const double* number = std::get_if<double>(&value)) {
                if (*number != std::floor(*number) || *number < 0 || *number > mostCalls)
                    return fail("", plainNumber(*number) + " is no number of times");
                argument = static_cast<int>(*number);
            }
        }
        if (auto done = window_.frame.actions.perform(qtText(name), argument); !done)
            return tl::unexpected(done.error());
        return Value{};
    }

    const FieldFrame& frame() const { return *window_.frame.shown()->frame; }

    Expected<std::size_t> body(const Given& given) const {
        const Value value = given.has(0) ? given.any(0) : Value{};
        const double* number = std::get_if<double>(&value);
        const std::string* name = std::get_if<std::string>(&value);
        return bodyCalled(frame(), number != nullptr ? plainNumber(*number) : name != nullptr ? *name : "");
    }

    Expected<Value> select(Given& given) {
        const auto which = body(given);
        if (!which) return tl::unexpected(which.error());
        window_.field.setSelected(*which);
        return Value{};
    }

    /// Its robot file, where the log does not say it: open_log("mine.csv", "husky.toml").
    Expected<Value> openLog(Given& given) {
        const std::string log = given.text(0), robotFile = given.has(1) ? given.text(1) : "";
        if (given.error()) return Value{};
        if (auto opened = openLogByScript(window_, log, robotFile); !opened) return tl::unexpected(opened.error());
        return Value{};
    }

    /// Of the log that is laid over: reality("p").
    Expected<Value> reality(Given& given) {
        const std::string what = given.text(0);
        if (given.error()) return Value{};
        Expected<void> done;
        Value value = overlayValue(window_, what, done);
        if (!done) return tl::unexpected(done.error());
        return value;
    }

    /// The rollout that is so far down in the list: worst(1).
    Expected<Value> worst(Given& given) {
        const double place = given.has(0) ? given.number(0) : 1;
        if (given.error()) return Value{};
        if (auto opened = openWorst(window_, static_cast<int>(std::clamp(place, 0.0, 1e6))); !opened)
            return tl::unexpected(opened.error());
        return Value{};
    }

    /// A number of the inspector: plot("red 2", "speed").
    Expected<Value> plot(Given& given) {
        const auto which = body(given);
        if (!which) return tl::unexpected(which.error());
        const std::string quantity = given.text(1), of = given.has(2) ? given.text(2) : "";
        if (given.error()) return Value{};
        if (auto added = window_.plots.add({quantity, frame().nameOf(*which), of}); !added)
            return tl::unexpected(added.error());
        return Value{};
    }

    Expected<Value> drag(Given& given) {
        const auto which = body(given);
        if (!which) return tl::unexpected(which.error());
        const double heading = given.has(3) ? given.number(3) : frame().poseOf(*which).heading;
        const Pose pose{given.number(1), given.number(2), heading};
        if (given.error()) return Value{};
        if (!std::isfinite(pose.x + pose.y + pose.heading)) return fail("", "expected finite numbers");
        if (window_.frame.shown()->playing)
            return fail("", "bodies can be dragged while the run stands; pause() comes first");
        emit window_.field.bodyMoved(*which, pose);
        return Value{};
    }

    Expected<Value> pause(Given& /*given*/) {
        window_.frame.session.pause();
        return Value{};
    }

    Expected<Value> seek(Given& given) {
        const double tick = given.number(0) / toSeconds(frame().scene().tickLength);
        return given.error() ? Value{} : goTo(tick);
    }

    Expected<Value> seekTick(Given& given) {
        const double tick = given.number(0);
        return given.error() ? Value{} : goTo(tick);
    }

    Expected<Value> goTo(double tick) {
        if (!(tick >= 0 && tick <= 1e9)) return fail("", "is no time of this run");
        window_.overlay.shown().seek(std::llround(tick));
        return Value{};
    }

    Expected<Value> runUntil(Given& given) {
        const std::string text = given.text(0);
        const double most = given.has(1) ? given.number(1) : 60;
        if (given.error()) return Value{};
        const Nanoseconds tickLength = frame().scene().tickLength;
        const double ticks = std::floor(most / toSeconds(tickLength) + 1e-6);
        if (!(ticks >= 0 && ticks <= 1e9)) return fail("", "expected a number of seconds");
        auto condition = compileCondition(text, *frame().scenario, "condition", frame().reality.get());
        if (!condition) return tl::unexpected(condition.error());
        Expected<bool> held = false;
        window_.frame.session.pause();
        window_.frame.session.doLongWork(
            QObject::tr("Running until %1").arg(qtText(text)), [&](TimeTravel& run, const Progress& progress) {
                held = goUntil(run, *condition, static_cast<std::int64_t>(ticks), progress);
            });
        window_.frame.session.settle();
        if (!held) return tl::unexpected(held.error());
        return Value{*held};
    }

    static Expected<bool> goUntil(TimeTravel& run, Condition& condition, std::int64_t ticks, const Progress& progress) {
        for (std::int64_t i = 0;; ++i) {
            auto held = condition.holds(run.moment());
            if (!held || *held || i == ticks) return held;
            if (auto done = run.forward(); !done) return tl::unexpected(done.error());
            if (!progress(static_cast<double>(i) / static_cast<double>(ticks))) return false;
        }
    }

    Expected<Value> speed(Given& given) {
        const double speed = given.number(0);
        if (given.error()) return Value{};
        if (!(speed >= 0 && speed <= 1e6)) return fail("", "expected a speed, or 0 for as fast as possible");
        window_.time.setSpeed(speed);
        return Value{};
    }

    /// Until all is done and shown, and so many seconds.
    Expected<Value> wait(Given& given) {
        const double seconds = given.has(0) ? given.number(0) : 0;
        if (!(seconds >= 0 && seconds <= 3600)) return fail("", "expected seconds, 3600 at the most");
        QElapsedTimer since;
        since.start();
        while (window_.frame.window.isVisible() && static_cast<double>(since.elapsed()) < 1e3 * seconds) letPass(20);
        gui::settle(window_);
        return Value{};
    }

    Expected<Value> screenshot(Given& given) {
        const QString file = qtText(given.text(0));
        const QString what = given.has(1) ? qtText(given.text(1)) : "window";
        if (given.error()) return Value{};
        gui::settle(window_);
        QWidget* widget = what == "window" ? &window_.frame.window : window_.frame.window.findChild<QWidget*>(what);
        if (widget == nullptr) return fail("", what.toStdString() + " is no part of the window");
        if (Docks::isFolded(*widget))
            return fail("", "the panel \"" + what.toStdString() + "\" is folded, as it has nothing to show");
        if (auto saved = writeWidget(*widget, file); !saved) return tl::unexpected(saved.error());
        return Value{};
    }

    Expected<Value> press(Given& given) {
        const QString keys = qtText(given.text(0));
        if (given.error()) return Value{};
        const QKeySequence sequence(keys, QKeySequence::PortableText);
        if (sequence.count() == 0 || (sequence[0] & ~Qt::KeyboardModifierMask) == Qt::Key_unknown)
            return fail("", keys.toStdString() + " is no key; expected one as \"Space\" or \"Ctrl+Z\"");
        for (int i = 0; i < sequence.count(); ++i) {
            const auto key = static_cast<unsigned>(sequence[static_cast<uint>(i)]);
            const Qt::KeyboardModifiers modifiers(static_cast<int>(key & Qt::KeyboardModifierMask));
            const int plain = static_cast<int>(key & ~Qt::KeyboardModifierMask);
            sendKey(focusWindow(), plain, modifiers, plain < 0x80 ? QString(QChar(plain)).toLower() : QString());
            settle();
        }
        return Value{};
    }

    Expected<Value> type(Given& given) {
        for (const QChar letter : qtText(given.text(0)))
            sendKey(focusWindow(), letter.toUpper().unicode(), Qt::NoModifier, letter);
        return Value{};
    }

    QWindow* focusWindow() const {
        QWindow* focused = QGuiApplication::focusWindow();
        return focused != nullptr ? focused : window_.frame.window.windowHandle();
    }

    Expected<Value> expect(Given& given) {
        const bool holds = given.truth(0);
        const std::string message = given.has(1) ? given.text(1) : lineText();
        if (given.error()) return Value{};
        ++outcome_.expected;
        if (holds) return Value{true};
        ++outcome_.failed;
        output_.mistaken(Error{source_, line_, 0, "", "expected " + message}.message());
        return Value{false};
    }

    /// What the line in the script expects.
    std::string lineText() const {
        std::string_view rest = lines_;
        for (int i = 1; i < line_; ++i) rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
        std::string_view line = rest.substr(0, rest.find('\n'));
        const auto begin = line.find("expect");
        const auto open = line.find('(', begin), close = line.rfind(')');
        if (begin == std::string_view::npos || open >= close || close == std::string_view::npos)
            return "what is not so";
        return std::string(line.substr(open + 1, close - open - 1));
    }

    Expected<Value> hash(Given& /*given*/) { return Value{stateText(*window_.frame.shown())}; }

    Expected<Value> say(Given& given) {
        std::string words;
        for (std::size_t i = 0; given.has(i); ++i) {
            const Value& value = given.any(i);
            const double* number = std::get_if<double>(&value);
            const bool* truth = std::get_if<bool>(&value);
            const std::string* text = std::get_if<std::string>(&value);
            words += i == 0 ? "" : " ";
            words += number != nullptr  ? plainNumber(*number)
                     : truth != nullptr ? (*truth ? "true" : "false")
                     : text != nullptr  ? *text
                                        : "?";
        }
        output_.said(words);
        return Value{};
    }

    const ScriptedWindow& window_;
    std::string source_;
    const ScriptOutput& output_;
    LuaSandbox sandbox_;
    ScriptWorld world_;
    std::string_view lines_;
    int line_ = 0;
    ScriptOutcome outcome_;
};

}  // namespace

std::vector<std::string> scriptFunctions(const Actions& actions) {
    std::vector<std::string> names;
    for (const Actions::Group& group : actions.groups())
        for (const QAction* action : group.actions) names.push_back(action->objectName().toStdString());
    for (const auto& [name, run] : WindowScript::functions()) names.push_back(name);
    return names;
}

void settle(const ScriptedWindow& window) {
    window.frame.session.settle();
    window.overlay.settle();
    window.frame.session.settle();
    QApplication::processEvents();
    window.errors.settle();
    window.plots.settle();
    QApplication::processEvents();
}

void letPass(int duration) {
    QEventLoop loop;
    QTimer::singleShot(duration, &loop, &QEventLoop::quit);
    loop.exec();
}

std::string stateText(const Shown& shown) {
    return QString("%1").arg(shown.hash.world, 16, 16, QChar('0')).toStdString();
}

Expected<std::size_t> bodyCalled(const FieldFrame& frame, const std::string& text) {
    const std::size_t count = frame.scene().bodyCount();
    std::string names;
    for (std::size_t i = 0; i < count; ++i) {
        if (frame.nameOf(i) == text) return i;
        names += (i == 0 ? "" : ", ") + frame.nameOf(i);
    }
    for (std::size_t i = 0; i < count; ++i)
        if (std::to_string(i + 1) == text) return i;
    return fail("", "expected one of " + names + ", or its number from 1");
}

Expected<ScriptOutcome> runScript(const ScriptedWindow& window, std::string_view text, const std::string& source,
                                  const ScriptOutput& output) {
    const bool unattended = window.frame.actions.unattended();
    window.frame.actions.setUnattended(true);
    auto outcome = WindowScript(window, source, output).run(text);
    window.frame.actions.setUnattended(unattended);
    return outcome;
}

}  // namespace mrose::gui
