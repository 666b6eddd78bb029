#include <exception>

#include "bindings.h"
#include "hersey/core/error_text.h"
#include "hersey/core/input_error.h"
#include "hersey/core/units.h"
#include "hersey/results/error.h"
#include "hersey/results/output_lock.h"

namespace hersey::python {
namespace {

namespace py = pybind11;

py::tuple tuple_of(const Fault& fault) {
  return py::make_tuple(fault.position.file, fault.position.line, fault.position.column, fault.path, fault.found,
                        fault.expected, fault.suggestion, fault.text());
}

// Raises `name` of hersey.errors, made from `arguments`.
template <class... Arguments>
void raise(const char* name, const Arguments&... arguments) {
  const py::object type = py::module_::import("hersey.errors").attr(name);
  const py::object error = type(arguments...);
  PyErr_SetObject(type.ptr(), error.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    py::list faults;
    for (const Fault& fault : error.faults()) faults.append(tuple_of(fault));
    raise("InputError", py::str(error.what()), faults);
  } catch (const QuantityError& error) {
    py::list faults;
    faults.append(tuple_of({{}, "", error.found, error.expected, error.suggestion}));
    raise("InputError", py::str(error.what()), faults);
  } catch (const results::FileExists& error) {
    PyErr_SetString(PyExc_FileExistsError, error.what());
  } catch (const results::FileBusy& error) {
    PyErr_SetString(PyExc_BlockingIOError, error.what());
  } catch (const results::FileError& error) {
    PyErr_SetString(PyExc_OSError, error.what());
  } catch (const py::builtin_exception&) {
    throw;
  } catch (const py::error_already_set&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    raise("HerseyError", py::str(error_text(error)));
  }
}

}  // namespace

void bind_errors(py::module_&) { py::register_local_exception_translator(translate); }

}  // namespace hersey::python
