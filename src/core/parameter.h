// Parameters of the kinds of things that robots carry (sensors, on-board controllers): what a kind states
// about each, so that importer, hash, wire and viewer read them without knowing the kind.
#pragma once

#include <string>
#include <vector>

namespace roboss {

/// One parameter of a kind: its name in code, hashes and the viewer's JSON, and its element in SDF.
struct Parameter {
    const char* name;     ///< unique in its kind
    const char* element;  ///< path below the element of the thing: "scan/horizontal/samples"; "a|b": a or b;
                          ///< "a/@b": attribute b of a, of texts
    const char* unit = "";  ///< "rad": the element may have degrees="true"
    bool infinite = false;  ///< whether infinity is a value of it
    /// Of a sensor: it was added after Models of its kind were hashed. Its default is not hashed, so those
    /// Models keep their hashes.
    bool later = false;
    /// For a controller's text: a word that says how it works. Other texts are names and topics, in which
    /// robots of one type may differ.
    bool choice = false;
};

/// Joints of the model, by name ("inner::joint" in nested models).
struct JointNames : std::vector<std::string> {
    using std::vector<std::string>::vector;
};

/// Links of the model, by name ("inner::link" in nested models).
struct LinkNames : std::vector<std::string> {
    using std::vector<std::string>::vector;
};

/// An element of SDF that a kind does not honour. It is reported where it is written with another value than
/// `neutral`.
struct IgnoredElement {
    const char* element;      ///< path, as in Parameter
    const char* neutral;      ///< the value that means nothing; "a|b": each of them; "": none
    const char* why;          ///< continues "<element> has no effect: "
    const char* remedy = "";  ///< what to write instead; "": nothing
};

/// Why a thing of a kind cannot work with its parameters.
struct ParameterProblem {
    std::string text;    ///< continues "sensor 'x' ...", e.g. "has 0 beams"
    std::string remedy;  ///< what to do about it
};

}  // namespace roboss
