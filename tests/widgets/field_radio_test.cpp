// Messages between robots on the field and in the inspector.
#include <QImage>

#include <gtest/gtest.h>

#include "widgets/field_drawing.h"
#include "widgets/field_fixture.h"
#include "widgets/inspector_rows.h"

namespace mrose {
namespace {

using Outcome = Transmission::Outcome;

/// Discs on a line, and what the first tells the others; now is tick 100.
class FieldRadioTest : public testing::Test {
protected:
    FieldRadioTest() {
        view.setSize({800, 640});
        view.fit({{-5, -4}, {5, 4}}, {0, 0, 800, 640});
        frame.state.tick = 100;
    }
    void tell(std::uint32_t from, std::uint32_t to, std::int64_t tick, Outcome outcome) {
        RadioLog::Entry entry{tick, {}, {}};
        entry.message.tick = tick - 5;
        entry.message.from = from;
        entry.message.kind = 7;
        entry.message.size = 16;
        const double numbers[] = {1.5, -20};
        std::memcpy(entry.message.bytes.data(), numbers, sizeof numbers);
        entry.message.position = position(frame.poseOf(from));
        entry.transmission = {0, to, (tick - 5) * 20'000'000 + 60'000'000, position(frame.poseOf(to)), outcome};
        frame.radio.due.push_back(entry);
        frame.radio.sent.push_back(entry.message);
    }
    /// Pixels that the layer changes, between two points, m.
    int changed(const Point& from, const Point& to, const FieldFocus& focus = {}) const {
        const QImage without = painted({}, focus), with = painted({FieldLayer::radio}, focus);
        int count = 0;
        const QRectF box = QRectF(view.toPixels(from), view.toPixels(to)).normalized().adjusted(-8, -8, 8, 8);
        for (const QPoint& pixel : differences(without, with)) count += box.contains(pixel) ? 1 : 0;
        return count;
    }
    QImage painted(std::initializer_list<FieldLayer> layers, const FieldFocus& focus) const {
        return paintedFrame(frame, view, only(layers), focus);
    }

    ViewTransform view;
    FieldFrame frame = frameOfDiscs({{-4, 0, 0}, {0, 0, 0}, {4, 2, 0}});
};

TEST_F(FieldRadioTest, LeadsFromSenderToReceiverAndFades) {
    EXPECT_EQ(changed({-5, -4}, {5, 4}), 0);
    tell(0, 1, 99, Outcome::received);
    EXPECT_GT(changed({-3.5, 0}, {-0.5, 0}), 200);
    EXPECT_EQ(changed({0.6, -4}, {5, 4}), 0);
    EXPECT_EQ(shownMessages(frame, {}).size(), 1u);
    frame.state.tick = 118;
    EXPECT_GT(changed({-3.5, 0}, {-0.5, 0}), 100) << "0.38 s later";
    frame.state.tick = 119;
    EXPECT_EQ(changed({-5, -4}, {5, 4}), 0) << "0.4 s later";
}

TEST_F(FieldRadioTest, EndsAtTheRangeWhereItIsOutOfRange) {
    ScenarioParts parts = frame.scenario->parts();
    parts.scene.radio.range = 1.5;
    frame.scenario = std::make_shared<const Scenario>(parts);
    tell(0, 1, 99, Outcome::outOfRange);
    EXPECT_GT(changed({-3.6, 0}, {-2.6, 0}), 20);
    EXPECT_EQ(changed({-2.2, 0}, {0, 0}), 0);
}

TEST_F(FieldRadioTest, LinesSayWhatTheyAre) {
    tell(0, 1, 99, Outcome::received);
    tell(0, 2, 99, Outcome::lost);
    const auto said = [&](const Point& at) {
        return radioReadout(view, frame, {}, view.toPixels(at) + QPointF(0, 3)).toStdString();
    };
    EXPECT_EQ(said({-2, 0}), "robot 1 to robot 2, sent at 1.88 s: kind 7, 16 B, 100 ms");
    EXPECT_EQ(said({2, 1.5}), "robot 1 to robot 3, sent at 1.88 s: kind 7, 16 B, lost");
    EXPECT_EQ(said({-2, 0.5 * 2 / 3}), "") << "between both lines";
    EXPECT_EQ(said({-4, 0}), "") << "within the sender";
}

TEST_F(FieldRadioTest, LostOnesAreCrossed) {
    tell(0, 1, 99, Outcome::received);
    const int arrow = changed({-2.05, 0.1}, {-1.95, -0.1});
    frame.radio.due.clear();
    tell(0, 1, 99, Outcome::lost);
    EXPECT_GT(changed({-2.05, 0.1}, {-1.95, -0.1}), arrow) << "in the middle";
}

TEST_F(FieldRadioTest, TheNewestOfEachPairIsShownAndTheSelectedRobotsLast) {
    tell(0, 1, 97, Outcome::lost);
    tell(1, 0, 98, Outcome::received);
    tell(1, 2, 98, Outcome::received);
    tell(0, 1, 99, Outcome::received);
    const auto shown = shownMessages(frame, {.selected = 2});
    ASSERT_EQ(shown.size(), 3u);
    EXPECT_EQ(shown.back()->transmission.to, 2u);
    for (const RadioLog::Entry* entry : shown) {
        EXPECT_EQ(entry->transmission.outcome, Outcome::received);
    }
}

TEST_F(FieldRadioTest, TheInspectorSaysWhatWasToldAndHowLate) {
    tell(0, 1, 98, Outcome::lost);
    tell(0, 1, 99, Outcome::received);
    const auto rowsOfRadio = [&](std::size_t body) {
        for (InspectorRow& row : inspectorRows(frame, body, [](const QString&) { return true; }))
            if (row.name == "Radio") return row;
        return InspectorRow{};
    };
    const auto child = [](const InspectorRow& row, const QString& name) {
        for (const InspectorRow& one : row.children)
            if (one.name == name) return one;
        ADD_FAILURE() << name.toStdString();
        return InspectorRow{};
    };
    const InspectorRow received = child(rowsOfRadio(1), "Received"), sent = child(rowsOfRadio(0), "Sent");
    EXPECT_EQ(received.value, "2 in the last second");
    ASSERT_EQ(received.children.size(), 2u);
    EXPECT_EQ(received.children[0].value, "kind 7, 16 B, 100 ms") << "the newest first";
    EXPECT_TRUE(received.children[0].tip.contains("arrived 60 ms later")) << received.children[0].tip.toStdString();
    EXPECT_EQ(received.children[1].value, "kind 7, 16 B, lost");
    EXPECT_TRUE(received.children[1].quiet);
    EXPECT_EQ(child(received.children[0], "as numbers").value, "1.5, -20");
    EXPECT_EQ(child(received.children[0], "0").value, "00 00 00 00 00 00 f8 3f");
    ASSERT_EQ(sent.children.size(), 2u);
    EXPECT_EQ(sent.children[0].name, "all");
    EXPECT_EQ(child(rowsOfRadio(2), "Received").value, "none");
}

}  // namespace
}  // namespace mrose
