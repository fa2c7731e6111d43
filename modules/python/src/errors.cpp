// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/progress.h>

#include "bindings.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;

/// What a caller from Python may set about an error.
struct PythonRemedy {
  Remedy remedy;
  const char* name;
  const char* text;
};
constexpr PythonRemedy kRemedies[] = {
    {Remedy::force, "force", "force=True continues"},
    {Remedy::force_level, "force", "force=True takes the sensor as level"},
    {Remedy::keep_uncovered, "keep_uncovered", "keep_uncovered=True leaves them as they are"},
    {Remedy::nominal_model, "attitude",
     "attitude='nominal' takes the sensor as level with its heading along the course"},
    {Remedy::positions_only, "attitude", "attitude='ignore' needs no attitude"},
    {Remedy::recover_attitude, "recover_attitude",
     "recover_attitude=True recovers them from the points"},
    {Remedy::crs, "crs", "state it with crs="},
    {Remedy::columns, "columns", "or name the columns with columns="},
    {Remedy::leap_seconds, "leap_seconds", "state them with leap_seconds="},
    {Remedy::max_distance, "max_distance", "a larger maximum distance compares them"},
    {Remedy::extent, "extent", "choose another extent"},
    {Remedy::ground, "ground", "choose other points as ground"},
    {Remedy::control, "control", "give control="},
    {Remedy::control_sigma, "control_sigma", "state it with control_sigma="},
    {Remedy::channels, "strips", "set their by_channel"},
    {Remedy::flight_sigmas, "shared_errors", "state them in the settings"},
    {Remedy::strips, "strips", "choose strips with strips="},
};

/// The exception classes; they exist as long as the interpreter.
PyObject* error_class = nullptr;
PyObject* usage_error_class = nullptr;
PyObject* input_error_class = nullptr;
PyObject* cancelled_class = nullptr;

void raise(PyObject* type, const Error& error) {
  std::string message = error.what();
  py::object remedy = py::none();
  for (const PythonRemedy& each : kRemedies) {
    if (each.remedy != error.remedy()) continue;
    message.append("; ").append(each.text);
    remedy = py::str(each.name);
  }
  py::object instance = py::handle(type)(py::str(message));
  instance.attr("remedy") = remedy;
  PyErr_SetObject(type, instance.ptr());
}

void translate(std::exception_ptr exception) {
  try {
    if (exception) std::rethrow_exception(exception);
  } catch (const UsageError& error) {
    raise(usage_error_class, error);
  } catch (const InputError& error) {
    raise(input_error_class, error);
  } catch (const Cancelled& error) {
    raise(cancelled_class, error);
  } catch (const Error& error) {
    raise(error_class, error);
  } catch (const std::filesystem::filesystem_error& error) {
    raise(input_error_class, InputError(error.what()));
  }
}

PyObject* declare(py::module_& m, const char* name, const char* text, const py::tuple& bases) {
  const std::string full = std::string("pcl_als.") + name;
  PyObject* type = PyErr_NewExceptionWithDoc(full.c_str(), text, bases.ptr(), nullptr);
  if (type == nullptr) throw py::error_already_set();
  m.attr(name) = py::handle(type);
  return type;
}

}  // namespace

void bindErrors(py::module_& m) {
  const py::handle exception(PyExc_Exception), value_error(PyExc_ValueError),
      os_error(PyExc_OSError);
  error_class = declare(m, "Error",
                        "Base of the exceptions of this package. The message is one line that "
                        "names the file, record or argument; remedy is the name of the argument "
                        "that may be set about it, or None.",
                        py::make_tuple(exception));
  py::setattr(error_class, "remedy", py::none());
  const py::handle base(error_class);
  usage_error_class =
      declare(m, "UsageError", "A wrong argument or an impossible value; also a ValueError.",
              py::make_tuple(base, value_error));
  input_error_class = declare(m, "InputError",
                              "Input that cannot be used: missing, corrupt, without times, without "
                              "overlap; also an OSError, as Python's own errors of files are.",
                              py::make_tuple(base, os_error));
  cancelled_class =
      declare(m, "Cancelled", "A progress callback returned False. Nothing half written is left.",
              py::make_tuple(base));
  py::register_exception_translator(&translate);
}

}  // namespace pcl_als::python
