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
  Remedy remedy;
  const char* name;
};
constexpr RemedyName kRemedies[] = {
    {Remedy::force, "force"},
    {Remedy::force_level, "force_level"},
    {Remedy::keep_uncovered, "keep_uncovered"},
    {Remedy::nominal_model, "nominal_model"},
    {Remedy::positions_only, "positions_only"},
    {Remedy::recover_attitude, "recover_attitude"},
    {Remedy::crs, "crs"},
    {Remedy::axes, "axes"},
    {Remedy::columns, "columns"},
    {Remedy::leap_seconds, "leap_seconds"},
    {Remedy::geoid, "geoid"},
    {Remedy::max_distance, "max_distance"},
    {Remedy::control, "control"},
    {Remedy::control_sigma, "control_sigma"},
    {Remedy::flight_sigmas, "flight_sigmas"},
    {Remedy::strips, "strips"},
    {Remedy::channels, "channels"},
    {Remedy::user_data, "channels"},
    {Remedy::split, "split"},
};

const char* nameOf(Remedy remedy) {
  for (const RemedyName& each : kRemedies)
    if (each.remedy == remedy) return each.name;
  return "";
}

/// The exception classes; they exist as long as the interpreter.
PyObject* error_class = nullptr;
PyObject* usage_error_class = nullptr;
PyObject* input_error_class = nullptr;
PyObject* cancelled_class = nullptr;

/// The function that was called adds the argument which serves the remedy (_arguments.py).
void raise(PyObject* type, const Error& error) {
  py::object instance = py::handle(type)(py::str(error.what()));
  const std::string remedy = nameOf(error.remedy());
  if (!remedy.empty()) instance.attr("remedy") = remedy;
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
  for (const Warning& warning : warnings) texts.emplace_back(warning.text, nameOf(warning.remedy));
  return texts;
}

std::vector<std::string> hintedTexts(const char* function, const WarningTexts& warnings) {
  const py::object hinted = py::module_::import("pcl_als._arguments").attr("hinted");
  std::vector<std::string> lines;
  for (const auto& [text, remedy] : warnings)
    lines.push_back(hinted(function, text, remedy).cast<std::string>());
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
