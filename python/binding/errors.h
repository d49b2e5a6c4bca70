// SPDX-License-Identifier: GPL-3.0-or-later
// Bad input as an exception of Python: gnomon.Error with the text that the command prints.
#ifndef GNOMON_PYTHON_BINDING_ERRORS_H
#define GNOMON_PYTHON_BINDING_ERRORS_H

#include <utility>

#include "gnomon/kernel/error.h"

namespace gnomon::python {

/// Requires: the GIL is held.
[[noreturn]] void raise(const Error& error);

/// The value, or its error raised. Requires: the GIL is held.
template <class T>
T value_or_raise(Expected<T>&& value) {
  if (!value) raise(value.error());
  if constexpr (!std::is_void_v<T>) return *std::move(value);
}

}  // namespace gnomon::python

#endif  // GNOMON_PYTHON_BINDING_ERRORS_H
