/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "settings.h"

#include <pcl/registration/kss/settings_text.h>

#include <cstring>
#include <limits>
#include <string>
#include <type_traits>

namespace pcl_kss_icp {
namespace {

namespace py = pybind11;
namespace kss = pcl::kss;
namespace setting = pcl::kss::setting;

/** UTF-8, lone surrogates as escapes: there is no UTF-8 of those. */
std::string
escaped(const py::str& text)
{
  return py::bytes(text.attr("encode")("utf-8", "backslashreplace"));
}

/** Python's own switches, and numpy's, which are no numbers. */
bool
isSwitch(py::handle value)
{
  const std::string type = Py_TYPE(value.ptr())->tp_name;
  return PyBool_Check(value.ptr()) || type == "numpy.bool" || type == "numpy.bool_";
}

/** \name Take a value over if it is of the kind that a row asks for. */
/** \{ */
bool
take(py::handle given, const setting::Number<double>&, double& value)
{
  if (isSwitch(given) || PyUnicode_Check(given.ptr()))
    return false;
  value = PyFloat_AsDouble(given.ptr());
  const bool is_number = !PyErr_Occurred();
  PyErr_Clear();
  return is_number;
}

bool
take(py::handle given, const setting::Number<unsigned int>&, unsigned int& value)
{
  if (isSwitch(given))
    return false;
  const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(given.ptr()));
  const unsigned long long number =
      whole ? PyLong_AsUnsignedLongLong(whole.ptr()) : 0ULL;
  const bool is_whole = !PyErr_Occurred();
  PyErr_Clear();
  if (!is_whole || number > std::numeric_limits<unsigned int>::max())
    return false;
  value = static_cast<unsigned int>(number);
  return true;
}

bool
take(py::handle given, const setting::Flag&, bool& value)
{
  if (isSwitch(given))
    value = PyObject_IsTrue(given.ptr()) == 1;
  return isSwitch(given);
}

bool
take(py::handle given, const setting::Text&, std::string& value)
{
  Py_ssize_t size = 0;
  const char* const text = PyUnicode_Check(given.ptr())
                               ? PyUnicode_AsUTF8AndSize(given.ptr(), &size)
                               : nullptr;
  PyErr_Clear();
  if (text)
    value.assign(text, static_cast<std::size_t>(size));
  return text != nullptr;
}

template <typename Value, int size>
bool
take(py::handle given, const setting::Choice<Value, size>& row, Value& value)
{
  std::string asked;
  if (!take(given, setting::Text(), asked))
    return false;
  for (const setting::Word<Value>& word : row.words)
    if (asked == word.word) {
      value = word.value;
      return true;
    }
  return false;
}
/** \} */

/** \name What the values of a row may be. */
/** \{ */
template <typename Value>
std::string
remedyOf(const setting::Number<Value>& row)
{
  return remedy(row.bounds);
}

std::string
remedyOf(const setting::Flag&)
{
  return "use True or False";
}

template <typename Row>
std::string
remedyOf(const Row& row)
{
  return remedy(row);
}
/** \} */

/** \name A value as Python has it. */
/** \{ */
template <typename Row, typename Value>
py::object
toPython(const Row&, const Value& value)
{
  return py::cast(value);
}

template <typename Value, int size>
py::object
toPython(const setting::Choice<Value, size>& row, const Value& value)
{
  return py::str(valueText(row, value, setting::For::PROGRAM));
}
/** \} */

[[noreturn]] void
refuseName(const std::string& name)
{
  std::string names;
  setting::forEach([&](const auto& row) {
    names += (names.empty() ? "" : ", ") + std::string(row.name);
  });
  throw py::type_error("There is no setting '" + name + "'; there are " + names + ".");
}

} // namespace

kss::Settings
settingsOf(const py::dict& given)
{
  kss::Settings settings;
  for (const auto& [key, value] : given) {
    const std::string name = escaped(py::str(key));
    bool is_known = false;
    setting::forEach([&, given_value = py::handle(value)](const auto& row) {
      if (name != row.name)
        return;
      is_known = true;
      if (!take(given_value, row, settings.*row.member))
        throw py::value_error(name + ' ' + escaped(py::repr(given_value)) + ": " +
                              remedyOf(row) + '.');
    });
    if (!is_known)
      refuseName(name);
  }
  const kss::CheckedSettings checked = kss::checked(settings, kss::Settings());
  if (!checked.refusals.empty())
    throw py::value_error(checked.refusals.front());
  return settings;
}

py::list
settingsTable()
{
  py::list table;
  const kss::Settings defaults;
  setting::forEach([&](const auto& row) {
    table.append(py::make_tuple(row.name, toPython(row, defaults.*row.member),
                                meaningText(row), remedyOf(row)));
  });
  return table;
}

} // namespace pcl_kss_icp
