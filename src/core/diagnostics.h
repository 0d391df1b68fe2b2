// Diagnostics: everything worth telling about an input file, all at once, each with file, line and what to
// do.
#pragma once

#include <string>
#include <vector>

namespace roboss {

/// How bad a finding is.
enum class Severity {
    kNote,     ///< worth knowing
    kWarning,  ///< the input is used, probably not as its author meant it
    kError     ///< the input, or the model, cannot be used
};

/// Where in an input file something stands.
struct SourceLocation {
    std::string file;  ///< path; empty: unknown
    int line = 0;      ///< 1-based; 0: unknown
};

/// One finding about an input file.
struct Diagnostic {
    Severity severity = Severity::kNote;  ///< how bad it is
    SourceLocation where;                 ///< where it was found
    std::string code;                     ///< stable short name for programs, e.g. "missing-inertia"
    std::string message;                  ///< what was found, naming the element
    std::string remedy;                   ///< what to do
    bool left_out =
        false;  ///< an error of a model that is left out: the rest of the world can run without it
};

/// "file:line: warning: message [code]\n    remedy"
std::string to_text(const Diagnostic& diagnostic);
/// "note", "warning" or "error".
const char* to_text(Severity severity);

/// The findings about an input, in the order in which they were added.
class Diagnostics {
  public:
    /// Adds a finding.
    void add(Diagnostic diagnostic) { items_.push_back(std::move(diagnostic)); }
    /// Adds a finding of Severity::kNote.
    void note(SourceLocation where, std::string code, std::string message, std::string remedy = {});
    /// Adds a finding of Severity::kWarning.
    void warning(SourceLocation where, std::string code, std::string message, std::string remedy = {});
    /// Adds a finding of Severity::kError.
    void error(SourceLocation where, std::string code, std::string message, std::string remedy = {});
    /// Whether there is any error, of models that are left out too.
    bool has_errors() const;
    /// Whether any error concerns more than models that are left out.
    bool refuses() const { return refuses_since(0); }
    /// The same of the findings from items()[first] on.
    bool refuses_since(std::size_t first) const;
    /// Marks the errors from items()[first] on as those of a model that is left out; false: there are none.
    bool leave_out_since(std::size_t first);
    /// Takes the marks back from items()[first] on: nothing is left that could run.
    void refuse_since(std::size_t first);
    /// How many findings have this severity.
    std::size_t count(Severity severity) const;
    /// All findings.
    const std::vector<Diagnostic>& items() const { return items_; }

  private:
    std::vector<Diagnostic> items_;
};

}  // namespace roboss
