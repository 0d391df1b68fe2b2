// Sensors: the readings of one sensor of many robots, value by value.
#include <nanobind/ndarray.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <type_traits>
#include <variant>

#include "bindings.h"
#include "roboss/model/addressee.h"
#include "simulation.h"

namespace nb = nanobind;
using namespace roboss;

namespace roboss_python {

namespace {

/// One value of the readings of all robots, one robot behind the other.
struct Column {
    std::string name, unit;
    const char* type =
        "float";  // "float", "int", "bool", "vector", "quat" (x y z w), "list", "text", "image"
    std::vector<double> numbers;
    std::vector<std::string> texts;
    std::vector<std::size_t> counts;  // numbers, texts or samples of each robot
    std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<float>> samples;
    std::vector<int> shape;  // of each image: rows, columns, channels
    bool alike = true;       // all images have this shape
};

void add(Column& column, std::initializer_list<double> numbers) {
    column.numbers.insert(column.numbers.end(), numbers);
    column.counts.push_back(numbers.size());
}

void add(Column& column, const Vec3& v) {
    column.type = "vector";
    add(column, {v.x, v.y, v.z});
}

void add(Column& column, const Quat& q) {
    column.type = "quat";
    add(column, {q.x, q.y, q.z, q.w});
}

void add(Column& column, const std::vector<double>& values) {
    column.type = "list";
    column.numbers.insert(column.numbers.end(), values.begin(), values.end());
    column.counts.push_back(values.size());
}

void add(Column& column, const std::vector<std::string>& texts) {
    column.type = "text";
    column.texts.insert(column.texts.end(), texts.begin(), texts.end());
    column.counts.push_back(texts.size());
}

template <class T>
void add(Column& column, const Image<T>& image) {
    column.type = "image";
    if (!std::holds_alternative<std::vector<T>>(column.samples)) {
        column.alike = column.alike && column.counts.empty();
        column.samples = std::vector<T>();
    }
    auto& samples = std::get<std::vector<T>>(column.samples);
    samples.insert(samples.end(), image.samples.begin(), image.samples.end());
    column.counts.push_back(image.samples.size());
    const std::vector<int> shape{image.rows, image.columns, image.channels};
    if (column.shape.empty()) column.shape = shape;
    column.alike = column.alike && column.shape == shape;
}

template <class T>
requires std::is_arithmetic_v<T>
void add(Column& column, T value) {
    if (std::is_same_v<T, bool>)
        column.type = "bool";
    else if (std::is_integral_v<T>)
        column.type = "int";
    add(column, {static_cast<double>(value)});
}

/// One number of a sensor for each robot.
using Sensors = std::vector<std::size_t>;

/// Adds the readings of the robots of one run.
Result<> read_all(RunAccess& run, const std::vector<std::uint32_t>& robots, const Sensors& sensors,
                  std::vector<Column>& columns) {
    for (const Result<Sample>& sample : run.read_all(robots, sensors)) {
        if (!sample) return sample.error();
        std::size_t at = 0;
        visit_fields(sample.value(), [&](const ReadingField& field, const auto& value) {
            if (at == columns.size())
                columns.push_back({field.name, field.unit, "float", {}, {}, {}, {}, {}});
            add(columns[at++], value);
        });
    }
    return Ok{};
}

/// Adds the values of another simulation behind these.
void append(std::vector<Column>& columns, const std::vector<Column>& more) {
    const auto add_all = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    for (std::size_t c = 0; c < columns.size(); ++c) {
        add_all(columns[c].numbers, more[c].numbers);
        add_all(columns[c].texts, more[c].texts);
        add_all(columns[c].counts, more[c].counts);
        std::visit([&]<class Samples>(Samples& to) { add_all(to, std::get<Samples>(more[c].samples)); },
                   columns[c].samples);
    }
}

template <class T>
nb::object to_array(std::vector<T>&& numbers) {
    auto* const kept = new std::vector<T>(std::move(numbers));
    const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
    return nb::cast(nb::ndarray<nb::numpy, T>(kept->data(), {kept->size()}, owner));
}

nb::object values_of(Column& column) {
    const std::string type = column.type;
    if (type == "text") return nb::cast(column.texts);
    if (type != "image") return to_array(std::move(column.numbers));
    return std::visit([](auto& samples) { return to_array(std::move(samples)); }, column.samples);
}

/// A list of (name, unit, type, numbers or texts, how many of them each robot has, shape of an image),
/// simulation by simulation.
nb::list read(const Simulations& simulations, const std::vector<std::uint32_t>& robots,
              const Sensors& sensors) {
    std::vector<std::vector<Column>> parts(simulations.size());
    std::vector<Result<>> done(simulations.size(), Ok{});
    for_each_run(simulations,
                 [&](std::size_t i, RunAccess& run) { done[i] = read_all(run, robots, sensors, parts[i]); });
    for (const Result<>& one : done)
        if (!one) raise("SensorError", one.error());
    std::vector<Column> columns = std::move(parts.front());
    for (std::size_t i = 1; i < parts.size(); ++i) append(columns, parts[i]);
    nb::list result;
    for (Column& column : columns) {
        if (!column.alike)
            raise("SensorError", {"the robots' cameras make images of different sizes or kinds",
                                  "read robots of one type at a time", "mixed-shapes"});
        result.append(nb::make_tuple(column.name, column.unit, column.type, values_of(column), column.counts,
                                     column.shape));
    }
    return result;
}

/// Sends a message by a radio of each robot: payloads[i] by row i, simulation by simulation, `to`: names of
/// the addressees, "" for all who hear it. All of them, or, if one is refused, none.
void transmit(const Simulations& simulations, const std::vector<std::uint32_t>& robots,
              const Sensors& sensors, const std::vector<nb::bytes>& payloads,
              const std::vector<std::string>& to) {
    std::vector<std::vector<Order>> orders(simulations.size());
    for (std::size_t s = 0; s < simulations.size(); ++s) {
        const Model& model = simulations[s]->access().model();
        for (std::size_t r = 0; r < robots.size(); ++r) {
            const std::size_t row = s * robots.size() + r;
            const RobotId robot(robots[r]);
            const Result<std::uint32_t> radio = radio_number(model, robot, sensors[r]);
            if (!radio) raise("SensorError", radio.error());
            Transmit message{radio.value(), {}, {}};
            if (!to[row].empty()) {
                const auto found = find_addressee(model, to[row]);
                if (!found)
                    raise("UnknownNameError", {"no robot has the name or the address '" + to[row] + "'",
                                               "World.robots has the names", "no-robot"});
                message.to = *found;
            }
            const auto* bytes = reinterpret_cast<const std::uint8_t*>(payloads[row].c_str());
            message.payload.assign(bytes, bytes + payloads[row].size());
            Order order;
            order.robot = robot, order.action = std::move(message);
            order.apply_at = simulations[s]->access().tick();
            if (const Result<> checked = check_order(model, order); !checked)
                raise("OrderError", checked.error());
            orders[s].push_back(std::move(order));
        }
    }
    for (std::size_t s = 0; s < simulations.size(); ++s)
        if (const Result<> given = simulations[s]->access().order(std::move(orders[s])); !given)
            raise("OrderError", given.error());
}

/// For each robot, simulation by simulation, the messages that its radio received since the last call:
/// (sender, addressee or "", sent at s, arrived at s, channel, strength dBm, payload).
nb::list received(const Simulations& simulations, const std::vector<std::uint32_t>& robots,
                  const Sensors& sensors) {
    using Messages = Result<std::vector<RadioMessage>>;
    std::vector<std::vector<Messages>> all(simulations.size());
    for_each_run(simulations, [&](std::size_t i, RunAccess& run) {
        for (std::size_t r = 0; r < robots.size(); ++r)
            all[i].push_back(run.received(RobotId(robots[r]), sensors[r]));
    });
    nb::list result;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Model& model = simulations[i]->access().model();
        for (const Messages& messages : all[i]) {
            if (!messages) raise("SensorError", messages.error());
            nb::list row;
            for (const RadioMessage& m : messages.value())
                row.append(nb::make_tuple(
                    model.robots[m.from.index()].name, m.to.valid() ? model.robots[m.to.index()].name : "",
                    static_cast<double>(m.sent) * model.dt_s, static_cast<double>(m.arrived) * model.dt_s,
                    m.channel, m.strength_dBm,
                    nb::bytes(reinterpret_cast<const char*>(m.payload.data()), m.payload.size())));
            result.append(std::move(row));
        }
    }
    return result;
}

/// BoxCameraSpec::type; "": it is no such camera.
std::string box_type(const std::shared_ptr<Simulation>& simulation, std::uint32_t robot, std::size_t sensor) {
    const RobotType& type = simulation->access().model().type_of(RobotId(robot));
    const auto* camera = type.sensors[sensor].spec.as<BoxCameraSpec>();
    return camera != nullptr ? camera->type : "";
}

/// Of a laser: its link, its pose in the link (p, then the quaternion x y z w), the angles of its columns and
/// rows, rad.
nb::tuple laser_beams(const std::shared_ptr<Simulation>& simulation, std::uint32_t robot,
                      std::size_t sensor) {
    const SensorInfo& info = simulation->access().model().type_of(RobotId(robot)).sensors[sensor];
    const auto* laser = info.spec.as<LaserSpec>();
    if (laser == nullptr) return nb::make_tuple();
    const Vec3& p = info.spec.X_LS.p;
    const Quat& q = info.spec.X_LS.q;
    return nb::make_tuple(static_cast<std::size_t>(info.link.index()),
                          std::vector<double>{p.x, p.y, p.z, q.x, q.y, q.z, q.w}, laser->column_angles(),
                          laser->row_angles());
}

}  // namespace

void bind_readings(nb::module_& module) {
    module.def("read", &read, nb::arg("simulations"), nb::arg("robots"), nb::arg("sensors"));
    module.def("transmit", &transmit, nb::arg("simulations"), nb::arg("robots"), nb::arg("sensors"),
               nb::arg("payloads"), nb::arg("to"));
    module.def("received", &received, nb::arg("simulations"), nb::arg("robots"), nb::arg("sensors"));
    module.def("box_type", &box_type, nb::arg("simulation"), nb::arg("robot"), nb::arg("sensor"));
    module.def("laser_beams", &laser_beams, nb::arg("simulation"), nb::arg("robot"), nb::arg("sensor"));
}

}  // namespace roboss_python
