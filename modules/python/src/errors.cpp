// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <string>

#include <pybind11/stl.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/progress.h>

#include "bindings.h"
#include "messages.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;

/// The remedies that arguments of functions serve, by the names of _arguments.py.
struct RemedyName {
  Hint hint;
  const char* name;
};
constexpr RemedyName kRemedies[] = {
    {Hint::force, "force"},
    {Hint::force_level, "force_level"},
    {Hint::keep_uncovered, "keep_uncovered"},
    {Hint::nominal_model, "nominal_model"},
    {Hint::positions_only, "positions_only"},
    {Hint::recover_attitude, "recover_attitude"},
    {Hint::crs, "crs"},
    {Hint::axes, "axes"},
    {Hint::columns, "columns"},
    {Hint::leap_seconds, "leap_seconds"},
    {Hint::geoid, "geoid"},
    {Hint::max_distance, "max_distance"},
    {Hint::control, "control"},
    {Hint::control_sigma, "control_sigma"},
    {Hint::flight_sigmas, "flight_sigmas"},
    {Hint::strips, "strips"},
    {Hint::channels, "channels"},
    {Hint::user_data, "channels"},
    {Hint::split, "split"},
};

const char* nameOf(Hint hint) {
  for (const RemedyName& each : kRemedies)
    if (each.hint == hint) return each.name;
  return "";
}

/// The exception classes; they exist as long as the interpreter.
PyObject* error_class = nullptr;
PyObject* usage_error_class = nullptr;
PyObject* input_error_class = nullptr;
PyObject* cancelled_class = nullptr;

/// The function that was called adds the argument which serves the hint (_arguments.py).
void raise(PyObject* type, const Error& error) {
  py::object instance = py::handle(type)(py::str(error.what()));
  const std::string hint = nameOf(error.hint());
  if (!hint.empty()) instance.attr("remedy") = hint;
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

WarningTexts warningTexts(const Warnings& warnings) {
  WarningTexts texts;
  for (const Warning& warning : warnings) texts.emplace_back(warning.text, nameOf(warning.hint));
  return texts;
}

std::vector<std::string> hintedTexts(const char* function, const WarningTexts& warnings) {
  const py::object hinted = py::module_::import("pcl_als._arguments").attr("hinted");
  std::vector<std::string> lines;
  for (const auto& [text, hint] : warnings)
    lines.push_back(hinted(function, text, hint).cast<std::string>());
  return lines;
}

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
