#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shows that a change of the program changed no behaviour.

Runs a reference binary and a candidate on the same command lines and compares standard output,
standard error, exit status and every file written, byte for byte, without what no two runs of one
program have in common (normalise.py). What is run is in cases.py.

Exit status: 0 all equal, or different only where that was allowed; 1 something differs, or took too
long to be compared; 2 bad usage.
"""

import argparse
import concurrent.futures
import dataclasses
import difflib
import hashlib
import json
import os
import re
import shlex
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path

sys.dont_write_bytecode = True  # the folder is part of the sources
import normalise
from cases import GROUPS, Case, Context, Step, parse_generators, read_scenes

HERE = Path(__file__).resolve().parent
LINES_OF_DIFF = 20
DIFFS_SHOWN = 100
PARTS_NAMED = 6
CHARACTERS_OF_LINE = 160


class UsageError(Exception):
    """What the user has to change; the message is one line."""


@dataclasses.dataclass
class Outcome:
    """What one binary did in one case: streams, exit statuses and files, by name."""

    parts: dict[str, bytes] = dataclasses.field(default_factory=dict)
    commands: list[str] = dataclasses.field(default_factory=list)
    statuses: list[int] = dataclasses.field(default_factory=list)
    too_long: bool = False

    def summary(self) -> "Summary":
        """What is remembered of it."""
        return Summary(
            {name: hashlib.sha256(data).hexdigest() for name, data in self.parts.items()},
            sum(map(len, self.parts.values())),
            self.statuses,
        )


@dataclasses.dataclass
class Summary:
    """Enough to compare with another outcome: digests of its parts."""

    digests: dict[str, str]
    size: int
    statuses: list[int]


@dataclasses.dataclass
class Verdict:
    """How a case came out. `differing`: names of parts; `text`: what to print of them."""

    case: Case
    size: int = 0
    statuses: list[int] = dataclasses.field(default_factory=list)
    differing: list[str] = dataclasses.field(default_factory=list)
    too_long: str = ""
    text: str = ""


def sha256_of(path: Path) -> str:
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def digest_of_tree(*roots: Path) -> str:
    """Of the names and contents of all files below some folders."""
    digest = hashlib.sha256()
    for root in roots:
        for path in sorted(root.rglob("*")):
            if path.is_file():
                digest.update(f"{root.name}/{path.relative_to(root)}\0{sha256_of(path)}\n".encode())
    return digest.hexdigest()


class Runner:
    """Runs cases on one binary, each in a folder of its own, where both binaries see the same names:
    `./gnomon`, `examples` and `tests/regressions`."""

    def __init__(self, binary: Path, scenes: Path, work: Path, limit: float):
        self.binary = binary
        self.scenes = scenes
        self.work = work
        self.limit = limit  # seconds of the clock, for all steps of a case
        self.work.mkdir(parents=True)
        # Nothing of the user's settings; temporary files of the program count as files of the case.
        self.environment = {
            "PATH": os.environ.get("PATH", os.defpath),
            "LC_ALL": "C",
            "TMPDIR": "tmp",
        }

    def run(self, case: Case, number: int, keep: Path | None = None) -> Outcome:
        """One case. With `keep` its folder is left there, beside its streams as files."""
        folder = self.work / f"{number:05d}"
        folder.mkdir()
        try:
            outcome = self._run_in(case, folder)
            if keep is not None:
                keep.parent.mkdir(parents=True, exist_ok=True)
                shutil.copytree(folder, keep, symlinks=True)
                for name, data in outcome.parts.items():
                    if not name.startswith("file "):
                        (keep / f"({name})").write_bytes(data)
            return outcome
        finally:
            shutil.rmtree(folder)

    def _run_in(self, case: Case, folder: Path) -> Outcome:
        (folder / "gnomon").symlink_to(self.binary)
        (folder / "examples").symlink_to(self.scenes / "examples")
        (folder / "tests").symlink_to(self.scenes / "tests")
        (folder / "tmp").mkdir()
        for source, target in case.copies:
            shutil.copytree(self.scenes / source, folder / target)
        for name, data in case.files:
            (folder / name).write_bytes(data)
        outcome = Outcome()
        end = time.monotonic() + self.limit
        for number, step in enumerate(case.steps, 1):
            arguments = [expanded(word, folder) for word in step.arguments]
            outcome.commands.append(command_text(step, arguments))
            if not self._run_step(step, arguments, number, folder, end, outcome):
                outcome.too_long = True
                return outcome
        arguments_of_steps = [step.arguments for step in case.steps]
        for path in sorted(folder.rglob("*")):
            name = path.relative_to(folder).as_posix()
            if path.is_symlink() or name == "tmp":
                continue
            part = f"file {normalise.file_name(name)}"
            if path.is_dir():
                outcome.parts[part + "/"] = b""
            else:
                mode = f"mode {path.stat().st_mode & 0o777:o}\n".encode()
                outcome.parts[part] = mode + normalise.file_content(arguments_of_steps, name, str(path))
        return outcome

    def _run_step(
        self, step: Step, arguments: list[str], number: int, folder: Path, end: float, outcome: Outcome
    ) -> bool:
        """False if it had to be killed."""
        closed = None
        if step.stdout == "full":
            stdout = os.open("/dev/full", os.O_WRONLY)
        elif step.stdout == "closed":
            reading, stdout = os.pipe()
            os.close(reading)
        else:
            stdout = subprocess.PIPE
        if stdout != subprocess.PIPE:
            closed = stdout
        try:
            process = subprocess.Popen(
                ["./gnomon", *arguments],
                cwd=folder,
                env=self.environment,
                stdin=subprocess.PIPE if step.stdin else subprocess.DEVNULL,
                stdout=stdout,
                stderr=subprocess.PIPE,
                start_new_session=True,  # so that its processes can be ended with it
            )
        except OSError as error:
            raise UsageError(f"{self.binary} cannot be run: {error.strerror}") from error
        finally:
            if closed is not None:
                os.close(closed)
        try:
            out, errors = process.communicate(step.stdin or None, timeout=max(0.1, end - time.monotonic()))
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            for pipe in (process.stdout, process.stderr, process.stdin):
                if pipe is not None:
                    pipe.close()  # a foreign program has a group of its own, and may hold them still
            process.wait()
            return False
        streams = {"stdout": out or b"", "stderr": errors}
        for name, data in streams.items():
            outcome.parts[f"{number}. {name}"] = normalise.stream(step.arguments, name, data)
        outcome.parts[f"{number}. exit status"] = b"%d\n" % process.returncode
        outcome.statuses.append(process.returncode)
        return True


def expanded(argument: str, folder: Path) -> str:
    """An argument with what `{first:PATTERN}` and `{case:FILE}` stand for."""

    def first(match: re.Match[str]) -> str:
        found = sorted(path.relative_to(folder).as_posix() for path in folder.glob(match[1]))
        return found[0] if found else "none"

    def kept_case(match: re.Match[str]) -> str:
        try:
            with sqlite3.connect(f"file:{folder / match[1]}?mode=ro", uri=True) as database:
                row = database.execute("SELECT case_index FROM findings ORDER BY case_index").fetchone()
            database.close()
        except sqlite3.Error:
            return "none"
        return str(row[0]) if row else "none"

    argument = re.sub(r"\{first:([^}]*)\}", first, argument)
    return re.sub(r"\{case:([^}]*)\}", kept_case, argument)


def command_text(step: Step, arguments: Iterable[str]) -> str:
    """The command as one would type it."""
    text = shlex.join(["gnomon", *arguments])
    if step.stdin:
        text += " < (the scene)"
    if step.stdout != "pipe":
        text += " > /dev/full" if step.stdout == "full" else " | true"
    return text


class Memory:
    """What the reference did, remembered between runs: digests alone, since a reference that is asked
    again where something differs shows at the same time whether it is the same every time."""

    def __init__(self, file: Path | None):
        self.known: dict[str, Summary] = {}
        self.lock = threading.Lock()
        self.file = None
        if file is None:
            return
        file.parent.mkdir(parents=True, exist_ok=True)
        if file.exists():
            for line in file.read_text().splitlines():
                try:
                    entry = json.loads(line)
                except ValueError:
                    continue  # the last line of a run that was ended
                self.known[entry["key"]] = Summary(entry["digests"], entry["size"], entry["statuses"])
        self.file = open(file, "a", encoding="utf-8")

    def put(self, key: str, summary: Summary) -> None:
        with self.lock:
            self.known[key] = summary
            if self.file is not None:
                self.file.write(json.dumps({"key": key, **dataclasses.asdict(summary)}) + "\n")
                self.file.flush()

    def close(self) -> None:
        if self.file is not None:
            self.file.close()


def key_of(case: Case, inputs: str) -> str:
    """Under which name an outcome is remembered: all that it depends on but the binary."""
    return hashlib.sha256(f"{inputs}\0{case!r}".encode()).hexdigest()


class Comparison:
    """Both binaries on every case."""

    def __init__(self, reference: Runner, candidate: Runner, memory: Memory, inputs: str, keep: Path | None):
        self.reference = reference
        self.candidate = candidate
        self.memory = memory
        self.inputs = inputs
        self.keep = keep

    def compare(self, case: Case, number: int) -> Verdict:
        verdict = Verdict(case)
        key = key_of(case, self.inputs)
        expected = None
        summary = self.memory.known.get(key)
        if summary is None:
            expected = self.reference.run(case, number)
            if expected.too_long:
                # The candidate would say nothing that could be compared.
                verdict.too_long = "the reference"
                verdict.text = lines_of_commands(expected.commands)
                return verdict
            summary = expected.summary()
            self.memory.put(key, summary)
        verdict.size = summary.size
        verdict.statuses = summary.statuses
        found = self.candidate.run(case, number)
        if found.too_long:
            verdict.too_long = "the candidate"
            verdict.text = lines_of_commands(found.commands)
            return verdict
        if found.summary().digests == summary.digests:
            return verdict
        self.explain(verdict, number, expected, found, summary)
        return verdict

    def explain(
        self, verdict: Verdict, number: int, expected: Outcome | None, found: Outcome, summary: Summary
    ) -> None:
        """Says what differs, and whether the reference itself does the same thing every time."""
        case = verdict.case
        keep = None
        if self.keep is not None:
            keep = self.keep / re.sub(r"[^A-Za-z0-9_.+=-]", "_", case.name)[:180]
            # Once more, for its files.
            self.candidate.run(case, number, keep / "candidate")
        again = self.reference.run(case, number, keep / "reference" if keep is not None else None)
        expected = expected or again
        names = list(dict.fromkeys([*expected.parts, *found.parts]))
        verdict.differing = [name for name in names if expected.parts.get(name) != found.parts.get(name)]
        text = lines_of_commands(found.commands)
        if again.summary().digests != summary.digests:
            text += "  the reference itself gives another output each time\n"
        if not verdict.differing:
            verdict.differing = ["not the same twice"]
        for name in verdict.differing:
            text += f"  {name} differs:\n"
            text += difference(expected.parts.get(name), found.parts.get(name))
        if keep is not None:
            text += f"  both are in {keep}\n"
        verdict.text = text


def lines_of_commands(commands: list[str]) -> str:
    return "".join(f"  {number}. {command}\n" for number, command in enumerate(commands, 1))


def difference(expected: bytes | None, found: bytes | None) -> str:
    """The first lines of a unified diff, indented."""
    if expected is None:
        return "    only the candidate has it\n"
    if found is None:
        return "    only the reference has it\n"
    old = expected.decode("utf-8", "backslashreplace").splitlines()
    new = found.decode("utf-8", "backslashreplace").splitlines()
    # Most of two long texts is the same, and difflib is slow.
    start = 0
    while start < min(len(old), len(new)) and old[start] == new[start]:
        start += 1
    stop = 0
    while stop < min(len(old), len(new)) - start and old[-1 - stop] == new[-1 - stop]:
        stop += 1
    most = 10 * LINES_OF_DIFF
    context = max(0, start - 3)
    old_part, new_part = (lines[context : min(len(lines) - stop + 3, context + most)] for lines in (old, new))
    result = list(difflib.unified_diff(old_part, new_part, "reference", "candidate", lineterm="", n=3))
    text = "".join(f"    {shown_line(line)}\n" for line in result[:LINES_OF_DIFF])
    if context > 0:
        text += f"    (lines are counted from line {context + 1})\n"
    if len(result) > LINES_OF_DIFF:
        text += "    ...\n"
    at = next((i for i, (a, b) in enumerate(zip(expected, found)) if a != b), min(len(expected), len(found)))
    before = max(0, at - 40)
    text += f"    first at byte {at} of {len(expected)} and {len(found)}: "
    return text + f"{expected[before : at + 40]!r} / {found[before : at + 40]!r}\n"


def shown_line(line: str) -> str:
    return line if len(line) <= CHARACTERS_OF_LINE else line[:CHARACTERS_OF_LINE] + " ..."


def sampled(cases: Iterable[Case], per_stratum: int) -> list[Case]:
    """So many of each stratum, chosen by their names: the same ones every time, and few others where
    scenes are added."""
    strata: dict[str, list[Case]] = {}
    cases = list(cases)
    for case in cases:
        strata.setdefault(case.stratum, []).append(case)
    chosen: set[str] = set()
    for members in strata.values():
        small = [case for case in members if not case.big] or members
        small.sort(key=lambda case: hashlib.sha256(case.name.encode()).digest())
        chosen.update(case.name for case in small[:per_stratum])
    return [case for case in cases if case.name in chosen]


def chosen_cases(context: Context, only: list[str], quick: bool) -> list[Case]:
    result: list[Case] = []
    for name, group in GROUPS.items():
        if only and name not in only:
            continue
        cases = list(group.make(context))
        result += sampled(cases, group.quick) if quick else cases
    counts = Counter(case.name for case in result)
    twice = [name for name, count in counts.items() if count > 1]
    if twice:
        raise AssertionError(f"two cases are called {twice[0]}")
    return result


@dataclasses.dataclass
class Allowed:
    """Cases that may differ, and why."""

    pattern: re.Pattern[str]
    reason: str
    used: int = 0


def read_allowed(path: Path) -> list[Allowed]:
    """Lines `REGULAR EXPRESSION  # reason`; empty lines and those that begin with # say nothing."""
    allowed: list[Allowed] = []
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise UsageError(f"{path}: {error.strerror}") from error
    for number, line in enumerate(lines, 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        expression, hash_sign, reason = line.partition(" #")
        if not hash_sign or not reason.strip():
            raise UsageError(f"{path}:{number}: no reason; expected: REGULAR EXPRESSION  # reason")
        try:
            allowed.append(Allowed(re.compile(expression.strip()), reason.strip()))
        except re.error as error:
            raise UsageError(f"{path}:{number}: no regular expression: {error}") from error
    return allowed


def parse_arguments(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="same_output.py",
        description="Compares all outputs of two binaries of gnomon, byte for byte.",
        epilog="groups: " + " ".join(GROUPS),
    )
    parser.add_argument("--reference", required=True, type=Path, metavar="BIN", help="the binary that is right")
    parser.add_argument(
        "--candidate", required=True, type=Path, metavar="BIN", help="the binary to be compared with it"
    )
    size = parser.add_mutually_exclusive_group()
    size.add_argument(
        "--quick", action="store_true", help="a sample of every group, kernel and algorithm (the default)"
    )
    size.add_argument("--full", action="store_true", help="every case")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count() or 1, metavar="N", help="cases at a time")
    parser.add_argument("--only", nargs="+", default=[], choices=GROUPS, metavar="GROUP", help="only these groups")
    parser.add_argument("--match", type=re.compile, metavar="REGEX", help="only cases in whose name this is found")
    parser.add_argument("--allow", type=Path, metavar="FILE", help="differences that are meant, with reasons")
    parser.add_argument("--keep", type=Path, metavar="DIR", help="remember the reference here, and keep what differs")
    parser.add_argument(
        "--scenes",
        type=Path,
        default=HERE.parent.parent,
        metavar="ROOT",
        help="folder with examples and tests/regressions [of this checkout]",
    )
    parser.add_argument("--limit", type=float, default=60, metavar="S", help="seconds that a case may take [60]")
    parser.add_argument("--list", action="store_true", help="print the names of the cases, and run nothing")
    options = parser.parse_args(arguments)
    if options.jobs < 1:
        parser.error("--jobs: at least 1")
    return options


def check_binary(path: Path) -> Path:
    if not path.is_file() or not os.access(path, os.X_OK):
        raise UsageError(f"{path} is no program")
    return path.resolve()


def snapshot(root: Path, target: Path) -> None:
    """A copy of the scenes, so that nobody's work on them meanwhile is a difference."""
    for name in ("examples", "tests/regressions"):
        if not (root / name).is_dir():
            raise UsageError(f"{root} has no {name}; --scenes names the folder that has")
        shutil.copytree(root / name, target / name)


def context_of(reference: Path, scenes: Path) -> Context:
    listing = subprocess.run([reference, "generate", "--list"], capture_output=True, text=True, check=False)
    if listing.returncode != 0:
        raise UsageError(f"{reference} does not list what it generates: {listing.stderr.strip()}")
    generators, campaign_generators = parse_generators(listing.stdout)
    return Context(read_scenes(scenes), generators, campaign_generators, scenes)


def run_all(comparison: Comparison, cases: list[Case], jobs: int) -> Iterator[Verdict]:
    """Verdicts in the order of the cases; a line tells how far it is, on a terminal."""
    terminal = sys.stderr.isatty()
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        futures = [pool.submit(comparison.compare, case, number) for number, case in enumerate(cases)]
        try:
            for number, future in enumerate(futures, 1):
                verdict = future.result()
                if terminal:
                    print(f"\r{number:,} of {len(cases):,} cases \033[K", end="", file=sys.stderr, flush=True)
                yield verdict
        except BaseException:
            pool.shutdown(wait=True, cancel_futures=True)
            raise
        finally:
            if terminal:
                print("\r\033[K", end="", file=sys.stderr, flush=True)


class Report:
    """What is printed: differences as they come, then a line a group."""

    def __init__(self, allowed: list[Allowed], limit: float):
        self.allowed = allowed
        self.limit = limit
        self.shown = 0
        self.verdicts: dict[str, list[Verdict]] = {}
        self.meant: list[tuple[str, str]] = []
        self.failed: set[str] = set()

    def add(self, verdict: Verdict) -> None:
        case = verdict.case
        self.verdicts.setdefault(case.group, []).append(verdict)
        if not verdict.differing and not verdict.too_long:
            return
        what = f"{verdict.too_long} took more than {self.limit:g} s and was killed"
        if verdict.differing:
            shown = verdict.differing[:PARTS_NAMED]
            if len(verdict.differing) > PARTS_NAMED:
                shown.append(f"{len(verdict.differing) - PARTS_NAMED} more")
            what = ", ".join(shown) + (" differs" if len(shown) == 1 else " differ")
        for entry in self.allowed:
            if entry.pattern.fullmatch(case.name):
                entry.used += 1
                self.meant.append((f"{case.name}: {what}", entry.reason))
                return
        self.failed.add(case.name)
        print(f"{case.name}: {what}")
        if self.shown < DIFFS_SHOWN:
            self.shown += 1
            print(verdict.text, flush=True)
        elif self.shown == DIFFS_SHOWN:
            self.shown += 1
            print("(of what follows the names alone)")

    def finish(self) -> int:
        if self.meant:
            print("allowed:")
            for line, reason in self.meant:
                print(f"  {line}\n    {reason}")
        for entry in self.allowed:
            if entry.used == 0:
                print(f"allowed, but nothing of the kind differs: {entry.pattern.pattern}")
        for group, verdicts in self.verdicts.items():
            differing = sum(v.case.name in self.failed and not v.too_long for v in verdicts)
            too_long = sum(v.case.name in self.failed and bool(v.too_long) for v in verdicts)
            meant = sum((bool(v.differing) or bool(v.too_long)) and v.case.name not in self.failed for v in verdicts)
            statuses = Counter(status for verdict in verdicts for status in verdict.statuses)
            end = ", ".join(
                [f"{differing} differ"] * bool(differing)
                + [f"{too_long} not compared: too long"] * bool(too_long)
                + [f"{meant} allowed to differ"] * bool(meant)
            )
            print(
                f"{group}: {len(verdicts):,} cases, {sum(len(v.statuses) for v in verdicts):,} runs, "
                f"{sum(v.size for v in verdicts):,} bytes compared, exit status "
                + ", ".join(f"{status} {count:,} times" for status, count in sorted(statuses.items()))
                + f": {end or 'all equal'}"
            )
        return 1 if self.failed else 0


def compare_binaries(options: argparse.Namespace, work: Path) -> int:
    binaries = {"reference": check_binary(options.reference), "candidate": check_binary(options.candidate)}
    allowed = read_allowed(options.allow) if options.allow else []
    scenes = work / "scenes"
    snapshot(options.scenes, scenes)
    scenes_digest = digest_of_tree(scenes)
    cases = chosen_cases(context_of(binaries["reference"], scenes), options.only, not options.full)
    if options.match:
        cases = [case for case in cases if options.match.search(case.name)]
    if not cases:
        raise UsageError("no case is left of those asked for")
    if options.list:
        print("\n".join(case.name for case in cases))
        return 0
    digests = {name: sha256_of(path) for name, path in binaries.items()}
    # Anything in this folder may change what is compared, and the scenes may.
    tools = "".join(sha256_of(path) for path in sorted(HERE.glob("*.py")))
    inputs = hashlib.sha256(f"{tools}{scenes_digest}".encode()).hexdigest()
    differences = None
    if options.keep:
        differences = options.keep / "differences"
        shutil.rmtree(differences, ignore_errors=True)
    memory = Memory(options.keep / "reference" / f"{digests['reference']}.jsonl" if options.keep else None)
    runners = {name: Runner(path, scenes, work / name, options.limit) for name, path in binaries.items()}
    comparison = Comparison(runners["reference"], runners["candidate"], memory, inputs, differences)
    report = Report(allowed, options.limit)
    try:
        for verdict in run_all(comparison, cases, options.jobs):
            report.add(verdict)
    finally:
        memory.close()
    for name, path in binaries.items():
        if sha256_of(path) != digests[name]:
            raise UsageError(f"{path} was changed meanwhile")
    if digest_of_tree(scenes) != scenes_digest:
        raise UsageError("a case changed the scenes that all cases share")
    return report.finish()


def main(arguments: list[str] | None = None) -> int:
    options = parse_arguments(arguments)
    if options.keep:
        options.keep = options.keep.resolve()
        options.keep.mkdir(parents=True, exist_ok=True)
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # what was made is removed then, too
    work = Path(tempfile.mkdtemp(prefix="same_output."))
    try:
        return compare_binaries(options, work)
    except UsageError as error:
        print(f"same_output.py: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    finally:
        shutil.rmtree(work, ignore_errors=True)


if __name__ == "__main__":
    sys.exit(main())
