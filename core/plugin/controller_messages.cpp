#include "plugin/controller_messages.h"

namespace mrose {
namespace {

// Each value is told field by field once, for writing and for reading.

struct Writer {
    std::string& bytes;

    template <class Number>
    void operator()(const Number& value) {
        appendNumber(bytes, value);
    }
    void operator()(const std::string& value) { appendText(value, bytes); }
    template <class Element, class Fields>
    void each(const std::vector<Element>& elements, Fields fields) {
        appendNumber(bytes, static_cast<std::uint32_t>(elements.size()));
        for (const Element& element : elements) fields(element);
    }
};

struct Reader {
    ByteReader& bytes;
    bool unsound = false;

    template <class Number>
    void operator()(Number& value) {
        value = bytes.number<Number>();
    }
    void operator()(bool& value) {
        const auto byte = bytes.number<std::uint8_t>();
        unsound = unsound || byte > 1;
        value = byte != 0;
    }
    void operator()(Annotation::Kind& value) {
        const auto byte = bytes.number<std::uint32_t>();
        unsound = unsound || byte > static_cast<std::uint32_t>(Annotation::Kind::line);
        if (!unsound) value = static_cast<Annotation::Kind>(byte);
    }
    void operator()(std::string& value) { unsound = !readText(bytes, value) || unsound; }
    bool failed() const { return unsound || bytes.failed(); }
    /// Their number is believed as far as there are bytes for them.
    template <class Element, class Fields>
    void each(std::vector<Element>& elements, Fields fields) {
        elements.clear();
        for (auto left = bytes.number<std::uint32_t>(); left > 0 && !failed(); --left) fields(elements.emplace_back());
    }
};

template <class Visit, class A>
void visitAttention(Visit& visit, A& attention) {
    auto& [robots, objects] = attention;
    visit(robots);
    visit(objects);
}

template <class Visit, class P>
void visitPose(Visit& visit, P& pose) {
    visit(pose.x);
    visit(pose.y);
    visit(pose.heading);
}

template <class Visit, class V>
void visitVelocity(Visit& visit, V& velocity) {
    visit(velocity.v);
    visit(velocity.w);
}

// What is taken apart by all of its members does not compile with one that is missing here.

template <class Visit, class Bodies>
void visitSeen(Visit& visit, Bodies& bodies) {
    visit.each(bodies, [&](auto& body) {
        auto& [index, position_B, measured] = body;
        visit(index);
        visit(position_B.x);
        visit(position_B.y);
        visit(measured);
    });
}

template <class Visit, class O>
void visitObservation(Visit& visit, O& observation) {
    auto& [robot, manipulators, time, noise, localised, self, selfMeasured, velocity, robots, objects] = observation;
    visit(robot);
    visit(manipulators);
    visit(time);
    visit(noise);
    visit(localised);
    visitPose(visit, self);
    visit(selfMeasured);
    visitVelocity(visit, velocity);
    visitSeen(visit, robots);
    visitSeen(visit, objects);
}

template <class Visit, class Annotations>
void visitAnnotations(Visit& visit, Annotations& annotations) {
    visit.each(annotations, [&](auto& annotation) {
        auto& [kind, label, value, text, points] = annotation;
        visit(kind);
        visit(label);
        visit(value);
        visit(text);
        visit.each(points, [&](auto& point) {
            visit(point.x);
            visit(point.y);
        });
    });
}

template <class Visit>
void visitCommand(Visit& visit, const std::optional<Command>& command) {
    visit(command.has_value());
    if (command) visitVelocity(visit, *command);
}
template <class Visit>
void visitCommand(Visit& visit, std::optional<Command>& command) {
    bool commanded = false;
    visit(commanded);
    command.reset();
    if (commanded) visitVelocity(visit, command.emplace());
}

template <class Visit, class D>
void visitDecision(Visit& visit, D& decision) {
    auto& [command, earlier, kicks, annotations, breakReason, fault] = decision;
    visitCommand(visit, command);
    visit.each(earlier, [&](auto& issued) {
        auto& [time, velocities] = issued;
        visit(time);
        visitVelocity(visit, velocities);
    });
    visit.each(kicks, [&](auto& kick) {
        auto& [manipulator, power] = kick;
        visit(manipulator);
        visit(power);
    });
    visitAnnotations(visit, annotations);
    visit(breakReason);
    visit(fault);
}

}  // namespace

void appendText(std::string_view text, std::string& bytes) {
    appendNumber(bytes, static_cast<std::uint32_t>(text.size()));
    bytes += text;
}

bool readText(ByteReader& reader, std::string& text) {
    text = reader.take(reader.number<std::uint32_t>());
    return !reader.failed();
}

void appendAttention(const Attention& attention, std::string& bytes) {
    Writer writer{bytes};
    visitAttention(writer, attention);
}

bool readAttention(ByteReader& reader, Attention& attention) {
    Reader fields{reader};
    visitAttention(fields, attention);
    return !fields.failed();
}

void appendObservation(const Observation& observation, std::string& bytes) {
    Writer writer{bytes};
    visitObservation(writer, observation);
}

bool readObservation(ByteReader& reader, Observation& observation) {
    Reader fields{reader};
    visitObservation(fields, observation);
    return !fields.failed();
}

void appendDecision(const Decision& decision, std::string& bytes) {
    Writer writer{bytes};
    visitDecision(writer, decision);
}

bool readDecision(ByteReader& reader, Decision& decision) {
    Reader fields{reader};
    visitDecision(fields, decision);
    return !fields.failed();
}

}  // namespace mrose
