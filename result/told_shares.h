// SPDX-License-Identifier: LGPL-3.0-or-later
// Reads what a file tells of a polygon without fragments: the share of a class, as a fraction of
// the polygon (a number, or a text "p/q") or as an area in scene units squared, and how many digits
// it was written with, which is how closely it can be held to the truth.
//
// Exactness: values are the decimals or rationals that the file has. A decimal may be off by half a
// unit of its last digit, and by 2^-52 of the polygon, since a program that computes in doubles has
// no finer numbers to write; a text "p/q" may not be off at all. Where one has 15 digits or
// more, the numbers of the file are doubles as they came out of a computation
// (ToldShare::is_double).
#ifndef GNOMON_RESULT_TOLD_SHARES_H
#define GNOMON_RESULT_TOLD_SHARES_H

#include <string>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/result/claims.h"
#include "result/json_fields.h"

namespace gnomon {

/// The shares of all classes that the polygon's entry names; none if it names none. Errors: kFormat
/// (a form that is not known, which is named), kNumber, kLimit.
Expected<std::vector<ToldShare>> read_told_shares(const JsonFields& fields, const Json& polygon,
                                                  const std::string& pointer);

/// What only all shares of a file tell: how far off a whole 0 or 1 may be. Many programs leave out
/// zeros at the end of a number, so that "1" says nothing of how it was rounded. The other numbers
/// of the file were written with at most so many decimals, or so many digits: what allows more
/// counts for it. Where there are no others, it is nine decimals. Also sets ClaimedPolygon::share.
void finish_told_shares(std::vector<ClaimedLight>& lights);

}  // namespace gnomon

#endif  // GNOMON_RESULT_TOLD_SHARES_H
