#include "logs/csv_subjects.h"

#include <algorithm>
#include <optional>

#include "io/format.h"

namespace mrose {
namespace {

/// The first column of a row without a time that says nothing of a subject.
std::optional<CsvColumn> strangeColumn(const CsvCells& cells) {
    for (std::size_t i = 0; i < csvColumnNames.size(); ++i) {
        const auto column = static_cast<CsvColumn>(i);
        const bool ofSubject = column == CsvColumn::subject || column == CsvColumn::x || column == CsvColumn::y ||
                               column == CsvColumn::robot;
        if (!ofSubject && cells[column] != nullptr) return column;
    }
    return std::nullopt;
}

bool sameSubject(const LogSubject& one, const LogSubject& other) {
    return one.kind == other.kind && one.robot == other.robot && one.position == other.position;
}

}  // namespace

std::size_t CsvSubjects::named(std::string_view name) {
    const auto known = byName_.find(name);
    if (known != byName_.end()) return known->second;
    byName_.emplace(name, subjects_.size());
    subjects_.push_back({.name = std::string(name)});
    declared_.push_back(false);
    return subjects_.size() - 1;
}

Expected<void> CsvSubjects::declare(const CsvRows& rows, const CsvCells& cells) {
    const CsvCell *name = cells[CsvColumn::subject], *robot = cells[CsvColumn::robot];
    const CsvCell *x = cells[CsvColumn::x], *y = cells[CsvColumn::y];
    if (name == nullptr || strangeColumn(cells))
        return failEmpty(rows, cells.hasColumn(CsvColumn::time) ? CsvColumn::time : CsvColumn::subject);
    if (!isCsvName(name->text)) return failCell(rows, CsvColumn::subject, badCsvName);
    if ((x == nullptr) != (y == nullptr)) return failEmpty(rows, x == nullptr ? CsvColumn::x : CsvColumn::y);
    if (robot != nullptr && x != nullptr)
        return failCell(rows, CsvColumn::robot, "a subject with a position is a landmark, no robot");
    if (robot != nullptr && !isCsvName(robot->text)) return failCell(rows, CsvColumn::robot, badCsvName);
    const std::size_t index = named(name->text);
    LogSubject declared{.name = std::string(name->text)};
    if (x != nullptr) declared.position = Point{x->number, y->number};
    if (robot != nullptr) declared.kind = LogSubject::Kind::robot, declared.robot = robot->text;
    // Every file of a folder may say it.
    if (declared_[index] && !sameSubject(declared, subjects_[index]))
        return failCell(rows, CsvColumn::subject, std::string(name->text) + " is declared twice, differently");
    declared_[index] = true;
    subjects_[index] = std::move(declared);
    return {};
}

std::vector<LogSubject> CsvSubjects::finish(const std::vector<RobotLog>& robots, std::vector<std::string>& incomplete) {
    std::size_t nowhere = 0;
    const LogSubject* first = nullptr;
    for (LogSubject& subject : subjects_) {
        if (subject.position || subject.kind == LogSubject::Kind::robot) continue;
        const bool isRobot = std::any_of(robots.begin(), robots.end(),
                                         [&](const RobotLog& robot) { return robot.robot == subject.name; });
        if (isRobot) {
            subject.kind = LogSubject::Kind::robot;
            subject.robot = subject.name;
        } else if (nowhere++ == 0) {
            first = &subject;
        }
    }
    if (nowhere == 1) incomplete.push_back("Nothing says where subject " + first->name + " stands.");
    if (nowhere > 1)
        incomplete.push_back("Nothing says where " + std::to_string(nowhere) + " of the " +
                             counted(subjects_.size(), "subject") + " stand, " + first->name + " among them.");
    return std::move(subjects_);
}

}  // namespace mrose
