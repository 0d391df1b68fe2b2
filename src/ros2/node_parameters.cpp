// See node_parameters.h.
#include "ros2/node_parameters.h"

#include <algorithm>
#include <chrono>
#include <set>

namespace roboss::ros2 {

namespace rcl = rcl_interfaces;

namespace {

Time wall_time() {
    const auto ns = std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
    return {static_cast<std::int32_t>(ns / 1'000'000'000), static_cast<std::uint32_t>(ns % 1'000'000'000)};
}

}  // namespace

NodeParameters::NodeParameters(Transport& transport, EntityId node, const std::string& full_name)
    : transport_(transport), full_name_(full_name), table_(transport, node) {
    const Result<EntityId> events = transport.add_publisher(
        node, "/parameter_events", type_of<rcl::ParameterEvent>(), {true, false, 1000});
    if (events)
        events_ = events.value();
    else
        table_.notice(events.error().text());
    add_questions(full_name);
    add_setters(full_name);
}

NodeParameters::~NodeParameters() {
    if (events_ != 0) transport_.remove(events_);
}

void NodeParameters::add_questions(const std::string& full_name) {
    table_.add<rcl::GetParameters>(full_name + "/get_parameters",
                                   [this](const auto& request, const auto& reply) {
                                       rcl::GetParameters::Response response;
                                       for (const std::string& name : request.names)
                                           response.values.push_back(value(name));
                                       reply(response);
                                   });
    table_.add<rcl::GetParameterTypes>(full_name + "/get_parameter_types",
                                       [this](const auto& request, const auto& reply) {
                                           rcl::GetParameterTypes::Response response;
                                           for (const std::string& name : request.names)
                                               response.types.push_back(value(name).type);
                                           reply(response);
                                       });
    table_.add<rcl::DescribeParameters>(full_name + "/describe_parameters",
                                        [this](const auto& request, const auto& reply) {
                                            rcl::DescribeParameters::Response response;
                                            for (const std::string& name : request.names)
                                                response.descriptors.push_back(describe(name));
                                            reply(response);
                                        });
    table_.add<rcl::ListParameters>(
        full_name + "/list_parameters",
        [this](const auto& request, const auto& reply) { reply({list(request)}); });
}

void NodeParameters::add_setters(const std::string& full_name) {
    table_.add<rcl::SetParameters>(full_name + "/set_parameters",
                                   [this](const auto& request, const auto& reply) {
                                       rcl::SetParameters::Response response;
                                       std::vector<rcl::Parameter> changed;
                                       for (const rcl::Parameter& wanted : request.parameters) {
                                           response.results.push_back(may_set(wanted));
                                           if (!response.results.back().successful) continue;
                                           entries_[wanted.name].value = wanted.value;
                                           changed.push_back(wanted);
                                       }
                                       reply(response);
                                       if (!changed.empty()) publish({}, std::move(changed));
                                   });
    table_.add<rcl::SetParametersAtomically>(
        full_name + "/set_parameters_atomically", [this](const auto& request, const auto& reply) {
            for (const rcl::Parameter& wanted : request.parameters)
                if (const rcl::SetParametersResult result = may_set(wanted); !result.successful)
                    return reply({result});
            for (const rcl::Parameter& wanted : request.parameters)
                entries_[wanted.name].value = wanted.value;
            reply({{true, ""}});
            if (!request.parameters.empty()) publish({}, request.parameters);
        });
}

void NodeParameters::put(const std::string& name, const rcl::ParameterValue& value,
                         const std::string& description) {
    put_settable(name, value, description, {});
}

void NodeParameters::put_settable(const std::string& name, const rcl::ParameterValue& value,
                                  const std::string& description, Check check) {
    const bool is_new = !entries_.contains(name);
    entries_[name] = {value, description, std::move(check)};
    std::vector<rcl::Parameter> one{{name, value}};
    if (is_new)
        publish(std::move(one), {});
    else
        publish({}, std::move(one));
}

rcl::ParameterValue NodeParameters::value(const std::string& name) const {
    const auto entry = entries_.find(name);
    return entry == entries_.end() ? rcl::ParameterValue{} : entry->second.value;
}

rcl::ParameterDescriptor NodeParameters::describe(const std::string& name) const {
    rcl::ParameterDescriptor descriptor;
    descriptor.name = name;
    const auto entry = entries_.find(name);
    if (entry == entries_.end()) return descriptor;
    descriptor.type = entry->second.value.type;
    descriptor.description = entry->second.description;
    descriptor.read_only = !entry->second.check;
    return descriptor;
}

/// Names in a prefix, down to a depth, as rcl lists them: "a.b" has the prefix "a".
rcl::ListParametersResult NodeParameters::list(const rcl::ListParameters::Request& request) const {
    const auto fits = [&](const std::string& name, const std::string& prefix) {
        if (name == prefix) return true;
        if (!prefix.empty() && !name.starts_with(prefix + ".")) return false;
        const std::string_view rest = std::string_view(name).substr(prefix.empty() ? 0 : prefix.size() + 1);
        return request.depth == 0 ||
               static_cast<std::uint64_t>(std::ranges::count(rest, '.')) < request.depth;
    };
    rcl::ListParametersResult result;
    std::set<std::string> prefixes;
    for (const auto& entry : entries_) {
        const std::string& name = entry.first;
        const auto has = [&](const std::string& prefix) { return fits(name, prefix); };
        if (request.prefixes.empty() ? !fits(name, "") : std::ranges::none_of(request.prefixes, has))
            continue;
        result.names.push_back(name);
        if (const std::size_t dot = name.rfind('.'); dot != std::string::npos)
            prefixes.insert(name.substr(0, dot));
    }
    result.prefixes.assign(prefixes.begin(), prefixes.end());
    return result;
}

rcl::SetParametersResult NodeParameters::may_set(const rcl::Parameter& wanted) const {
    const auto entry = entries_.find(wanted.name);
    if (entry == entries_.end()) return {false, "there is no parameter '" + wanted.name.substr(0, 100) + "'"};
    if (!entry->second.check) return {false, "this parameter can only be read"};
    if (wanted.value.type != entry->second.value.type) return {false, "the value is of another type"};
    const std::string problem = entry->second.check(wanted.value);
    return {problem.empty(), problem};
}

void NodeParameters::publish(std::vector<rcl::Parameter> added, std::vector<rcl::Parameter> changed) {
    if (events_ == 0 || transport_.subscribers(events_) == 0) return;
    transport_.publish(events_, to_cdr(rcl::ParameterEvent{
                                    wall_time(), full_name_, std::move(added), std::move(changed), {}}));
}

rcl::ParameterValue parameter_value(bool value) {
    rcl::ParameterValue result;
    result.type = rcl::kBool, result.bool_value = value;
    return result;
}

rcl::ParameterValue parameter_value(std::int64_t value) {
    rcl::ParameterValue result;
    result.type = rcl::kInteger, result.integer_value = value;
    return result;
}

rcl::ParameterValue parameter_value(double value) {
    rcl::ParameterValue result;
    result.type = rcl::kDouble, result.double_value = value;
    return result;
}

rcl::ParameterValue parameter_value(const std::string& value) {
    rcl::ParameterValue result;
    result.type = rcl::kString, result.string_value = value;
    return result;
}

}  // namespace roboss::ros2
