// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/binding/errors.h"

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

namespace gnomon::python {

namespace {

const char* name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kUsage:
      return "usage";
    case ErrorCode::kFile:
      return "file";
    case ErrorCode::kSyntax:
      return "syntax";
    case ErrorCode::kFormat:
      return "format";
    case ErrorCode::kNumber:
      return "number";
    case ErrorCode::kIndex:
      return "index";
    case ErrorCode::kId:
      return "id";
    case ErrorCode::kGeometry:
      return "geometry";
    case ErrorCode::kLimit:
      return "limit";
    case ErrorCode::kInterrupted:
      return "interrupted";
  }
  return "";
}

}  // namespace

void raise(const Error& error) {
  namespace nb = nanobind;
  const nb::object type = nb::module_::import_("gnomon._errors").attr("Error");
  const nb::object value =
      type(to_string(error), name_of(error.code), error.where.file, error.where.line,
           error.where.column, error.where.pointer, error.expected);
  PyErr_SetObject(type.ptr(), value.ptr());
  throw nb::python_error();
}

}  // namespace gnomon::python
