// Where breakpoints are met, found by looking through a branch, against a walk over every tick of it.
#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "debug/breakpoints.h"
#include "support/scenes.h"

namespace mrose {
namespace {

bool goOn(double /*share*/) { return true; }

/// What a condition gives at one tick.
enum class Is { no, yes, failing };

OpenedRun fieldRun(std::uint64_t seed, std::uint32_t robots = 4) {
    OpenedRun run;
    auto scenario = std::make_shared<const Scenario>(fieldScenario({.robots = robots}));
    run.start = scenario->initialState(seed);
    run.setup = std::make_shared<const BranchSetup>(BranchSetup{{}, scenario});
    return run;
}

void runTo(TimeTravel& run, std::int64_t tick) {
    ASSERT_TRUE(run.seek(run.last()));
    while (run.tick() < tick) ASSERT_TRUE(run.forward());
}

/// The same from a tick of the shown branch on, with a robot put elsewhere.
void departAt(TimeTravel& run, std::int64_t tick, double x) {
    Edit edit{"moved"};
    edit.tick = tick;
    edit.change = [x](const Scenario&, WorldState& state) { state.robots[0].pose.x = x; };
    ASSERT_TRUE(run.branchOff(edit));
}

/// At every tick of the shown branch, in their order.
std::vector<Is> walked(TimeTravel& run, const std::string& text) {
    auto condition = compileCondition(text, *run.setup().scenario);
    EXPECT_TRUE(condition) << condition.error().message();
    std::vector<Is> all;
    EXPECT_TRUE(run.seek(run.first()));
    for (;;) {
        const auto held = condition->holds(run.moment());
        all.push_back(!held ? Is::failing : *held ? Is::yes : Is::no);
        if (run.tick() == run.last()) return all;
        EXPECT_TRUE(run.forward());
    }
}

/// Where the search is to come from a tick; -1: nowhere.
std::int64_t lastBefore(const std::vector<Is>& is, std::int64_t tick) {
    std::int64_t at = tick - 1;
    if (at >= 0 && is[static_cast<std::size_t>(at)] == Is::yes) {
        while (at > 0 && is[static_cast<std::size_t>(at - 1)] == Is::yes) --at;
        return at;
    }
    while (at >= 0 && is[static_cast<std::size_t>(at)] == Is::no) --at;
    return at;
}

bool begins(const std::vector<Is>& is, std::size_t at) {
    return is[at] == Is::yes && (at == 0 || is[at - 1] != Is::yes);
}

/// The ticks at which it begins to hold, asked one by one.
std::vector<std::int64_t> beginningsOf(TimeTravel& run, const std::string& text) {
    const std::vector<Is> is = walked(run, text);
    std::vector<std::int64_t> ticks;
    for (std::size_t at = 0; at < is.size(); ++at)
        if (begins(is, at)) ticks.push_back(static_cast<std::int64_t>(at));
    return ticks;
}

std::int64_t nextAfter(const std::vector<Is>& is, std::int64_t tick) {
    for (auto at = static_cast<std::size_t>(tick) + 1; at < is.size(); ++at)
        if (is[at] == Is::failing || begins(is, at)) return static_cast<std::int64_t>(at);
    return -1;
}

std::string someCondition(std::mt19937& random) {
    const auto number = [&](int most) { return std::to_string(random() % static_cast<unsigned>(most)); };
    const std::string robot = "robot[" + std::to_string(1 + random() % 4) + ']';
    switch (random() % 9) {
        case 0:
            return robot + ".x > " + number(8);
        case 8:
            return robot + ".odometry_v > 0." + number(10);
        case 1:
            return robot + ".touching";
        case 2:
            return robot + ".speed > 0." + number(10);
        case 3:
            return "touching(" + robot + ", ball)";
        case 4:
            return "distance(" + robot + ", ball) < " + number(5);
        case 5:
            return "tick % " + number(300) + " == 7";
        case 6:
            return "time > 1" + number(10);
        default:
            return "(function() if tick > 20 and " + robot + ".y > " + number(4) + " then return nil + 1 end return " +
                   robot + ".touching end)()";
    }
}

TEST(TickRanges, AreASetOfTicks) {
    std::mt19937 random(3);
    TickRanges ranges;
    std::set<std::int64_t> ticks;
    for (int i = 0; i < 400; ++i) {
        const auto first = static_cast<std::int64_t>(random() % 900);
        const auto last = first + static_cast<std::int64_t>(random() % (i % 7 == 0 ? 20 : 2));
        ranges.add(first, last);
        for (std::int64_t tick = first; tick <= last; ++tick) ticks.insert(tick);
    }
    for (std::int64_t tick = -2; tick < 930; ++tick) {
        EXPECT_EQ(ranges.contains(tick), ticks.count(tick) == 1) << tick;
        const auto after = ticks.upper_bound(tick), from = ticks.lower_bound(tick);
        EXPECT_EQ(ranges.lastUpTo(tick), after == ticks.begin() ? std::nullopt : std::optional(*std::prev(after)));
        EXPECT_EQ(ranges.firstFrom(tick), from == ticks.end() ? std::nullopt : std::optional(*from));
    }
    for (std::size_t i = 1; i < ranges.ranges().size(); ++i)
        EXPECT_GT(ranges.ranges()[i].first, ranges.ranges()[i - 1].last + 1);
    const auto beginnings = std::count_if(ticks.begin(), ticks.end(), [&](std::int64_t tick) {
        return tick >= 100 && tick <= 700 && ticks.count(tick - 1) == 0;
    });
    EXPECT_EQ(ranges.beginningsWithin(100, 700), beginnings);
}

class BreakSearchTest : public testing::TestWithParam<int> {};

/// Over several blocks, and across the departures of two branches.
TEST_P(BreakSearchTest, FindsWhatAWalkOverAllTicksFinds) {
    std::mt19937 random(static_cast<unsigned>(GetParam()));
    TimeTravel run(fieldRun(static_cast<std::uint64_t>(GetParam())));
    runTo(run, 1700);
    departAt(run, 900 + GetParam(), 2);
    runTo(run, 1900);
    departAt(run, 1400 + 3 * GetParam(), 1);
    runTo(run, 2300);
    ASSERT_EQ(run.first(), 0);
    ConditionEvaluator evaluator;
    for (int i = 0; i < 12; ++i) {
        std::vector<Question> questions{{someCondition(random)}, {someCondition(random)}};
        const std::vector<std::vector<Is>> is{walked(run, questions[0].text), walked(run, questions[1].text)};
        SCOPED_TRACE(questions[0].text + "   " + questions[1].text);
        BreakSearch search(run, evaluator);
        for (int j = 0; j < 60; ++j) {
            const auto tick = static_cast<std::int64_t>(random() % 2301);
            const auto before = search.before(tick, {&questions[0], &questions[1]}, goOn);
            ASSERT_TRUE(before);
            const std::int64_t last = std::max(lastBefore(is[0], tick), lastBefore(is[1], tick));
            EXPECT_EQ(*before ? (*before)->tick : -1, last) << "before " << tick;
            if (*before) {
                EXPECT_EQ((*before)->failed, is[(*before)->question][static_cast<std::size_t>(last)] == Is::failing);
            }
            const auto after = search.after(tick, {&questions[0], &questions[1]}, goOn);
            ASSERT_TRUE(after);
            const std::int64_t a = nextAfter(is[0], tick), b = nextAfter(is[1], tick);
            EXPECT_EQ(*after ? (*after)->tick : -1, a < 0 ? b : b < 0 ? a : std::min(a, b)) << "after " << tick;
        }
        for (bool more = true; more;) {
            const auto learned = search.learn({&questions[0], &questions[1]});
            ASSERT_TRUE(learned);
            more = *learned;
        }
        for (std::size_t q = 0; q < 2; ++q) {
            std::vector<std::int64_t> expected;
            for (std::size_t at = 0; at < is[q].size(); ++at)
                if (begins(is[q], at)) expected.push_back(static_cast<std::int64_t>(at));
            EXPECT_EQ(search.beginnings(questions[q]), expected);
            EXPECT_EQ(search.beginningsUpTo(questions[q], 1500),
                      std::count_if(expected.begin(), expected.end(), [](std::int64_t t) { return t <= 1500; }));
            EXPECT_TRUE(search.knownUpTo(questions[q], 2300));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, BreakSearchTest, testing::Range(1, 5));

TEST(BreakSearch, EndsWhenToldTo) {
    TimeTravel run(fieldRun(1));
    runTo(run, 4000);
    ConditionEvaluator evaluator;
    Question never{"time < 0"};
    int told = 0;
    const auto ended = BreakSearch(run, evaluator).before(4000, {&never}, [&](double share) {
        EXPECT_TRUE(share >= 0 && share <= 1);
        return ++told < 2;
    });
    ASSERT_TRUE(ended);
    EXPECT_FALSE(*ended);
    EXPECT_EQ(told, 2);
    EXPECT_FALSE(BreakSearch(run, evaluator).knownUpTo(never, 4000));
}

TEST(BreakSearch, PredicatesAreLookedForLikeConditions) {
    TimeTravel run(fieldRun(2));
    runTo(run, 1200);
    ConditionEvaluator evaluator;
    Question between{"divergence", [](const BranchTree&, std::uint32_t branch, std::int64_t tick) {
                         return branch == 0 && tick >= 300 && tick < 400;
                     }};
    BreakSearch search(run, evaluator);
    const auto tickOf = [](const BreakSearch::Answer& answer) { return *answer ? (*answer)->tick : -1; };
    EXPECT_EQ(tickOf(search.before(1200, {&between}, goOn)), 399);
    EXPECT_EQ(tickOf(search.before(399, {&between}, goOn)), 300);
    EXPECT_EQ(tickOf(search.before(300, {&between}, goOn)), -1);
    EXPECT_EQ(tickOf(search.after(0, {&between}, goOn)), 300);
    EXPECT_EQ(tickOf(search.after(300, {&between}, goOn)), -1);
}

/// Plays on to where it is stopped, from the shown tick; -1: it is not, up to `end`.
std::int64_t playTo(TimeTravel& run, Breakpoints& breakpoints, std::int64_t end) {
    while (run.tick() < end) {
        breakpoints.leave(run);
        if (!run.forward()) return -2;
        if (breakpoints.arrive(run, goOn)->why) return run.tick();
    }
    return -1;
}

Breakpoint waitingFor(const std::string& text, int from = 1) {
    Breakpoint breakpoint;
    breakpoint.text = text;
    breakpoint.from = from;
    return breakpoint;
}

/// Played, run to, and found backwards: all agree, in what has been as in what has not.
TEST(Breakpoints, StopAtTheBeginningOfEachStretchHoweverTheyAreReached) {
    for (const std::string text :
         {"robot[1].touching", "robot[2].speed > 0.5", "robot[3].heading > 0", "robot[2].odometry_v > 0.5"}) {
        TimeTravel known(fieldRun(5));
        runTo(known, 1500);
        const std::vector<Is> is = walked(known, text);
        std::vector<std::int64_t> expected;
        for (std::size_t at = 1; at < is.size(); ++at)
            if (begins(is, at)) expected.push_back(static_cast<std::int64_t>(at));
        ASSERT_GT(expected.size(), 1u) << text;
        TimeTravel fresh(fieldRun(5));
        for (TimeTravel* run : {&fresh, &known}) {
            Breakpoints breakpoints;
            breakpoints.replace({waitingFor(text)});
            ASSERT_TRUE(run->seek(0));
            std::vector<std::int64_t> stops;
            for (std::int64_t stop = 0; (stop = playTo(*run, breakpoints, 1500)) >= 0;) stops.push_back(stop);
            EXPECT_EQ(stops, expected) << text;
            EXPECT_EQ(breakpoints.states(*run, {})[0].hits,
                      static_cast<std::int64_t>(expected.size()) + (is[0] == Is::yes ? 1 : 0));
        }
        Breakpoints breakpoints;
        breakpoints.replace({waitingFor(text)});
        ASSERT_TRUE(known.seek(0));
        for (const std::int64_t tick : expected) {
            const auto stop = breakpoints.ahead(known, goOn);
            ASSERT_TRUE(stop && *stop);
            EXPECT_EQ((*stop)->tick, tick);
            ASSERT_TRUE(known.seek(tick));
        }
        EXPECT_FALSE(*breakpoints.ahead(known, goOn));
        ASSERT_TRUE(known.seek(1500));
        std::vector<std::int64_t> back;
        while (const auto stop = *breakpoints.last({true}, known, known.tick(), goOn)) {
            back.insert(back.begin(), stop->tick);
            ASSERT_TRUE(known.seek(stop->tick));
        }
        EXPECT_EQ(back, expected) << text;
    }
}

/// Of several the one that began last, though another held longer.
TEST(Breakpoints, BackStopsWhereTheLastStretchOfAnyBegan) {
    TimeTravel run(fieldRun(5));
    runTo(run, 300);
    Breakpoints breakpoints;
    breakpoints.replace({waitingFor("tick >= 20 and tick <= 200"), waitingFor("tick >= 150 and tick <= 160"),
                         waitingFor("tick < 280")});
    std::vector<std::int64_t> back;
    while (const auto stop = *breakpoints.last({true}, run, run.tick(), goOn)) {
        back.push_back(stop->tick);
        ASSERT_TRUE(run.seek(stop->tick));
    }
    EXPECT_EQ(back, (std::vector<std::int64_t>{150, 20}));
}

TEST(Breakpoints, EventsAreThoseOfTheTimeline) {
    for (const bool anyBody : {true, false}) {
        TimeTravel run(fieldRun(5, 12));
        runTo(run, 1500);
        const Scene& scene = run.setup().scene();
        std::uint32_t one = 0;
        for (const TimelineMark& mark : run.branches().marks(run.branch()))
            if (mark.kind == TimelineMark::Kind::contact) one = mark.body;
        std::set<std::int64_t> expected;
        for (const TimelineMark& mark : run.branches().marks(run.branch()))
            if (mark.kind == TimelineMark::Kind::contact && (anyBody || mark.body == one || mark.other == one))
                expected.insert(mark.tick);
        ASSERT_GT(expected.size(), 1u);
        Breakpoints breakpoints;
        breakpoints.replace({waitingFor(anyBody ? "contact" : "contact " + scene.robots[one].name)});
        ASSERT_TRUE(run.seek(0));
        std::set<std::int64_t> stops, back;
        for (std::int64_t stop = 0; (stop = playTo(run, breakpoints, 1500)) >= 0;) stops.insert(stop);
        EXPECT_EQ(stops, expected);
        while (const auto stop = *breakpoints.last({true}, run, run.tick(), goOn)) {
            back.insert(stop->tick);
            ASSERT_TRUE(run.seek(stop->tick));
        }
        EXPECT_EQ(back, expected);
    }
}

/// As playing does: whoever is to stop only once, is off afterwards.
TEST(Breakpoints, AllThatAreMetAtATickStopTogether) {
    TimeTravel run(fieldRun(5, 12));
    runTo(run, 1500);
    std::int64_t contact = 0;
    for (const TimelineMark& mark : run.branches().marks(run.branch()))
        if (mark.kind == TimelineMark::Kind::contact && mark.tick > 9 && contact == 0) contact = mark.tick;
    ASSERT_GT(contact, 9);
    const std::string tick = "tick == " + std::to_string(contact);
    std::vector<Breakpoint> met{waitingFor("contact"), waitingFor(tick), waitingFor(tick + " or tick == 0")};
    for (Breakpoint& breakpoint : met) breakpoint.oneShot = true;
    for (const bool events : {true, false}) {
        met[0].enabled = events;
        const auto off = [&](const auto& find) {
            Breakpoints breakpoints;
            breakpoints.replace(met);
            const auto stop = find(breakpoints);
            EXPECT_TRUE(stop && *stop && (*stop)->tick == contact);
            if (stop && *stop) (void)breakpoints.stopped(run, **stop);
            std::vector<bool> switchedOff;
            for (const Breakpoint& breakpoint : breakpoints.all()) switchedOff.push_back(!breakpoint.enabled);
            return switchedOff;
        };
        ASSERT_TRUE(run.seek(contact - 1));
        EXPECT_EQ(off([&](Breakpoints& of) { return of.ahead(run, goOn); }), std::vector(3, true)) << events;
        ASSERT_TRUE(run.seek(contact + 1));
        EXPECT_EQ(off([&](Breakpoints& of) { return of.last({true}, run, run.tick(), goOn); }), std::vector(3, true))
            << events;
    }
}

TEST(Breakpoints, CountThatIsEndedIsNotTakenForAnAnswer) {
    TimeTravel run(fieldRun(5));
    runTo(run, 1500);
    const std::vector<std::int64_t> ticks = beginningsOf(run, "robot[1].touching");
    ASSERT_GT(ticks.size(), 3u);
    Breakpoints breakpoints;
    breakpoints.replace({waitingFor("robot[1].touching", 3)});
    ASSERT_TRUE(run.seek(ticks[2] - 1));
    breakpoints.leave(run);
    ASSERT_TRUE(run.forward());
    const auto ended = breakpoints.arrive(run, [](double) { return false; });
    ASSERT_TRUE(ended);
    EXPECT_FALSE(ended->known || ended->why);
    const auto counted = breakpoints.arrive(run, goOn);
    ASSERT_TRUE(counted);
    EXPECT_TRUE(counted->known && counted->why);
}

TEST(Breakpoints, StopFromTheNthTimeOnCountedFromTheRunsStart) {
    TimeTravel run(fieldRun(5));
    runTo(run, 1500);
    const std::vector<std::int64_t> ticks = beginningsOf(run, "robot[1].touching");
    ASSERT_GT(ticks.size(), 4u);
    Breakpoints breakpoints;
    breakpoints.replace({waitingFor("robot[1].touching", 3)});
    ASSERT_TRUE(run.seek(0));
    EXPECT_EQ(playTo(run, breakpoints, 1500), ticks[2]);
    // Again from the start, and from where it has not been looked for.
    for (const std::int64_t from : {std::int64_t{0}, ticks[1] + 1}) {
        breakpoints.replace({waitingFor("robot[1].touching", 3)});
        ASSERT_TRUE(run.seek(from));
        EXPECT_EQ(playTo(run, breakpoints, 1500), ticks[2]);
        ASSERT_TRUE(run.seek(from));
        EXPECT_EQ((*breakpoints.ahead(run, goOn))->tick, ticks[2]);
    }
    // The last two were enough already.
    ASSERT_TRUE(run.seek(ticks[3] - 1));
    EXPECT_EQ(playTo(run, breakpoints, 1500), ticks[3]);
}

TEST(Breakpoints, OneThatFailsStopsOnceAndIsOffWithWhatWasWrong) {
    TimeTravel run(fieldRun(1));
    for (const std::string end :
         {"while true do end", "local t = {} while true do t[#t + 1] = {} end", "return nil + 1", "return 5"}) {
        Breakpoints breakpoints;
        breakpoints.replace({waitingFor("(function() if tick >= 40 then " + end + " end return false end)()")});
        ASSERT_TRUE(run.seek(0));
        EXPECT_EQ(playTo(run, breakpoints, 200), 40) << end;
        EXPECT_FALSE(breakpoints.all()[0].enabled);
        const std::string error = breakpoints.all()[0].error;
        EXPECT_TRUE(!error.empty() && error.find('\n') == std::string::npos) << error;
        EXPECT_EQ(playTo(run, breakpoints, 200), -1);
        // Switched on again, it fails again; backwards too.
        Breakpoint again = breakpoints.all()[0];
        again.enabled = true;
        breakpoints.change(again);
        EXPECT_EQ(breakpoints.all()[0].error, "");
        const std::int64_t next = run.tick() + 1;
        EXPECT_EQ(playTo(run, breakpoints, 300), next);
        breakpoints.change(again);
        const auto stop = breakpoints.last({true}, run, run.tick(), goOn);
        ASSERT_TRUE(stop && *stop);
        EXPECT_TRUE((*stop)->failed);
        EXPECT_EQ((*stop)->tick, run.tick() - 1);
    }
}

TEST(Breakpoints, TextsAreChecked) {
    const TimeTravel run(fieldRun(1));
    const auto wrong = [&](const std::string& text) {
        const auto checked = checkBreakText(text, run.setup(), nullptr);
        return checked ? std::string("fits") : wrongWith(checked.error());
    };
    const std::string name = run.setup().scene().robots[1].name;
    for (const std::string& text :
         std::vector<std::string>{"contact", " contact ", "kick", "goal", "fault", "breakHere()", "divergence",
                                  "contact " + name, "kick  " + name})
        EXPECT_EQ(wrong(text), "fits") << text;
    EXPECT_EQ(wrong("robt[1].x > 1"), "unknown name 'robt'; did you mean robot? (at character 1)");
    EXPECT_EQ(wrong("  1 < robot[1].sped").substr(0, 39), "there is no 'sped': a robot has speed, ");
    EXPECT_NE(wrong("  1 < robot[1].sped").find(" (at character 16)"), std::string::npos);
    EXPECT_EQ(wrong("robot[1].error > 1"), "'error' needs a real log beside the run: none is open (at character 10)");
    EXPECT_EQ(wrong("robot[1].x"), "gives the number " + wrong("robot[1].x").substr(17));
    EXPECT_EQ(wrong("kick nobody at all").substr(0, 33), "there is no robot 'nobody at all'");
    EXPECT_EQ(wrong("divergence " + name), "\"divergence\" takes no name");
    EXPECT_EQ(wrong("(function() while true do end end)()"), "does not end within 10000 instructions");
    EXPECT_NE(wrong("(function() local s = 'x' while true do s = s .. s end end)()").find("needs more memory"),
              std::string::npos);
    EXPECT_EQ(wrong("").substr(0, 8), "is empty");
}

/// A question of its own leaves the breakpoints as they are.
TEST(Breakpoints, AnyTextCanBeAskedWhenItLastHeld) {
    TimeTravel run(fieldRun(5));
    runTo(run, 1500);
    const std::vector<Is> is = walked(run, "robot[1].touching");
    Breakpoints breakpoints;
    for (const std::int64_t tick : {1500, 800, 100}) {
        ASSERT_TRUE(run.seek(tick));
        const auto stop = breakpoints.last({true, "robot[1].touching"}, run, run.tick(), goOn);
        ASSERT_TRUE(stop);
        EXPECT_EQ(*stop ? (*stop)->tick : -1, lastBefore(is, tick));
    }
    EXPECT_EQ(breakpoints.all().size(), 1u);
    EXPECT_FALSE(breakpoints.last({true, "robot[1].toching"}, run, run.tick(), goOn));
}

/// Where a description has changed, a condition need not fit both branches.
TEST(Breakpoints, ConditionThatDoesNotFitABranchHoldsNowhereInIt) {
    TimeTravel run(fieldRun(1));
    runTo(run, 600);
    Edit edit{"fewer"};
    edit.tick = 300;
    auto fewer = std::make_shared<const Scenario>(fieldScenario({.robots = 2}));
    edit.setup = std::make_shared<const BranchSetup>(BranchSetup{{}, fewer});
    edit.start = fewer->initialState();
    edit.start->tick = 300;
    for (RobotState& robot : edit.start->robots) robot.nextControl = 300;
    ASSERT_TRUE(run.branchOff(edit));
    runTo(run, 500);
    Breakpoints breakpoints;
    breakpoints.replace({waitingFor("robot[4].x > -100"), waitingFor("#robot == 2")});
    const std::vector<BreakpointState> states = breakpoints.states(run, {});
    EXPECT_NE(states[0].unfit, "");
    EXPECT_EQ(states[1].unfit, "");
    const auto stop = *breakpoints.last({true}, run, run.tick(), goOn);
    ASSERT_TRUE(stop);
    EXPECT_EQ(stop->tick, 300);
    ASSERT_TRUE(run.seek(300));
    // Before it the first holds from the first tick on, where playing never stops.
    const auto before = breakpoints.last({true}, run, run.tick(), goOn);
    ASSERT_TRUE(before);
    EXPECT_FALSE(before->has_value());
}

}  // namespace
}  // namespace mrose
