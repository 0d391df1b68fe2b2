// See errors.h.
#include "errors.h"

#include <nanobind/nanobind.h>

namespace nb = nanobind;

namespace roboss_python {

void raise(const char* exception, const roboss::Error& error) {
    const nb::object type = nb::module_::import_("roboss.errors").attr(exception);
    const nb::object raised = type(error.message.c_str(), error.remedy.c_str(), error.code.c_str());
    PyErr_SetObject(type.ptr(), raised.ptr());
    throw nb::python_error();
}

}  // namespace roboss_python
