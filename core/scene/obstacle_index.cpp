#include "scene/obstacle_index.h"

#include <algorithm>
#include <cmath>

#include "geometry/nearest_point.h"

namespace mrose {
namespace {

constexpr double smallestCell = 0.25;    // m
constexpr double mostCells = 1'000'000;  // a larger place has larger cells

// So many are looked at one by one.
constexpr std::size_t fewPieces = 32;

}  // namespace

ObstacleIndex::Box ObstacleIndex::boxOf(const ConvexPiece& piece) {
    Box box{piece.corners[0], piece.corners[0]};
    for (std::size_t i = 1; i < piece.count; ++i) {
        box.least = {std::min(box.least.x, piece.corners[i].x), std::min(box.least.y, piece.corners[i].y)};
        box.most = {std::max(box.most.x, piece.corners[i].x), std::max(box.most.y, piece.corners[i].y)};
    }
    return {box.least - Point{piece.radius, piece.radius}, box.most + Point{piece.radius, piece.radius}};
}

template <class Visit>
void ObstacleIndex::visitCells(const ConvexPiece& piece, Visit visit) const {
    const Box box = boxOf(piece);
    const auto within = [](double cell, double count) {
        return static_cast<std::size_t>(std::clamp(cell, 0.0, count - 1));
    };
    const Point reach{margin_, margin_}, least = inCells(box.least - reach), most = inCells(box.most + reach);
    for (std::size_t r = within(least.y, size_.y); r <= within(most.y, size_.y); ++r)
        for (std::size_t c = within(least.x, size_.x); c <= within(most.x, size_.x); ++c) {
            // A slanted wall's box is much larger than the wall.
            const Point centre =
                corner_ + Point{(static_cast<double>(c) + 0.5) * cell_, (static_cast<double>(r) + 0.5) * cell_};
            if (leastDistance(piece, centre) < cell_ * 0.7072 + margin_) visit(cellOf(c, r));
        }
}

/// About as many cells as pieces.
void ObstacleIndex::makeCoarseGrid(const Box& all) {
    if (pieces_.size() <= fewPieces) return;
    const Point size = all.most - all.least;
    const auto count = static_cast<double>(pieces_.size());
    const double side = std::max({std::sqrt(size.x * size.y / count), size.x / count, size.y / count, 1e-3});
    coarse_.corner = all.least;
    coarse_.perCell = 1 / side;
    coarse_.columns = static_cast<std::size_t>(size.x / side) + 1;
    coarse_.rows = static_cast<std::size_t>(size.y / side) + 1;
    coarse_.begins.assign(coarse_.columns * coarse_.rows + 1, 0);
    const auto visitCoarseCells = [&](const Box& box, auto visit) {
        for (std::size_t row = coarse_.rowOf(box.least.y); row <= coarse_.rowOf(box.most.y); ++row)
            for (std::size_t column = coarse_.columnOf(box.least.x); column <= coarse_.columnOf(box.most.x); ++column)
                visit(row * coarse_.columns + column);
    };
    for (const Box& box : boxes_) visitCoarseCells(box, [&](std::size_t cell) { ++coarse_.begins[cell + 1]; });
    for (std::size_t i = 1; i < coarse_.begins.size(); ++i) coarse_.begins[i] += coarse_.begins[i - 1];
    coarse_.entries.resize(coarse_.begins.back());
    std::vector<std::uint32_t> filled(coarse_.begins.begin(), coarse_.begins.end() - 1);
    for (std::uint32_t i = 0; i < boxes_.size(); ++i)
        visitCoarseCells(boxes_[i], [&](std::size_t cell) { coarse_.entries[filled[cell]++] = i; });
}

ObstacleIndex::ObstacleIndex(const Environment& environment, double margin)
    : landmarks_(landmarksOf(environment)), margin_(margin) {
    std::vector<Point> places;
    for (const Landmark& landmark : landmarks_) places.push_back(landmark.position);
    landmarkGrid_.fill(places, 0, 1);
    for (std::uint32_t i = 0; i < environment.obstacles.size(); ++i)
        for (const ConvexPiece& piece : environment.obstacles[i].shape.pieces) {
            all_.push_back(static_cast<std::uint32_t>(pieces_.size()));
            pieces_.push_back(piece);
            boxes_.push_back(boxOf(piece));
            surfaces_.push_back(environment.obstacles[i].surface);
            obstacles_.push_back(i);
            ofWall_.push_back(environment.obstacles[i].wall ? 1 : 0);
        }
    if (pieces_.empty()) return;
    Box all = boxes_.front();
    for (const Box& box : boxes_) {
        all.least = {std::min(all.least.x, box.least.x), std::min(all.least.y, box.least.y)};
        all.most = {std::max(all.most.x, box.most.x), std::max(all.most.y, box.most.y)};
    }
    makeCoarseGrid(all);
    corner_ = all.least - Point{margin, margin};
    const Point size = all.most + Point{margin, margin} - corner_;
    cell_ = std::max(
        {smallestCell, margin / 2, std::sqrt(size.x * size.y / mostCells), std::max(size.x, size.y) / mostCells});
    perCell_ = 1 / cell_;
    columns_ = static_cast<std::size_t>(size.x * perCell_) + 1;
    rows_ = static_cast<std::size_t>(size.y * perCell_) + 1;
    size_ = {static_cast<double>(columns_), static_cast<double>(rows_)};
    begins_.assign(columns_ * rows_ + 1, 0);
    struct Entry {
        std::size_t cell;
        std::uint32_t piece;
    };
    std::vector<Entry> found;
    for (std::uint32_t i = 0; i < pieces_.size(); ++i)
        visitCells(pieces_[i], [&](std::size_t cell) {
            found.push_back({cell, i});
            ++begins_[cell + 1];
        });
    for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
    entries_.resize(begins_.back());
    std::vector<std::uint32_t> filled(begins_.begin(), begins_.end() - 1);
    for (const Entry& entry : found) entries_[filled[entry.cell]++] = entry.piece;
}

}  // namespace mrose
