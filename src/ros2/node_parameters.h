// NodeParameters: the parameters of a node and the six services by which others read and set them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ros2/service_table.h"
#include "ros2_types/messages/parameter_services.h"

namespace roboss::ros2 {

/// See the top of the file.
class NodeParameters {
  public:
    /// Why a new value cannot be; empty: it holds from now on.
    using Check = std::function<std::string(const rcl_interfaces::ParameterValue& value)>;

    /// Serves the node with this full name, "/roboss". `transport` outlives it.
    NodeParameters(Transport& transport, EntityId node, const std::string& full_name);
    ~NodeParameters();
    NodeParameters(const NodeParameters&) = delete;
    NodeParameters& operator=(const NodeParameters&) = delete;

    /// Adds a parameter that others can only read, or replaces its value.
    void put(const std::string& name, const rcl_interfaces::ParameterValue& value,
             const std::string& description);
    /// Adds a parameter that others can set to a value of the same type that `check` likes.
    void put_settable(const std::string& name, const rcl_interfaces::ParameterValue& value,
                      const std::string& description, Check check);
    /// The value; not set: there is no such parameter.
    rcl_interfaces::ParameterValue value(const std::string& name) const;

    /// Serves a call. False: it is of none of these services.
    bool take(const Incoming& call) { return table_.take(call); }
    /// As of ServiceTable.
    std::vector<std::string> take_notices() { return table_.take_notices(); }

  private:
    struct Entry {
        rcl_interfaces::ParameterValue value;
        std::string description;
        Check check;  // none: others cannot set it
    };
    void add_questions(const std::string& full_name);
    void add_setters(const std::string& full_name);
    rcl_interfaces::ParameterDescriptor describe(const std::string& name) const;
    rcl_interfaces::ListParametersResult list(const rcl_interfaces::ListParameters::Request& request) const;
    rcl_interfaces::SetParametersResult may_set(const rcl_interfaces::Parameter& wanted) const;
    void publish(std::vector<rcl_interfaces::Parameter> added,
                 std::vector<rcl_interfaces::Parameter> changed);

    Transport& transport_;
    std::string full_name_;
    ServiceTable table_;
    EntityId events_ = 0;
    std::map<std::string, Entry> entries_;
};

/// A value of this type.
rcl_interfaces::ParameterValue parameter_value(bool value);
/// A value of this type.
rcl_interfaces::ParameterValue parameter_value(std::int64_t value);
/// A value of this type.
rcl_interfaces::ParameterValue parameter_value(double value);
/// A value of this type.
rcl_interfaces::ParameterValue parameter_value(const std::string& value);

}  // namespace roboss::ros2
