// See message_text.h.
#include "sdf/message_text.h"

#include <cctype>
#include <map>

#include "sdf/element_reader.h"

namespace roboss::sdf_import {
namespace {

constexpr MessageType kTypes[] = {
    {"Empty", ""},
    {"Boolean", "data"},
    {"Int32", "data"},
    {"Int64", "data"},
    {"UInt32", "data"},
    {"UInt64", "data"},
    {"Double", "data"},
    {"Float", "data"},
    {"StringMsg", "data"},
    {"Vector2d", "x|y"},
    {"Vector3d", "x|y|z"},
    {"Quaternion", "x|y|z|w"},
    {"Color", "r|g|b|a"},
    {"Twist", "linear_x|linear_y|linear_z|angular_x|angular_y|angular_z"},
    {"Pose", "position_x|position_y|position_z|orientation_x|orientation_y|orientation_z|orientation_w"},
    {"Wrench", "force_x|force_y|force_z|torque_x|torque_y|torque_z"},
    {"Altimeter", "vertical_position|vertical_velocity|vertical_reference"},
    {"Boolean_V", ""},
    {"Int32_V", ""},
    {"Int64_V", ""},
    {"UInt32_V", ""},
    {"UInt64_V", ""},
    {"Double_V", ""},
    {"Float_V", ""},
    {"StringMsg_V", ""},
    {"Pose_V", ""},
    {"Actuators", ""},
    {"AirSpeed", ""},
    {"Any", ""},
    {"BatteryState", ""},
    {"CameraInfo", ""},
    {"Clock", ""},
    {"Contact", ""},
    {"Contacts", ""},
    {"Dataframe", ""},
    {"Entity", ""},
    {"EntityFactory", ""},
    {"EntityWrench", ""},
    {"FluidPressure", ""},
    {"Header", ""},
    {"IMU", ""},
    {"Image", ""},
    {"Joint", ""},
    {"JointTrajectory", ""},
    {"Joy", ""},
    {"LaserScan", ""},
    {"Light", ""},
    {"LogicalCameraImage", ""},
    {"Magnetometer", ""},
    {"Model", ""},
    {"NavSat", ""},
    {"Odometry", ""},
    {"OdometryWithCovariance", ""},
    {"Param", ""},
    {"Physics", ""},
    {"PointCloudPacked", ""},
    {"Time", ""},
    {"Visual", ""},
    {"WorldControl", ""},
    {"WorldStatistics", ""},
};

/// A value of a field: a scalar, or a message.
struct Node {
    std::string name;
    bool in_list = false;  // [a, b]
    bool is_message = false, is_text = false;
    double number = 0;
    std::string text;
    std::vector<Node> fields;
};

class TextParser {
  public:
    explicit TextParser(std::string_view text) : text_(text) {}

    std::optional<std::vector<Node>> message() {
        std::vector<Node> fields = fields_until('\0', 0);
        if (failed_) return std::nullopt;
        return fields;
    }

  private:
    static constexpr int kDepthMax = 32;

    char next() {
        while (at_ < text_.size() &&
               (std::isspace(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '#')) {
            if (text_[at_] == '#')
                while (at_ < text_.size() && text_[at_] != '\n') ++at_;
            else
                ++at_;
        }
        return at_ < text_.size() ? text_[at_] : '\0';
    }
    bool take(char wanted) {
        if (next() != wanted) return false;
        ++at_;
        return true;
    }
    std::string word() {
        next();
        const auto belongs = [](char c) {
            return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-' ||
                   c == '+';
        };
        const std::size_t start = at_;
        while (at_ < text_.size() && belongs(text_[at_])) ++at_;
        if (at_ == start) failed_ = true;
        return std::string(text_.substr(start, at_ - start));
    }

    std::vector<Node> fields_until(char end, int depth) {
        std::vector<Node> fields;
        if (depth > kDepthMax) failed_ = true;
        while (!failed_ && next() != end) {
            const std::string name = word();
            const bool colon = take(':');
            if (take('[')) {
                while (!failed_ && !take(']')) {
                    add_value(fields, name, true, true, depth);
                    take(',');
                }
            } else {
                add_value(fields, name, false, colon, depth);
            }
            if (!take(',')) take(';');
        }
        if (end != '\0' && !failed_) ++at_;
        return fields;
    }

    void add_value(std::vector<Node>& fields, const std::string& name, bool in_list, bool colon, int depth) {
        Node node;
        node.name = name, node.in_list = in_list;
        const char first = next();
        if (first == '{' || first == '<') {
            ++at_;
            node.is_message = true;
            node.fields = fields_until(first == '{' ? '}' : '>', depth + 1);
        } else if (!colon) {
            failed_ = true;
        } else if (first == '"' || first == '\'') {
            node.is_text = true;
            while (next() == '"' || next() == '\'') node.text += quoted();
        } else {
            read_scalar(word(), node);
        }
        if (!failed_) fields.push_back(std::move(node));
    }

    std::string quoted() {
        const char quote = text_[at_++];
        std::string content;
        while (at_ < text_.size() && text_[at_] != quote) {
            if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
            content += text_[at_++];
        }
        if (at_ >= text_.size()) failed_ = true;
        ++at_;
        return content;
    }

    void read_scalar(std::string scalar, Node& node) {
        if (failed_) return;
        if (scalar == "true" || scalar == "false") {
            node.number = scalar == "true" ? 1 : 0;
            return;
        }
        const std::string whole = scalar;
        if (scalar.size() > 1 && (scalar.back() == 'f' || scalar.back() == 'F')) scalar.pop_back();
        if (const auto number = parse_number(scalar))
            node.number = *number;
        else
            node.is_text = true, node.text = whole;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    bool failed_ = false;
};

/// {key: ..., value: ...}
bool is_map_entry(const Node& node) {
    return node.is_message && node.fields.size() == 2 && node.fields[0].name == "key" &&
           node.fields[1].name == "value" && node.fields[0].is_text;
}

void flatten(const std::vector<Node>& nodes, const std::string& prefix, bool repeats,
             std::vector<MessageField>& out) {
    std::map<std::string, int> times, seen;
    for (const Node& node : nodes) ++times[node.name];
    for (const Node& node : nodes) {
        std::string name = prefix + node.name;
        if (is_map_entry(node)) {
            const Node& value = node.fields[1];
            MessageField field{node.fields[0].text, value.number, value.is_text, value.text};
            if (const auto number = parse_number(value.text); value.is_text && number)
                field = {field.name, *number, false, {}};
            out.push_back(std::move(field));
            continue;
        }
        if (times[node.name] > 1 || node.in_list || repeats) name += "_" + std::to_string(seen[node.name]++);
        if (node.is_message)
            flatten(node.fields, name + "_", false, out);
        else
            out.push_back({name, node.number, node.is_text, node.text});
    }
}

}  // namespace

const MessageType* find_message_type(std::string_view written) {
    const std::size_t dot = written.rfind('.');
    if (dot == std::string_view::npos) return nullptr;
    const std::string_view package = written.substr(0, dot);
    if (package != "gz.msgs" && package != "ignition.msgs" && package != "gz_msgs") return nullptr;
    for (const MessageType& type : kTypes)
        if (written.substr(dot + 1) == type.name) return &type;
    return nullptr;
}

std::optional<std::vector<MessageField>> parse_message(std::string_view text, const MessageType& type) {
    const auto nodes = TextParser(text).message();
    if (!nodes) return std::nullopt;
    std::vector<MessageField> fields;
    flatten(*nodes, "", std::string_view(type.name).ends_with("_V"), fields);
    return fields;
}

std::optional<std::vector<MessageField>> parse_field(const std::string& path, const std::string& value,
                                                     const MessageType& type) {
    std::string text, closing;
    std::size_t start = 0;
    for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', start)) {
        text += path.substr(start, dot - start) + " {";
        closing += '}';
        start = dot + 1;
    }
    text += path.substr(start) + ": " + value + closing;
    return parse_message(text, type);
}

}  // namespace roboss::sdf_import
