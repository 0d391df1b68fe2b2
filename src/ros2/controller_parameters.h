// ControllerParameters: the parameters of one controller of a file of ros2_control, by name and type.
// Parameters that no drive reads are reported.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ros2/drive_controller.h"
#include "ros2/yaml_file.h"

namespace roboss::ros2 {

/// A parameter in groups is named with dots, as nodes name it: "linear.x.max_velocity". The first one that is
/// wrong becomes the error.
class ControllerParameters {
  public:
    /// Reads `values`, the ros__parameters of the controller `name` in the file.
    ControllerParameters(std::string file, std::string name, const YAML::Node& values);

    /// The name of the controller.
    const std::string& name() const { return name_; }
    /// True if the file gives it.
    bool has(const std::string& key) const { return values_.contains(key); }
    /// Its line in the file, from 1; that of all parameters if the file does not give it.
    int line(const std::string& key) const;

    /// It is known, and its value does not matter.
    void leave(const std::string& key) { asked_for_.insert(key); }
    /// A finite number.
    double number(const std::string& key, double usual);
    /// A number from 0 on.
    double at_least_zero(const std::string& key, double usual);
    /// A number above 0.
    double above_zero(const std::string& key, double usual);
    /// The same, which the file has to give.
    double length(const std::string& key);
    /// A limit; nullopt: there is none, as with .nan. One on the wrong side of 0 is an error: `sign` is 1 or
    /// -1.
    std::optional<double> limit(const std::string& key, int sign);
    /// True or false.
    bool flag(const std::string& key, bool usual);
    /// A text.
    std::string text(const std::string& key, const std::string& usual);
    /// One name or more, which the file has to give.
    std::vector<std::string> names(const std::string& key);
    /// One name, which the file has to give.
    std::string joint(const std::string& key);
    /// Six numbers from 0 on, or zeros.
    CovarianceDiagonal diagonal(const std::string& key);

    /// The parameter is wrong: "the KEY of 'NAME' " + what.
    void fail(const std::string& key, const std::string& what, const std::string& remedy);
    /// A notice, if the file gives it: "KEY of 'NAME' has no effect: " + why.
    void has_no_effect(const std::string& key, const std::string& why);
    /// A notice: "KEY of 'NAME' " + what.
    void notice(const std::string& key, const std::string& what);
    /// RoBOSS has no such controller.
    void refuse(const std::string& key, const std::string& why);

    /// The first fault of a parameter; nullopt: all are right.
    const std::optional<Error>& error() const { return error_; }
    /// A line that says why RoBOSS has no such controller; empty: it has one.
    const std::string& refusal() const { return refusal_; }
    /// Notices, one line each. Parameters that were not read get one, too.
    std::vector<std::string> take_notices();

  private:
    void add(const YAML::Node& map, const std::string& prefix, int depth);
    const YAML::Node* find(const std::string& key);
    std::string where(const std::string& key) const { return at_line(file_, line(key)); }

    std::string file_, name_;
    int line_ = 0;
    std::map<std::string, YAML::Node> values_;
    std::set<std::string> asked_for_;
    std::size_t looked_at_ = 0;
    std::optional<Error> error_;
    std::string refusal_;
    std::vector<std::string> notices_;
};

}  // namespace roboss::ros2
