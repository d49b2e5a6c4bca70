# SPDX-License-Identifier: GPL-3.0-or-later
"""What of an output is not the same every time, and nothing else: times, peak memory, random names.

Each rule is bound to the command and the options that print such a thing, so that a number that only
looks like a time is compared like any other byte.
"""

import os
import re
import sqlite3
from collections.abc import Sequence
from functools import partial

# With groups of thousands; a comma behind it is no part of it.
_NUMBER = rb"[0-9]+(?:,[0-9]{3})*(?:\.[0-9]+)?(?:e[+-]?[0-9]+)?"

# Last column of the table of `certify`: "0.97x", "12.5 ms", "1.2 s"; "-" where nothing was measured.
_TIME_CELL = re.compile(rb" +" + _NUMBER + rb"(?:x| ms| s)$")
_TIME_TITLE = re.compile(rb" +time$")
_GAP = re.compile(rb" {2,}")
_RULER = re.compile(rb"^-{20,}$")
# A table has at most 100 characters a line, and its words are shortened where it would have more. Whether
# it would depends on the width of the times, so words of tables near that limit are compared by their
# beginnings alone; the certificate in JSON, which every such case writes too, has them whole.
_TABLE_WIDTH = 100
_WIDEST_TIME = 10
_TIGHT = _TABLE_WIDTH - 2 - _WIDEST_TIME
_WORD_COLUMNS = 3  # kernel, policy, verdict: the columns that give way
_SHORTEST_WORD = 3  # what is left of a cell of 6 with an ellipsis

_STATS_RULES = (
    # Seconds of every phase of `shadows --stats`, and what the process took of memory.
    (re.compile(rb"^CPU seconds \(elapsed\): .*$", re.MULTILINE), _NUMBER, b"T"),
    (re.compile(rb"^peak memory: .*$", re.MULTILINE), _NUMBER, b"M"),
    (re.compile(rb"; gridding " + _NUMBER + rb" s$", re.MULTILINE), _NUMBER, b"T"),
    (re.compile(rb"; illumination " + _NUMBER + rb" s, ", re.MULTILINE), _NUMBER, b"T"),
)
_SHRINK_SECONDS = re.compile(rb"^(shrunken to .*), [0-9]+\.[0-9] s$", re.MULTILINE)
_JSON_SECONDS = re.compile(rb'("(?:cpu_)?seconds": )' + _NUMBER)
_FOUND = re.compile(rb"^found .*\n", re.MULTILINE)
# Scenes for foreign programs are written under names that mkstemp() chooses.
_TEMPORARY_NAME = re.compile(rb"gnomon-[A-Za-z0-9]{6}\.json")


def _table_without_times(text: bytes) -> bytes:
    """The text of a certificate without the last column of its tables."""
    lines = text.split(b"\n")
    result: list[bytes] = []
    at = 0
    while at < len(lines):
        starts = at + 1 < len(lines) and _TIME_TITLE.search(lines[at]) and _RULER.match(lines[at + 1])
        if not starts:
            result.append(lines[at])
            at += 1
            continue
        # A table: its title, its ruler, then rows and indented notes up to an empty line.
        end = at + 2
        while end < len(lines) and lines[end]:
            end += 1
        rows = [line for line in lines[at + 2 : end] if not line.startswith(b" ")]
        times = [match.group().strip(b" ") for row in rows if (match := _TIME_CELL.search(row))]
        time_width = max([len(b"time"), *map(len, times)])
        rest = len(lines[at + 1]) - 2 - time_width
        tight = rest >= _TIGHT

        def cells(line: bytes, tight: bool = tight) -> bytes:
            if not tight:
                return line.rstrip(b" ")
            words = _GAP.split(line.strip(b" "))
            return b"  ".join(word[:_SHORTEST_WORD] if i < _WORD_COLUMNS else word for i, word in enumerate(words))

        result.append(cells(_TIME_TITLE.sub(b"", lines[at])))
        result.append(b"-" * (_TIGHT if tight else rest))
        for line in lines[at + 2 : end]:
            if line.startswith(b" "):
                result.append(line)
                continue
            shown = cells(_TIME_CELL.sub(b"", line))
            # Where there is no time, the dash stands behind blanks of the column's width.
            result.append(re.sub(rb" +-$", b"  -", shown))
        at = end
    return b"\n".join(result)


def _without_numbers(number: bytes, placeholder: bytes, match: re.Match[bytes]) -> bytes:
    return re.sub(number, placeholder, match.group())


def _has(arguments: Sequence[str], *options: str) -> bool:
    return any(option in arguments for option in options)


def _jobs(arguments: Sequence[str]) -> str:
    for option in ("-j", "--jobs"):
        if option in arguments:
            return arguments[arguments.index(option) + 1]
    return ""


def stream(arguments: Sequence[str], name: str, data: bytes) -> bytes:
    """A step's standard output or error ("stdout", "stderr") without what differs from run to run."""
    command = arguments[0] if arguments else ""
    if command == "certify" and name == "stdout" and not _has(arguments, "--corpus"):
        data = _table_without_times(data)
    if command == "shadows" and name == "stderr" and "--stats" in arguments:
        for line, number, placeholder in _STATS_RULES:
            data = line.sub(partial(_without_numbers, number, placeholder), data)
    if command == "shrink":
        data = _SHRINK_SECONDS.sub(rb"\1, T s", data)
    if "--times" in arguments:
        data = _JSON_SECONDS.sub(rb"\1T", data)
    if command == "fuzz" and name == "stderr" and _jobs(arguments) != "1":
        # Processes finish in any order: then more may be told as found than is kept in the end, and in
        # another order. What is kept is in the report. Campaigns of one process keep these lines.
        data = _FOUND.sub(b"", data)
    if _has(arguments, "--candidate-command"):
        data = _TEMPORARY_NAME.sub(b"gnomon-XXXXXX.json", data)
    return data


def file_name(name: str) -> str:
    """The name of a written file without what is random in it."""
    return _TEMPORARY_NAME.sub(b"gnomon-XXXXXX.json", name.encode()).decode()


def file_content(steps: Sequence[Sequence[str]], name: str, path: str) -> bytes:
    """The content of a file that a case of these steps wrote."""
    with open(path, "rb") as file:
        data = file.read()
    if data.startswith(b"SQLite format 3\0"):
        return _database(path)
    if os.path.basename(name) == "table.txt":  # of certify --report
        data = _table_without_times(data)
    if any("--times" in arguments for arguments in steps):
        data = _JSON_SECONDS.sub(rb"\1T", data)
    if any("--candidate-command" in arguments for arguments in steps):
        data = _TEMPORARY_NAME.sub(b"gnomon-XXXXXX.json", data)
    return data


def _database(path: str) -> bytes:
    """What a campaign's database holds. Its pages depend on how often it was saved, which is by the
    clock; and it counts the milliseconds."""
    with sqlite3.connect(f"file:{path}?mode=ro", uri=True) as database:
        lines = [line for line in database.iterdump() if "'milliseconds'" not in line]
    database.close()
    return "\n".join(sorted(lines)).encode() + b"\n"
