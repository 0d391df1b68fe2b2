// Defaults: the <default> classes of an MJCF file, and which of them an element has behind its own
// attributes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mjcf/attributes.h"

namespace roboss::mjcf {

class Defaults {
  public:
    /// Reads all <default> sections; a class without a name, or of a name that is there already, is an error.
    Defaults(const Document& document, Diagnostics& diagnostics);

    /// The attributes of an element; `childclass`: of the nearest body around it that names one, or empty. A
    /// class that is not there is an error.
    Attributes of(const Element& element, const std::string& childclass = "") const;

    /// The elements of the classes of an element, from the outermost class on, in the order of the file: for
    /// actuators, whose elements of all kinds set the same numbers.
    std::vector<Element> actuator_defaults(const Element& element) const;

  private:
    struct Class {
        std::string parent;
        std::vector<Element> sections;  // <default> elements of that name
    };
    void read(const Element& section, const std::string& parent, bool is_outermost);
    const Class* class_of(const Element& element, const std::string& childclass) const;

    const Document& document_;
    Diagnostics& diagnostics_;
    std::map<std::string, Class> classes_;  // the outermost one is named "main" unless it says otherwise
    std::string main_ = "main";
};

}  // namespace roboss::mjcf
