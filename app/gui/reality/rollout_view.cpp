#include "reality/rollout_view.h"

#include <algorithm>

#include "widgets/field_view.h"

namespace mrose::gui {

void RolloutView::showNear() {
    constexpr double margin = 0.25, least = 1.2;  // of its size; m
    const RolloutRow* const row = rollouts_.shownRow();
    if (row == nullptr || row->area.empty()) return;
    const LogWorld& world = rollouts_.world();
    const double reach = world.parts().scene.shapeOf(world.robots()[row->robot].body).reach;
    const Point middle = row->area.middle(), size = row->area.most - row->area.least;
    const auto half = [&](double length) { return std::max(least / 2, (1 + margin) * (length / 2 + reach)); };
    const Point reaches{half(size.x), half(size.y)};
    field_.viewport().fit({middle - reaches, middle + reaches});
}

/// Whether the rollout of the robot that is asked about lies outside of the view.
bool RolloutView::isAside() const {
    const RolloutRow* const row = rollouts_.shownRow();
    if (row == nullptr) return false;
    const Area seen = field_.transform().shown();
    return row->area.most.x < seen.least.x || row->area.least.x > seen.most.x || row->area.most.y < seen.least.y ||
           row->area.least.y > seen.most.y;
}

void RolloutView::showNearer() {
    if (field_.viewport().showsAll() || isAside()) showNear();
}

void RolloutView::showNearIfAside() {
    if (isAside()) showNear();
}

void RolloutView::select(std::size_t robot) {
    const std::uint32_t body = bodyNamed(session_.current()->frame->scene(), rollouts_.world().robots()[robot].name);
    if (body != noBody) field_.setSelected(body);
}

RolloutView::Kept RolloutView::keep(std::optional<std::size_t> robot, bool sameLog) const {
    Kept kept{absent_, robot.has_value()};
    if (robot)
        kept.selected = rollouts_.world().robots()[*robot].name;
    else if (const auto body = field_.selected(); body && session_.current() != nullptr)
        kept.selected = session_.current()->frame->nameOf(*body);
    if (!sameLog) return kept;
    kept.near = robot || field_.viewport().showsPart();
    if (!field_.viewport().showsAll()) kept.view = field_.transform();
    return kept;
}

/// In another rollout a body has another number.
void RolloutView::selectAgain(const Kept& kept) {
    if (kept.selected.empty()) return;
    const std::uint32_t body = bodyNamed(session_.current()->frame->scene(), kept.selected);
    const bool there = body != noBody;
    absent_ = there ? std::string() : kept.selected;
    field_.setSelected(there ? std::optional<std::size_t>(body) : std::nullopt);
}

void RolloutView::showAgain(const Kept& kept) {
    if (kept.view) field_.setView(*kept.view);
    if (kept.near || isAside()) showNear();
}

}  // namespace mrose::gui
