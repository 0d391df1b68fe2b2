// Diagnostics: everything worth telling about an input file, all at once, each with file, line and what to
// do.
#pragma once

#include <string>
#include <vector>

namespace roboss {

enum class Severity { kNote, kWarning, kError };

struct SourceLocation {
    std::string file;
    int line = 0;  // 1-based; 0: unknown
};

struct Diagnostic {
    Severity severity = Severity::kNote;
    SourceLocation where;
    std::string code;       // stable short name for programs, e.g. "missing-inertia"
    std::string message;    // what was found, naming the element
    std::string remedy;     // what to do
    bool left_out = false;  // an error of a model that is left out: the rest of the world can run without it
};

/// "file:line: warning: message [code]\n    remedy"
std::string to_text(const Diagnostic& diagnostic);
const char* to_text(Severity severity);

class Diagnostics {
  public:
    void add(Diagnostic diagnostic) { items_.push_back(std::move(diagnostic)); }
    void note(SourceLocation where, std::string code, std::string message, std::string remedy = {});
    void warning(SourceLocation where, std::string code, std::string message, std::string remedy = {});
    void error(SourceLocation where, std::string code, std::string message, std::string remedy = {});
    bool has_errors() const;
    /// Whether any error concerns more than models that are left out.
    bool refuses() const { return refuses_since(0); }
    bool refuses_since(std::size_t first) const;
    /// Marks the errors from items()[first] on as those of a model that is left out; false: there are none.
    bool leave_out_since(std::size_t first);
    /// Takes the marks back from items()[first] on: nothing is left that could run.
    void refuse_since(std::size_t first);
    std::size_t count(Severity severity) const;
    const std::vector<Diagnostic>& items() const { return items_; }

  private:
    std::vector<Diagnostic> items_;
};

}  // namespace roboss
