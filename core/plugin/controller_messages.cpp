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
    bool failed() const { return false; }
    template <class Element>
    void count(const std::vector<Element>& elements) {
        appendNumber(bytes, static_cast<std::uint32_t>(elements.size()));
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
    /// Every element takes at least a byte.
    template <class Element>
    void count(std::vector<Element>& elements) {
        const auto size = bytes.number<std::uint32_t>();
        elements.clear();
        unsound = unsound || size > bytes.rest().size();
        if (!failed()) elements.resize(size);
    }
};

template <class Visit, class Vector, class Fields>
void each(Visit& visit, Vector& elements, Fields fields) {
    visit.count(elements);
    for (auto& element : elements) {
        if (visit.failed()) return;
        fields(element);
    }
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

template <class Visit, class Bodies>
void visitSeen(Visit& visit, Bodies& bodies) {
    each(visit, bodies, [&](auto& body) {
        visit(body.index);
        visit(body.position_B.x);
        visit(body.position_B.y);
        visit(body.measured);
    });
}

template <class Visit, class O>
void visitObservation(Visit& visit, O& observation) {
    visit(observation.robot);
    visit(observation.time);
    visit(observation.localised);
    visitPose(visit, observation.self);
    visit(observation.selfMeasured);
    visitVelocity(visit, observation.velocity);
    visitSeen(visit, observation.robots);
    visitSeen(visit, observation.objects);
}

template <class Visit, class D>
void visitOrders(Visit& visit, D& decision) {
    each(visit, decision.earlier, [&](auto& earlier) {
        visit(earlier.time);
        visitVelocity(visit, earlier.command);
    });
    each(visit, decision.kicks, [&](auto& kick) {
        visit(kick.manipulator);
        visit(kick.power);
    });
    each(visit, decision.annotations, [&](auto& annotation) {
        visit(annotation.kind);
        visit(annotation.label);
        visit(annotation.value);
        visit(annotation.text);
        each(visit, annotation.points, [&](auto& point) {
            visit(point.x);
            visit(point.y);
        });
    });
    visit(decision.breakReason);
    visit(decision.fault);
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
    writer(decision.command.has_value());
    if (decision.command) visitVelocity(writer, *decision.command);
    visitOrders(writer, decision);
}

bool readDecision(ByteReader& reader, Decision& decision) {
    Reader fields{reader};
    bool commanded = false;
    fields(commanded);
    decision.command.reset();
    if (commanded) visitVelocity(fields, decision.command.emplace());
    visitOrders(fields, decision);
    return !fields.failed();
}

}  // namespace mrose
