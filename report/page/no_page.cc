// SPDX-License-Identifier: GPL-3.0-or-later
// What stands for the page where it was not bundled.
#include "report/page/page_text.h"

namespace gnomon::report {

PageText page_text() { return {}; }

}  // namespace gnomon::report
