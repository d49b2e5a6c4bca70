// SPDX-License-Identifier: LGPL-3.0-or-later
// Bad input is a value. Every reader and every check returns Expected<T>; the command line prints
// the Error and turns its code into an exit status (docs: formats). Broken invariants are
// assertions.
#ifndef GNOMON_KERNEL_ERROR_H
#define GNOMON_KERNEL_ERROR_H

#include <cstdint>
#include <string>
#include <tl/expected.hpp>

namespace gnomon {

/// One code a cause. The cause decides the exit status: usage and input 2, limits 3.
enum class ErrorCode : std::uint8_t {
  kUsage,        // wrong option or argument
  kFile,         // cannot be opened, read or written
  kSyntax,       // not JSON / OBJ / OFF / PLY, wrong encoding, truncated
  kFormat,       // well-formed, but not this format: unknown key, wrong type, missing key, version
  kNumber,       // NaN, infinity, overflow, unreadable number
  kIndex,        // an index outside the vertices
  kId,           // empty, malformed or colliding id
  kGeometry,     // self-intersecting loop, hole that leaves its loop, degenerate light
  kLimit,        // a stated limit: digits, memory, time, fragments
  kInterrupted,  // the user asked to stop
};

/// Where in which file; line and column count from 1, 0 means "not known".
struct ErrorPlace {
  std::string file;
  std::uint64_t line = 0;
  std::uint64_t column = 0;
  std::string pointer;  // JSON pointer, such as /polygons/3/loop/2
};

struct Error {
  ErrorCode code = ErrorCode::kUsage;
  ErrorPlace where;
  std::string what;      // what is wrong
  std::string expected;  // what was expected instead; may be empty
};

template <class T>
using Expected = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(ErrorCode code, std::string what, std::string expected = {},
                                  ErrorPlace where = {}) {
  return tl::unexpected<Error>(Error{code, std::move(where), std::move(what), std::move(expected)});
}

/// "FILE:LINE:COLUMN: what is wrong; expected that (at /json/pointer)", without program name.
std::string to_string(const Error& error);

}  // namespace gnomon

#endif  // GNOMON_KERNEL_ERROR_H
