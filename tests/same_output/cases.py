# SPDX-License-Identifier: GPL-3.0-or-later
"""What is run: groups of cases, each of one or more command lines in an empty directory.

A case's name says what it is, from the general to the particular, and stays the same from run to run:
allowed differences are named by it. Its stratum is what `--quick` takes its sample by, so that a sample
still has every kernel under every algorithm.
"""

import json
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

EXACT_KERNELS = ("epeck", "rational", "plane")
ROUNDED_KERNELS = ("float", "double", "longdouble", "epick")
KERNELS = ROUNDED_KERNELS + EXACT_KERNELS
POLICIES = tuple(
    f"{kernel}{policy}"
    for kernel in ("float", "double", "longdouble")
    for policy in ("+thin", "+identity", "+identity+thin")
) + ("epick+identity",)
FORMATS = ("json", "obj", "off", "ply", "ply-binary")
COMMANDS = ("certify", "shadows", "verify", "render", "info", "generate", "convert", "shrink", "fuzz", "replay")

# The mistakes of the zoo with a generator of scenes that show them.
MUTANTS = (
    ("double+identity+thin/svbsp~planes-from-fragments", "soup-lattice"),
    ("double+thin/svbsp~vertices-per-side", "soup-lattice"),
    ("plane/svbsp~coplanar-in-sequence", "mix"),
    ("rational/svbsp~light-in-plane-faces", "mix"),
    ("plane/sectors/merged~union-without-continued-planes", "area-mix"),
    ("double~thickness-too-large", "mix"),
    ("double/svbsp~thickness-too-small", "mix"),
    ("plane/svbsp~t-vertices-left-in", "mix"),
    ("plane~straddling-light-faces", "area-mix"),
    ("plane/svbsp~slivers-dropped", "mix"),
    ("plane~on-swapped", "mix"),
    ("plane~on-swapped", "area-mix"),
)

# No scene of a campaign or a corpus may run out of time because the machine is busy.
PATIENT = ("--seconds", "50")

TABLE = b"""{"format": "gnomon-scene", "version": 1, "name": "table",
 "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0],[1,1,1],[2,1,1],[2,2,1],[1,2,1]],
 "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "quad", "loop": [4,5,6,7]}],
 "lights": [{"id": "bulb", "type": "point", "position": [1,1,2]}]}
"""
PANEL = (
    b'{"format": "gnomon-scene", "version": 1, "vertices": [], "polygons": [], "lights": ['
    b'{"id": "added-panel", "type": "area", "loop": [[1,1,3],[1,2,3],[2,2,3],[2,1,3]]}, '
    b'{"id": "added-moon", "type": "directional", "to_light": [0.5,0.25,2]}]}\n'
)


@dataclass(frozen=True)
class Step:
    """One run of the program.

    An argument may have `{first:PATTERN}`, the first path that matches, or `{case:FILE}`, the first
    case that a campaign's database keeps: what earlier steps wrote decides.
    """

    arguments: tuple[str, ...]
    stdin: bytes = b""
    stdout: str = "pipe"  # or "full": a full disk; or "closed": a reader that has gone


@dataclass(frozen=True)
class Case:
    """Runs in one directory, which are compared together with all that they leave there."""

    group: str
    name: str
    steps: tuple[Step, ...]
    stratum: str = ""
    files: tuple[tuple[str, bytes], ...] = ()
    copies: tuple[tuple[str, str], ...] = ()  # folders of scenes that the case may change
    big: bool = False  # in a sample only where its stratum has nothing smaller


@dataclass(frozen=True)
class Scene:
    """A scene file, as far as the choice of cases has to know it."""

    path: str  # relative to the root
    kinds: frozenset[str]  # of its lights: "point" (or directional), "area"; empty: must be rejected
    lights: tuple[str, ...]
    extent: float
    data: bytes

    @property
    def short(self) -> str:
        return self.path.removeprefix("tests/")

    @property
    def is_example(self) -> bool:
        return self.path.startswith("examples/")

    @property
    def big(self) -> bool:
        return len(self.data) > 5000

    @property
    def readable(self) -> bool:
        return bool(self.kinds)

    @property
    def kind(self) -> str:
        return "+".join(sorted(self.kinds)) or "rejected"

    def algorithms(self) -> dict[str, tuple[str, ...]]:
        """The ways to find shadows in this scene, with their options."""
        ways: dict[str, tuple[str, ...]] = {}
        if "point" in self.kinds:
            ways["sectors"] = ("--algorithm", "sectors")
            ways["svbsp"] = ("--algorithm", "svbsp")
        ways["receiver"] = ("--algorithm", "receiver")
        if "area" in self.kinds:
            ways["merged"] = ("--algorithm", "merged")
            ways["pieces"] = ("--pieces",)
        return ways


@dataclass(frozen=True)
class Generator:
    """A scene of `gnomon generate`, with the ranges of its parameters."""

    name: str
    parameters: tuple[tuple[str, int, int, int], ...]  # name, default, least, most


@dataclass(frozen=True)
class Context:
    """All that cases are made from."""

    scenes: tuple[Scene, ...]
    generators: tuple[Generator, ...]
    campaign_generators: tuple[str, ...]
    root: Path

    @property
    def good(self) -> tuple[Scene, ...]:
        return tuple(scene for scene in self.scenes if scene.readable)

    @property
    def examples(self) -> tuple[Scene, ...]:
        return tuple(scene for scene in self.good if scene.is_example)


def read_scene(root: Path, path: Path) -> Scene:
    """Facts of one scene. What is no scene, or is in the folder of what must be rejected, has no lights."""
    data = path.read_bytes()
    kinds: set[str] = set()
    ids: list[str] = []
    extent = 1.0
    if not path.name.startswith("n_"):
        content = json.loads(data)
        for number, light in enumerate(content.get("lights", [])):
            kinds.add("area" if light["type"] == "area" else "point")
            ids.append(light.get("id", str(number)))
        axes = list(zip(*content["vertices"]))
        extent = max((max(axis) - min(axis) for axis in axes), default=1.0) or 1.0
    relative = path.relative_to(root).as_posix()
    return Scene(relative, frozenset(kinds), tuple(ids), extent, data)


def read_scenes(root: Path) -> tuple[Scene, ...]:
    """All examples and all regressions below a root."""
    files = sorted((root / "examples").glob("*.json"))
    for path in sorted((root / "tests/regressions").glob("*/*")):
        if path.is_file() and not path.name.endswith(".expected.json"):
            files.append(path)
    return tuple(read_scene(root, path) for path in files)


def parse_generators(listing: str) -> tuple[tuple[Generator, ...], tuple[str, ...]]:
    """What `gnomon generate --list` names: scenes with their parameters, generators of campaigns."""
    scenes: list[Generator] = []
    head, _, tail = listing.partition("Small degenerate scenes of campaigns")
    parameter = re.compile(r" {6}([a-z0-9_]+)=(-?[0-9]+) ")
    limits = re.compile(r"\((-?[0-9]+)\.\.(-?[0-9]+)\)$")
    waiting: tuple[str, int] | None = None
    for line in head.splitlines():
        if re.fullmatch(r"[a-z0-9-]+", line):
            scenes.append(Generator(line, ()))
        if match := parameter.match(line):
            waiting = (match[1], int(match[2]))
        if waiting and (match := limits.search(line)):
            known = scenes.pop()
            found = (waiting[0], waiting[1], int(match[1]), int(match[2]))
            scenes.append(Generator(known.name, (*known.parameters, found)))
            waiting = None
    return tuple(scenes), tuple(tail.partition("\n")[2].split())


def case(
    group: str,
    name: str,
    *commands: Iterable[str] | Step,
    stratum: str = "",
    files: Iterable[tuple[str, bytes]] = (),
    copies: Iterable[tuple[str, str]] = (),
    big: bool = False,
) -> Case:
    """A case of command lines, each a tuple of arguments or a step."""
    steps = tuple(c if isinstance(c, Step) else Step(tuple(c)) for c in commands)
    return Case(group, f"{group}/{name}", steps, stratum, tuple(files), tuple(copies), big)


def detail(kernel: str) -> tuple[str, ...]:
    """As much of a result as a kernel can write."""
    if kernel in EXACT_KERNELS:
        return ("--fragments", "--exact-fractions", "--exact-loops")
    return ("--fragments",)


def shadows_cases(context: Context) -> Iterator[Case]:
    """Every scene on every kernel by every algorithm, on one thread and on two."""
    for scene in context.scenes:
        if not scene.readable:
            for kernel in ("plane", "double"):
                run = ("shadows", scene.path, "--kernel", kernel)
                yield case("shadows", f"{scene.short}/{kernel}", run, stratum="rejected")
            continue
        for kernel in KERNELS:
            for algorithm, options in scene.algorithms().items():
                run = ("shadows", scene.path, "--kernel", kernel, *options, *detail(kernel))
                yield case(
                    "shadows",
                    f"{scene.short}/{kernel}/{algorithm}",
                    (*run, "-j", "1"),
                    (*run, "-j", "2"),
                    stratum=f"{kernel}/{algorithm}/{scene.kind}",
                )


def policies_cases(context: Context) -> Iterator[Case]:
    """Rounded kernels with knowledge by identity, and with planes without thickness."""
    for scene in context.good:
        for kernel in POLICIES:
            for algorithm, options in scene.algorithms().items():
                if algorithm in ("receiver", "pieces") and not scene.is_example:
                    continue
                run = ("shadows", scene.path, "--kernel", kernel, *options, "--fragments", "-j", "1")
                yield case("policies", f"{scene.short}/{kernel}/{algorithm}", run, stratum=f"{kernel}/{algorithm}")
    for scene in context.examples:
        for kernel in ROUNDED_KERNELS:
            for name, options in (
                ("identity", ("--identity",)),
                ("thickness-0", ("--thickness", "0")),
                ("thickness-1e-6", ("--thickness", "1e-6")),
            ):
                run = ("shadows", scene.path, "--kernel", kernel, *options, "--fragments", "-j", "1")
                yield case("policies", f"{scene.short}/{kernel}/{name}", run, stratum=f"{kernel}/{name}")


def _option_sets(scene: Scene, kernel: str) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Options of `shadows` that suit a scene and a kernel, each under a name."""
    exact = kernel in EXACT_KERNELS
    loops = ("--exact-loops", "--exact-fractions") if exact else ()
    yield "shares-alone", ()
    yield "combined", ("--combined", "--fragments")
    yield "combined-alone", ("--combined", *loops)
    yield "combined-receiver", ("--combined", "--algorithm", "receiver", "--fragments", *loops)
    yield "combined-sectors", ("--combined", "--algorithm", "sectors")  # an error
    for name in ("lit", "shadow", "penumbra", "umbra"):
        yield f"{name}-only", (f"--{name}-only", "--fragments")
    for light in scene.lights:
        yield f"light-{light}", ("--light", light, "--fragments")
    yield "decimals", ("--numbers", "decimal", "--fragments", *loops)
    size = scene.extent
    more = (
        f"--point={size / 4},{size / 8},{size * 2}",
        "--sun=0.25,0.125,1",
        f"--area=0,0,{size}:0,{size / 4},{size}:{size / 4},{size / 4},{size}:{size / 4},0,{size}",
    )
    for algorithm in ("auto", "svbsp", "receiver", "merged"):
        yield f"more-lights-{algorithm}", (*more, "--fragments", *loops, "--algorithm", algorithm)
        yield f"more-lights-combined-{algorithm}", (*more, "--combined", "--algorithm", algorithm)
        yield f"stats-{algorithm}", ("--stats", "--algorithm", algorithm)
    yield "more-lights-pieces", (*more, "--pieces", "--fragments", *loops)
    yield "lights-file", ("--lights", "lights.json", "--fragments")
    if "point" in scene.kinds:
        yield "no-merge", ("--no-merge", "--fragments", *loops)
        yield "no-prefix", ("--no-prefix", "--fragments", *loops)
        yield "no-merge-no-prefix", ("--no-merge", "--no-prefix", "--fragments", "--stats")
    if "area" in scene.kinds:
        yield "pieces-combined", ("--pieces", "--combined", "--fragments")
        yield "pieces-stats", ("--pieces", "--stats")
        yield "pieces-receiver", ("--pieces", "--algorithm", "receiver")  # an error
    if not exact:
        return
    if "area" in scene.kinds:
        for algorithm in ("receiver", "merged"):
            yield (
                f"deep-umbra-{algorithm}",
                (
                    *("--deep-umbra", "--deep-umbra-tolerance", "0.05"),
                    *("--algorithm", algorithm, "--fragments"),
                ),
            )
    step = f"{size / 10:.3g}"
    illuminate = ("--illuminate", "--mesh")
    yield "illuminate-ply", (*illuminate, "mesh.ply")
    yield "illuminate-grid", (*illuminate, "mesh.ply", "--grid", step, "--stats")
    yield "illuminate-two-grids", (*illuminate, "mesh.gltf", "--grid", f"{step},{size / 25:.3g}", "--tint")
    yield "illuminate-adaptive", (*illuminate, "mesh.glb", "--adaptive", "0.2", "--ambient", "0.125", "--stats")
    yield "illuminate-exposure", (*illuminate, "mesh.gltf", "--exposure", "3", "--ambient", "0.5")
    yield "illuminate-receiver", (*illuminate, "mesh.ply", "--algorithm", "receiver")
    yield "illuminate-stats-alone", ("--illuminate", "--stats")
    yield "illuminate-more-lights", (*more, *illuminate, "mesh.ply", "--stats")
    if "area" in scene.kinds:
        yield "illuminate-merged", (*illuminate, "mesh.ply", "--algorithm", "merged", "--grid", step)


def options_cases(context: Context) -> Iterator[Case]:
    """Every other option of `shadows`, on the examples."""
    for scene in context.examples:
        for kernel in ("plane", "rational", "double"):
            for name, options in _option_sets(scene, kernel):
                command = ("shadows", scene.path, "--kernel", kernel, *options)
                # On one thread and on two; a mesh is written by each.
                runs = [(*command, "-j", jobs) for jobs in ("1", "2")]
                if "--mesh" in options:
                    at = command.index("--mesh") + 1
                    runs[1] = (*command[:at], "two-" + command[at], *command[at + 1 :], "-j", "2")
                yield case(
                    "options",
                    f"{scene.short}/{kernel}/{name}",
                    *runs,
                    stratum=f"{kernel}/{name}" if not name.startswith("light-") else f"{kernel}/light",
                    files=[("lights.json", PANEL)] if name == "lights-file" else [],
                    big=scene.big,
                )
        yield case(
            "options",
            f"{scene.short}/to-a-file",
            ("shadows", scene.path, "--fragments", "-o", "result.json"),
            stratum="to-a-file",
        )
        yield case(
            "options",
            f"{scene.short}/standard-input",
            Step(("shadows", "-", "--fragments"), stdin=scene.data),
            stratum="standard-input",
        )
        yield case("options", f"{scene.short}/default", ("shadows", scene.path), stratum="default")
        yield case(
            "options",
            f"{scene.short}/exact",
            ("shadows", scene.path, "--kernel", "exact", "--fragments"),
            stratum="exact",
        )


def certify_cases(context: Context) -> Iterator[Case]:
    """Certificates, as text and as JSON."""
    json_too = ("--json", "verdict.json")
    for scene in context.scenes:
        plain = ("certify", scene.path)
        if not scene.readable:
            yield case("certify", f"{scene.short}/plain", plain, stratum="rejected")
            continue
        variants: list[tuple[str, tuple[str, ...]]] = [
            ("plain", (*json_too, "-j", "1")),
            ("explain", ("--explain", *json_too, "-j", "2")),
            ("both", ("--algorithm", "both", "--explain", *json_too)),
        ]
        for algorithm in ("receiver", "merged") if "area" in scene.kinds else ("receiver", "svbsp"):
            kernels = ("--kernel", "double", "--kernel", "plane", "--kernel", "double+identity+thin")
            variants.append((algorithm, ("--algorithm", algorithm, *kernels, *json_too)))
        if scene.is_example:
            some = ("--kernel", "float", "--kernel", "double", "--kernel", "plane")
            variants += [
                ("report", ("--report", "report", *some)),
                ("report-times", ("--report", "report", "--times", *some)),
                ("times", (*some, *json_too, "--times")),
                ("strict", (*some, *json_too, "--strict")),
                ("clearance", (*some, *json_too, "--clearance", "1e-6")),
                ("leaks", (*some, *json_too, "--leaks", "0", "--tolerance", "0.01", "--width", "0.001")),
                ("thickness", (*some, *json_too, "--thickness", "1e-5")),
                ("policies", tuple(word for name in POLICIES for word in ("--kernel", name)) + json_too),
                ("first-light", ("--light", scene.lights[0], *some, *json_too)),
                ("decimals", ("--numbers", "decimal", *some, *json_too)),
                ("json-alone", ("--json", "-", *some)),
            ]
        for name, options in variants:
            yield case(
                "certify", f"{scene.short}/{name}", (*plain, *options), stratum=f"{name}/{scene.kind}", big=scene.big
            )
        judged = ("certify", scene.path, "--candidate", "result.json", *json_too)
        for kernel in ("float", "plane"):
            made = ("shadows", scene.path, "--kernel", kernel, "--fragments", "-o", "result.json")
            runs = [made, judged, (*judged[:-1], "again.json", "--subset", "--report", "report")]
            yield case(
                "certify",
                f"{scene.short}/candidate-{kernel}",
                *runs,
                stratum=f"candidate-{kernel}/{scene.kind}",
                big=scene.big,
            )
    yield from foreign_cases()


def foreign_cases() -> Iterator[Case]:
    """Results as other programs write them: right, wrong, incomplete, no result at all."""
    lit = '{"class": "lit", "loop": [[0,0,0],[4,0,0],[4,4,0],[0,4,0]]}'
    results = {
        "nothing-in-shadow": '{"lights": [{"id": "bulb", "background": "lit", "polygons": ['
        '{"id": "floor", "fragments": []}, {"id": "quad", "fragments": []}]}]}',
        "overlapping": f'{{"lights": [{{"id": "bulb", "polygons": [{{"id": "floor", "fragments": [{lit}, {lit}]}}]}}]}}',
        "shares": '{"lights": [{"id": "bulb", "polygons": [{"id": "floor", "lit": "3/4"}, {"id": "quad", "lit": 1}]}]}',
        "wrong-class": '{"lights": [{"id": "bulb", "polygons": [{"id": "floor", "fragments": [{"class": "grey", "loop": []}]}]}]}',
        "no-such-light": '{"lights": [{"id": "moon", "polygons": []}]}',
        "no-lights": "{}",
        "no-json": "shadow everywhere\n",
    }
    for name, text in results.items():
        files = [("table.json", TABLE), ("result.json", text.encode())]
        for command in (
            ("certify", "table.json", "--candidate", "result.json", "--json", "verdict.json"),
            ("certify", "table.json", "--candidate", "result.json", "--subset"),
            ("verify", "table.json", "result.json", "--subset"),
            ("render", "table.json", "result.json"),
            ("render", "table.json", "--candidate", "result.json"),
        ):
            options = "-".join(word.lstrip("-") for word in command[1:] if word.startswith("--"))
            yield case(
                "certify",
                f"foreign/{name}/{command[0]}-{options}".rstrip("-"),
                command,
                stratum=f"foreign/{command[0]}",
                files=files,
            )


def verify_cases(context: Context) -> Iterator[Case]:
    """The claims of a result just written, right and with a number changed."""
    for scene in context.good:
        for kernel, options in (
            ("plane", ("--exact-loops", "--exact-fractions")),
            ("plane", ("--fragments",)),
            ("double", ("--fragments",)),
            ("rational", ("--fragments", "--algorithm", "merged" if "area" in scene.kinds else "svbsp")),
            ("float", ("--fragments", "--umbra-only" if "area" in scene.kinds else "--lit-only")),
        ):
            make = ("shadows", scene.path, "--kernel", kernel, *options, "-o", "result.json")
            check = ("verify", scene.path, "result.json")
            name = f"{kernel}-{options[0].lstrip('-')}" + ("-" + options[-1].lstrip("-") if len(options) > 1 else "")
            yield case(
                "verify",
                f"{scene.short}/{name}",
                make,
                check,
                (*check, "--json", "findings.json", "-j", "2"),
                ("verify", scene.path, "result.json", "--tolerance", "0", "--width", "0", "--json", "-"),
                stratum=f"{name}/{scene.kind}",
            )
    # A result of one scene is false for another.
    for one, other in zip(context.examples, context.examples[1:]):
        make = ("shadows", one.path, "--fragments", "-o", "result.json")
        yield case(
            "verify",
            f"{one.short}/as-{Path(other.path).stem}",
            make,
            ("verify", other.path, "result.json"),
            stratum="of-another",
        )


def render_cases(context: Context) -> Iterator[Case]:
    """Pictures."""
    for scene in context.scenes:
        yield case("render", f"{scene.short}/plain", ("render", scene.path), stratum=f"plain/{scene.kind}")
        if not scene.readable:
            continue
        make = ("shadows", scene.path, "--kernel", "float", "--fragments", "-o", "result.json")
        shown = ("render", scene.path, "result.json", "--fragments", "-o", "picture.svg")
        marked = ("render", scene.path, "--candidate", "result.json", "-o", "marked.svg")
        yield case("render", f"{scene.short}/result", make, shown, marked, stratum=f"result/{scene.kind}")
        if not scene.is_example:
            continue
        size = scene.extent
        step = f"{size / 10:.3g}"
        for name, options in (
            ("fragments", ("--fragments",)),
            ("both", ("--algorithm", "both", "--fragments")),
            ("svbsp", ("--algorithm", "svbsp", "--fragments")),
            ("merged", ("--algorithm", "merged", "--fragments")),
            ("receiver", ("--algorithm", "receiver", "--fragments")),
            ("backs", ("--backs", "--no-legend", "-j", "1")),
            ("camera", (f"--eye={size * 2},{-size},{size}", "--look-at=0,0,0", "--up=0,1,1", "--fov", "40")),
            ("small", ("--width", "320", "--height", "200", "-j", "2")),
            ("all-lights", tuple(word for light in scene.lights for word in ("--light", light))),
            ("more-lights", (f"--point=0,0,{size * 3}", "--light", "point0", "--fragments")),
            ("illuminate", ("--illuminate",)),
            ("illuminate-grid", ("--illuminate", "--grid", step, "--ambient", "0.125", "-o", "picture.svg")),
            ("illuminate-adaptive", ("--illuminate", "--adaptive", "0.2", "--exposure", "3")),
            ("illuminate-tint", ("--illuminate", "--tint", "--algorithm", "svbsp", "--fragments")),
        ):
            yield case("render", f"{scene.short}/{name}", ("render", scene.path, *options), stratum=name)


def scenes_cases(context: Context) -> Iterator[Case]:
    """What is read and written: facts of scenes, and scenes in other formats."""
    for scene in context.scenes:
        facts = ("info", scene.path)
        yield case(
            "scenes",
            f"{scene.short}/info",
            facts,
            (*facts, "--all", "--json", "info.json", "-j", "2"),
            (*facts, "--numbers", "decimal", "--json", "-"),
            stratum=f"info/{scene.kind}",
        )
        if not scene.readable:
            yield case("scenes", f"{scene.short}/convert", ("convert", scene.path, "-"), stratum="convert/rejected")
            continue
        for form in FORMATS:
            target = "scene." + form.removesuffix("-binary")
            lights = ("--sun=0.25,0.125,1",) if form != "json" else ()
            yield case(
                "scenes",
                f"{scene.short}/{form}",
                ("convert", scene.path, target, *(("--format", form) if "-" in form else ())),
                ("info", target, *lights),
                ("convert", target, "back.json", *lights),
                ("shadows", target, *lights),
                ("convert", scene.path, "-", "--format", form, "--numbers", "decimal"),
                stratum=f"{form}/{scene.kind}",
            )


def generate_cases(context: Context) -> Iterator[Case]:
    """Every scene that can be made, and what the commands say of it."""
    yield case("generate", "list", ("generate", "--list"), ("generate", "--list", "-o", "list.txt"), stratum="list")
    small = {"n": 8, "level": 2}
    for generator in context.generators:
        chosen = {
            name: min(max(small[name], least), most)
            for name, default, least, most in generator.parameters
            if name in small and default > small[name]
        }
        settings = [("small", chosen)]
        for name, default, least, most in generator.parameters:
            if name not in small:
                values = range(least, most + 1) if most - least <= 3 else (least, min(default + 1, most))
                settings += [(f"{name}-{value}", chosen | {name: value}) for value in values if value != default]
        for label, setting in settings:
            parameters = [word for name, value in setting.items() for word in ("--param", f"{name}={value}")]
            run = ("generate", generator.name, *parameters)
            yield case(
                "generate",
                f"{generator.name}/{label}",
                (*run, "--seed", "3", "-o", "scene.json"),
                (*run, "-o", "scene.ply"),
                ("info", "scene.json"),
                *(
                    ("shadows", "scene.json", "--fragments", "--algorithm", a, "-o", f"{a}.json")
                    for a in ("auto", "svbsp", "receiver", "merged")
                ),
                ("shadows", "scene.json", "--combined"),
                ("certify", "scene.json", "--kernel", "float", "--kernel", "plane", "--json", "-"),
                stratum=generator.name,
            )
    for name in context.campaign_generators:
        for moves in ("", "+any", "+duplicate+sliver"):
            runs = [("generate", name + moves, "--seed", str(seed)) for seed in (1, 7, 12345678901)]
            yield case("generate", f"{name}{moves}", *runs, stratum=f"campaign{moves}")


def fuzz_cases(context: Context) -> Iterator[Case]:
    """Campaigns. The field "answers" sums up what every subject said on every scene."""
    base = ("fuzz", *PATIENT)
    for generator in ("mix", "area-mix"):
        for seed in range(1, 31):
            run = (*base, "--seed", str(seed), "--generator", generator)
            yield case(
                "fuzz", f"{generator}/{seed}", (*run, "--count", "300", "-j", "1", "--json", "-"), stratum="long"
            )
            yield case(
                "fuzz",
                f"{generator}/threads/{seed}",
                (*run, "--count", "40", "-j", "2", "--json", "figures.json"),
                stratum=f"threads/{generator}",
            )
    yield case(
        "fuzz", "kinds", (*base, "--generator", "soup-lattice", "--count", "1000", "--json", "-"), stratum="kinds"
    )
    for name in context.campaign_generators:
        for moves in ("", "+any"):
            run = (
                *base,
                "--seed",
                "5",
                "--generator",
                name + moves,
                "--count",
                "20",
                "-j",
                "1",
                "--json",
                "figures.json",
            )
            yield case("fuzz", f"generator/{name}{moves}", run, stratum=f"generator{moves}")
    for generator in ("mix", "area-mix"):
        run = (*base, "--seed", "9", "--generator", generator)
        yield case(
            "fuzz",
            f"every-kernel/{generator}",
            (*run, "--every-kernel", "--count", "30", "--json", "-", "-j", "1"),
            stratum="every-kernel",
        )
        for kernel in (
            *KERNELS,
            *POLICIES,
            "plane/svbsp/merged",
            "plane/receiver",
            "double/svbsp/merged",
            "float/receiver",
        ):
            yield case(
                "fuzz",
                f"kernel/{kernel}/{generator}",
                (*run, "--kernel", kernel, "--count", "40", "--json", "figures.json", "-j", "1"),
                stratum=f"kernel/{kernel}",
            )
        # --findings gives up shrinking after a minute of the clock, so these are scenes of small numbers,
        # which takes seconds even where the machine is busy.
        small = generator.replace("mix", "soup-lattice")
        for kernel in ("float+thin", "double+thin", "double", "epick"):
            campaign = ("fuzz", *PATIENT, "--seed", "9", "--generator", small, "--kernel", kernel, "--count", "30")
            yield case(
                "fuzz",
                f"findings/{kernel}/{small}",
                (*campaign, "--keep", "1", "--db", "a.db", "--findings", "findings", "-j", "1"),
                ("replay", "{first:findings/*}"),
                ("replay", "{first:findings/*}", "--kernel", "plane", "-o", "scene.json"),
                ("replay", "a.db"),
                ("replay", "a.db", "--case", "{case:a.db}", "--kernel", kernel, "-o", "case.json"),
                ("certify", "{first:findings/*}/scene.json", "--json", "-"),
                stratum=f"findings/{kernel}",
            )
        # Campaigns go on where they were, and shards add up.
        yield case(
            "fuzz",
            f"database/{generator}",
            *((*run, "--count", count, "--db", "a.db") for count in ("10", "25", "25")),
            (*run, "--count", "25", "--db", "a.db", "--kernel", "double"),
            stratum="database",
        )
        # A shard has every third thousand: 20 cases of the first, 30 of the third; none twice.
        shards = [
            (*run, "--count", count, "--shard", f"{k}/3", "--db", f"{k}.db", "-j", "2")
            for k, count in ((0, "20"), (2, "2030"))
        ]
        merge = [("fuzz", "--db", "all.db", "--merge", f"{k}.db", "--json", "-") for k in (0, 2, 2)]
        yield case("fuzz", f"shards/{generator}", *shards, *merge, stratum="shards")
        foreign = ("--candidate-command", "./gnomon shadows --kernel float --fragments")
        yield case(
            "fuzz",
            f"foreign/{generator}",
            # Without --findings: a minute is little for a program that is started hundreds of times. Group
            # `shrink` has one.
            (*run, *foreign, "--count", "8", "-j", "1", "--keep", "1"),
            stratum="foreign",
        )
        yield case(
            "fuzz",
            f"refusing/{generator}",
            (*run, "--candidate-command", "exit 7 #", "--count", "2", "-j", "1", "--fail-on", "no-refusal"),
            stratum="foreign",
        )
    for what in ("float+thin", "oracle", "misclassified", "any", "nothing-of-the-kind"):
        yield case(
            "fuzz",
            f"fail-on/{what}",
            (*base, "--generator", "mix", "--kernel", "float+thin", "--count", "12", "--fail-on", what, "-j", "1"),
            stratum="fail-on",
        )
    for name in (
        "no-crash",
        "budget",
        "no-refusal",
        "oracle",
        "exact-agreement",
        "metamorphic",
        "claims",
        "round-trip",
        "preparation",
        "oracle-itself",
    ):
        run = (*base, "--property", name, "--count", "20", "-j", "1", "--json", "-")
        yield case("fuzz", f"property/{name}", run, (*run, "--kernel", "double"), stratum="property")
    yield case("fuzz", "fragments", (*base, "--fragments", "4", "--count", "12", "-j", "1"), stratum="limits")
    yield case(
        "fuzz",
        "strict",
        (*base, "--kernel", "double", "--strict", "--count", "12", "-j", "1", "--json", "-"),
        stratum="limits",
    )
    yield case(
        "fuzz",
        "tolerant",
        (
            *base,
            "--kernel",
            "double",
            "--tolerance",
            "0.01",
            "--width",
            "0.1",
            "--count",
            "12",
            "-j",
            "1",
            "--json",
            "-",
        ),
        stratum="limits",
    )
    yield case("fuzz", "times", (*base, "--count", "5", "-j", "1", "--json", "-", "--times"), stratum="limits")
    for scene in context.examples:
        for form in ("file", "area-file"):
            yield case(
                "fuzz",
                f"{form}/{Path(scene.path).stem}",
                (*base, "--generator", f"{form}:{scene.path}+any", "--count", "8", "-j", "1", "--json", "-"),
                stratum=form,
            )


def replay_cases(context: Context) -> Iterator[Case]:
    """Single scenes checked for every property, on many subjects."""
    for scene in context.scenes:
        run = ("replay", scene.path, *PATIENT)
        yield case("replay", scene.short, run, stratum=scene.kind)
        if scene.readable:
            subjects = ("--kernel", "double/svbsp/merged", "--kernel", "float+identity", "--kernel", "plane/receiver")
            yield case(
                "replay", f"{scene.short}/some", (*run, *subjects, "--relation-seed", "7"), stratum=f"{scene.kind}/some"
            )
    for generator in ("mix", "area-mix", "soup-lattice+duplicate"):
        for seed in (*range(1, 12), 16051188185124956539):
            yield case(
                "replay",
                f"{generator}/{seed}",
                ("replay", "--generator", generator, "--seed", str(seed), "-o", "case.json", *PATIENT),
                stratum=generator,
            )


def corpus_cases(context: Context) -> Iterator[Case]:
    """The matrix of all scenes and all subjects, and the scenes recorded anew."""
    run = ("certify", "--corpus", "tests/regressions", *PATIENT)
    yield case("corpus", "by-scene", (*run, "--by-scene", "--json", "matrix.json"), stratum="all")
    yield case("corpus", "by-kind", (*run, "-j", "1"), stratum="all")
    for kernel in (
        "plane",
        "double/svbsp/merged",
        "float+identity+thin",
        "epick",
        "rational/receiver",
        "plane/svbsp~slivers-dropped",
    ):
        yield case(
            "corpus", f"kernel/{kernel}", (*run, "--kernel", kernel, "--by-scene", "--json", "-"), stratum="kernel"
        )
    yield case("corpus", "in-process", (*run, "--in-process", "--by-scene"), stratum="in-process")
    yield case(
        "corpus",
        "tolerance",
        (*run, "--kernel", "double", "--kernel", "float", "--tolerance", "1e-15", "--by-scene"),
        stratum="kernel",
    )
    kinds = sorted({scene.path.split("/")[2] for scene in context.scenes if not scene.is_example})
    for kind in kinds:
        yield case(
            "corpus",
            f"record/{kind}",
            ("certify", "--corpus", f"corpus/{kind}", "--record"),
            stratum="record",
            copies=[(f"tests/regressions/{kind}", f"corpus/{kind}")],
        )
        for name, command in (
            ("float", "./gnomon shadows --kernel float --fragments"),
            ("shares", "./gnomon shadows --kernel double"),
            ("refusing", "false"),
        ):
            yield case(
                "corpus",
                f"foreign/{name}/{kind}",
                (
                    "certify",
                    "--corpus",
                    f"tests/regressions/{kind}",
                    "--candidate-command",
                    command,
                    "--by-scene",
                    *PATIENT,
                ),
                stratum=f"foreign/{name}",
            )


def zoo_cases(_: Context) -> Iterator[Case]:
    """Mistakes made on purpose: how many scenes it takes to find each, and what they do to a campaign."""
    yield case("zoo", "hunt-1", ("fuzz", "--zoo", "--count", "1"), stratum="hunt")
    yield case("zoo", "hunt-5", ("fuzz", "--zoo", "--count", "5"), stratum="hunt", big=True)
    for mutant, generator in MUTANTS:
        run = (
            "fuzz",
            *PATIENT,
            "--kernel",
            mutant,
            "--generator",
            generator,
            "--count",
            "60",
            "-j",
            "1",
            "--json",
            "-",
        )
        yield case("zoo", f"campaign/{mutant}/{generator}", run, stratum="campaign")
        kind = "area-zoo" if generator == "area-mix" else "zoo"
        yield case(
            "zoo",
            f"corpus/{mutant}/{generator}",
            ("certify", "--corpus", f"tests/regressions/{kind}", "--kernel", mutant, "--by-scene", *PATIENT),
            stratum="corpus",
        )


def shrink_cases(context: Context) -> Iterator[Case]:
    """Scenes made small, with what a rounded kernel gets wrong of them."""
    subjects = ("float", "double+thin", "double+identity", "epick", "float/svbsp/merged", "longdouble+thin")
    for number, scene in enumerate(context.scenes):
        subject = subjects[number % len(subjects)]
        run = ("shrink", scene.path, "--kernel", subject, *PATIENT)
        if not scene.readable:
            yield case("shrink", scene.short, run, stratum="rejected")
            continue
        yield case(
            "shrink",
            scene.short,
            (*run, "-o", "small.json", "--findings", "findings"),
            ("replay", "{first:findings/*}"),
            stratum=f"{subject}/{scene.kind}",
        )
        if scene.is_example:
            yield case(
                "shrink",
                f"{scene.short}/again",
                ("shrink", scene.path, *PATIENT),
                (
                    "shrink",
                    scene.path,
                    *PATIENT,
                    "--class",
                    "misclassified",
                    "--property",
                    "oracle",
                    "-o",
                    "small.json",
                ),
                (
                    "shrink",
                    scene.path,
                    *PATIENT,
                    "--class",
                    "misclassified",
                    "--property",
                    "oracle",
                    "-o",
                    "small.json",
                ),
                stratum=f"again/{scene.kind}",
            )
            yield case(
                "shrink",
                f"{scene.short}/strict",
                ("shrink", scene.path, *PATIENT, "--kernel", "float", "--strict", "--seed", "4"),
                stratum="strict",
            )
    yield case(
        "shrink",
        "foreign",
        (
            "shrink",
            "tests/regressions/coplanar/y_rug_on_floor.json",
            *PATIENT,
            "--candidate-command",
            "./gnomon shadows --kernel float",
            "--strict",
            "-o",
            "small.json",
            "--findings",
            "findings",
        ),
        stratum="foreign",
    )


def command_line_cases(context: Context) -> Iterator[Case]:
    """Help, the version, and everything that can be asked for wrongly."""
    group = "command-line"
    yield case(group, "help-all", ("--help-all",), stratum="help-all")
    yield case(group, "version", ("--version",), stratum="version")
    yield case(group, "help", ("--help",), stratum="help")
    for command in (*COMMANDS, "worker"):
        yield case(group, f"help/{command}", (command, "--help"), (command,), stratum="help")
    broken = TABLE[:100]
    beyond = TABLE.replace(b"[4,5,6,7]", b"[4,5,6,77]")
    unknown_key = TABLE.replace(b'"id": "floor",', b'"id": "floor", "colour": 1,')
    twice = TABLE.replace(b'"name": "table",', b'"name": "table", "name": "chair",')
    huge = TABLE.replace(b'"name": "table",', b'"numbers": "decimal",').replace(b"[4,4,0]", b"[4,4,1e5000]")
    no_lights = TABLE[: TABLE.index(b'"lights"')] + b'"lights": []}\n'
    bad_files = {
        "broken.json": broken,
        "empty.json": b"",
        "beyond.json": beyond,
        "unknown-key.json": unknown_key,
        "twice.json": twice,
        "huge.json": huge,
        "no-lights.json": no_lights,
        "version.json": TABLE.replace(b'"version": 1', b'"version": 2'),
        "format.json": TABLE.replace(b"gnomon-scene", b"gnomon-result"),
        "binary.json": bytes(range(256)),
        "array.json": b"[1, 2, 3]\n",
        "deep.json": b"[" * 100000,
        "bow-tie.json": TABLE.replace(b'"loop": [0,1,2,3]', b'"loop": [0,2,1,3]'),
        "empty.obj": b"",
        "broken.obj": b"v 1 2\nf 1 2 3\n",
        "broken.off": b"OFF\n3 1 0\n0 0 0\n",
        "broken.ply": b"ply\nformat ascii 1.0\nelement vertex 3\nend_header\n0 0 0\n",
        "nothing.xyz": TABLE,
        "table": TABLE,
    }
    for name, data in bad_files.items():
        for command in (
            ("info", name),
            ("shadows", name),
            ("certify", name),
            ("convert", name, "-"),
            ("shadows", name, "--sun=1,2,3"),
            ("replay", name),
            ("shrink", name, "--kernel", "float"),
            ("render", name),
        ):
            yield case(
                group,
                f"file/{name}/{command[0]}{'-sun' if len(command) == 3 and command[0] == 'shadows' else ''}",
                command,
                stratum=f"file/{command[0]}",
                files=[(name, data)],
            )
    missing = ("info", "shadows", "certify", "render", "shrink", "replay")
    for command in missing:
        yield case(
            group,
            f"missing-file/{command}",
            (command, "absent.json"),
            (command, "."),
            (command, "no/such/place.json"),
            stratum="missing",
        )
    wrong: list[tuple[str, ...]] = [
        (),
        ("nonsense",),
        ("--nonsense",),
        ("tradeoff",),
        *((command, "--nonsense") for command in COMMANDS),
        *((command, "table.json", "--kernel", "triple") for command in ("shadows", "certify", "shrink", "replay")),
        *((command, "table.json", "--algorithm", "magic") for command in ("shadows", "certify", "render")),
        *(
            (command, "table.json", "--jobs", jobs)
            for command in ("shadows", "certify", "render", "info", "fuzz")
            for jobs in ("-1", "1025", "two", "99999999999999999999")
        ),
        ("shadows", "table.json", "--jobs"),
        ("shadows", "table.json", "--algorithm", "both"),
        ("shadows", "table.json", "--algorithm", "pieces"),
        ("shadows", "table.json", "table.json"),
        ("shadows", "table.json", "--kernel", "double+thin+thin"),
        ("shadows", "table.json", "--kernel", "plane+thin"),
        ("shadows", "table.json", "--kernel", "plane~on-swapped"),
        ("shadows", "table.json", "--thickness", "nan"),
        ("shadows", "table.json", "--thickness=-1"),
        ("shadows", "table.json", "--light", "moon"),
        ("shadows", "table.json", "--point=1,2"),
        ("shadows", "table.json", "--point=1,2,x"),
        ("shadows", "table.json", "--sun=0,0,0"),
        ("shadows", "table.json", "--area=0,0,9:1,0,9"),
        ("shadows", "table.json", "--area=0,0,9:1,0,9:1,1,9:0,1,8"),
        ("shadows", "table.json", "--lights", "absent.json"),
        ("shadows", "table.json", "--lights", "table.json"),
        ("shadows", "table.json", "--numbers", "roman"),
        ("shadows", "table.json", "--lit-only", "--shadow-only"),
        ("shadows", "table.json", "--deep-umbra-tolerance", "0.1"),
        ("shadows", "table.json", "--deep-umbra"),
        ("shadows", "table.json", "--deep-umbra", "--pieces"),
        ("shadows", "table.json", "--deep-umbra", "--kernel", "double"),
        ("shadows", "table.json", "--mesh", "mesh.ply"),
        ("shadows", "table.json", "--grid", "1"),
        ("shadows", "table.json", "--illuminate"),
        ("shadows", "table.json", "--illuminate", "--mesh", "mesh.obj"),
        ("shadows", "table.json", "--illuminate", "--mesh", "no/such/mesh.ply"),
        ("shadows", "table.json", "--illuminate", "--mesh", "mesh.ply", "--pieces"),
        ("shadows", "table.json", "--illuminate", "--mesh", "mesh.ply", "--kernel", "double"),
        ("shadows", "table.json", "--illuminate", "--mesh", "mesh.ply", "--grid", "x"),
        ("shadows", "table.json", "--illuminate", "--mesh", "mesh.ply", "--grid", "1,"),
        ("shadows", "table.json", "--illuminate", "--mesh", "mesh.ply", "--grid", "0.0005"),
        ("shadows", "table.json", "--illuminate", "--mesh", "mesh.ply", "--adaptive=-1"),
        ("shadows", "table.json", "-o", "no/such/place.json"),
        ("shadows", "table.json", "-o", "/dev/full"),
        *(
            ("shadows", "table.json", "--kernel", kernel, option)
            for kernel in ROUNDED_KERNELS
            for option in ("--exact-fractions", "--exact-loops")
        ),
        *(
            ("shadows", "table.json", "--algorithm", "sectors", option)
            for option in ("--combined", "--no-merge", "--no-prefix")
        ),
        *(
            ("shadows", "table.json", "--algorithm", "receiver", option)
            for option in ("--no-merge", "--no-prefix", "--pieces")
        ),
        ("certify",),
        ("certify", "table.json", "--algorithm", "sectors", "--explain"),
        ("certify", "table.json", "--candidate", "absent.json"),
        ("certify", "table.json", "--candidate", "table.json"),
        ("certify", "table.json", "--tolerance", "much"),
        ("certify", "table.json", "--json", "/dev/full"),
        ("certify", "table.json", "--report", "/dev/full"),
        ("certify", "table.json", "--candidate-command", "true"),
        ("certify", "table.json", "--by-scene"),
        ("certify", "--corpus", "absent"),
        ("certify", "--corpus", "tests/regressions/coplanar", "--strict"),
        ("certify", "--corpus", "tests/regressions/coplanar", "--kernel", "quadruple"),
        ("certify", "--corpus", "tests/regressions/coplanar", "--kernel", "plane/magic"),
        ("certify", "--corpus", "tests/regressions/coplanar", "--kernel", "plane~twist"),
        ("certify", "--corpus", "tests/regressions/coplanar", "--kernel", "plane/sectors~slivers-dropped"),
        ("verify", "table.json"),
        ("verify", "table.json", "absent.json"),
        ("verify", "table.json", "table.json"),
        ("render", "table.json", "--eye", "1,2"),
        ("render", "table.json", "--fov", "180"),
        ("render", "table.json", "--width", "8"),
        ("render", "table.json", "--illuminate", "--algorithm", "both"),
        ("render", "table.json", "--eye=1,1,5", "--look-at=1,1,5"),
        ("render", "table.json", "--light", "moon"),
        ("generate", "nothing-of-the-kind"),
        ("generate", "room", "--param", "size"),
        ("generate", "room", "--param", "area=3"),
        ("generate", "room", "--param", "area=1", "--param", "area=1"),
        ("generate", "room", "--param", "colour=1"),
        ("generate", "room", "-o", "room.xyz"),
        ("generate", "room", "-o", "no/such/room.json"),
        ("generate", "mix+twist"),
        ("generate", "mix", "--param", "n=4"),
        ("generate", "mix", "--seed", "-1"),
        ("convert", "table.json"),
        ("convert", "table.json", "table.xyz"),
        ("convert", "table.json", "-", "--format", "stl"),
        ("shrink", "table.json", "--property", "beauty"),
        ("shrink", "table.json", "--time", "soon"),
        ("shrink", "table.json", "--kernel", "plane"),
        ("fuzz", "--generator", "twist"),
        ("fuzz", "--generator", "file:absent.json"),
        ("fuzz", "--kernel", "plane~twist"),
        ("fuzz", "--kernel", "plane/sectors~slivers-dropped"),
        ("fuzz", "--shard", "4/4", "--count", "1"),
        ("fuzz", "--merge", "absent.db"),
        ("fuzz", "--merge", "absent.db", "--db", "all.db"),
        ("fuzz", "--db", "table.json", "--count", "1"),
        ("fuzz", "--property", "beauty"),
        ("fuzz", "--seconds", "0"),
        ("replay",),
        ("replay", "--seed", "3"),
        ("replay", "--generator", "mix"),
        ("replay", "table.json", "--generator", "mix", "--seed", "3"),
        ("replay", "table.json", "--kernel", "plane"),
    ]
    for number, arguments in enumerate(wrong):
        words = "_".join(word.replace("/", ":") for word in arguments) or "nothing"
        yield case(group, f"usage/{words}", arguments, stratum=f"usage/{number % 40}", files=[("table.json", TABLE)])
    files = [("table.json", TABLE)]
    for command in (
        ("shadows", "table.json", "--fragments"),
        ("info", "table.json"),
        ("certify", "table.json", "--kernel", "plane"),
        ("generate", "room"),
        ("render", "table.json"),
        ("--help-all",),
    ):
        name = command[0].lstrip("-")
        yield case(group, f"full-disk/{name}", Step(command, stdout="full"), stratum="full-disk", files=files)
        yield case(group, f"closed-pipe/{name}", Step(command, stdout="closed"), stratum="closed-pipe", files=files)


@dataclass(frozen=True)
class Group:
    """Cases of one subject; `quick`: how many a stratum `--quick` takes."""

    make: Callable[[Context], Iterator[Case]]
    quick: int


GROUPS = {
    "shadows": Group(shadows_cases, 8),
    "policies": Group(policies_cases, 3),
    "options": Group(options_cases, 2),
    "certify": Group(certify_cases, 4),
    "verify": Group(verify_cases, 5),
    "render": Group(render_cases, 4),
    "scenes": Group(scenes_cases, 6),
    "generate": Group(generate_cases, 1),
    "fuzz": Group(fuzz_cases, 1),
    "replay": Group(replay_cases, 6),
    "corpus": Group(corpus_cases, 1),
    "zoo": Group(zoo_cases, 3),
    "shrink": Group(shrink_cases, 2),
    "command-line": Group(command_line_cases, 4),
}
