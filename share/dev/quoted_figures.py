#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""quoted_figures.py SOURCE_DIR [--write]: the figures of share/doc/accuracy.md are those of the
pages of tests/benchmarks.

Each quotation below has a text of the page, with # for every figure, and the figures as they stand
in the tables and sentences of a benchmark page. The exit status is 1, and every difference is
printed, where a figure differs, where a number of the page is neither quoted nor listed as a plain
one, and where the text of either page is not there any more. With --write the page gets the
figures."""

import pathlib
import re
import sys

PAGE = "share/doc/accuracy.md"
BENCHMARKS = "tests/benchmarks"
NUMBER = r"[-+]?\d+(?:\.\d+)?"


class Mismatch(Exception):
    """A page does not have what is expected of it."""


def spaced(text):
    """A pattern of the text in which blanks and line ends are alike."""
    return r"\s+".join(re.escape(word) for word in text.split())


def pattern_of(text):
    """A pattern of a text with a group for every #."""
    return re.compile(spaced(text).replace(re.escape("#"), f"({NUMBER})"))


class Benchmark:
    """A benchmark page, or the part of it that begins with a text."""

    def __init__(self, root, name, start=None):
        self.name = name
        self.text = (root / BENCHMARKS / name).read_text(encoding="utf-8")
        if start is not None:
            found = re.search(spaced(start), self.text)
            if not found:
                raise Mismatch(f"{BENCHMARKS}/{name}: has no text '{start}'")
            self.text = self.text[found.start():]

    def sentence(self, text):
        """The numbers at the places of # in the first such sentence."""
        found = pattern_of(text).search(self.text)
        if not found:
            raise Mismatch(f"{BENCHMARKS}/{self.name}: has no sentence '{text}'")
        return list(found.groups())

    def table(self):
        """The cells of the first table, without its head."""
        lines = self.text.splitlines()
        first = next(i for i, line in enumerate(lines) if line.startswith("|---"))
        rows = []
        for line in lines[first + 1:]:
            if not line.startswith("|"):
                break
            rows.append([cell.strip().strip("*") for cell in line.strip().strip("|").split("|")])
        return rows

    def row(self, *head):
        """The first numbers of the cells behind those that a row begins with."""
        for cells in self.table():
            if cells[:len(head)] == list(head):
                return [numbers(cell)[0] for cell in cells[len(head):] if numbers(cell)]
        raise Mismatch(f"{BENCHMARKS}/{self.name}: no row begins with {' | '.join(head)}")

    def column(self, index, chosen=lambda cells: True):
        """All numbers of a column, of chosen rows."""
        return [n for cells in self.table() if chosen(cells) for n in numbers(cells[index])]


def numbers(text):
    return re.findall(NUMBER, text)


def least(values):
    return min(values, key=float)


def most(values):
    return max(values, key=float)


def extent(values):
    return [least(values), most(values)]


def percent(values):
    return [f"{100.0 * float(value):.0f}" for value in values]


def metres(millimetres):
    return [f"{float(value) / 1000.0:.1f}" for value in millimetres]


def differences(estimated, true):
    """Absolute differences with the decimals of the estimates."""
    result = []
    for value, target in zip(estimated, true):
        decimals = len(value.partition(".")[2])
        result.append(f"{abs(float(value) - float(target)):.{decimals}f}")
    return result


def quotations_of_parameters(page):
    """Texts of the page with # for figures, and the figures."""
    coverage = page("calibration_uncertainty.md", "## Coverage: 100 small blocks")
    seven = "| #, # | #, #, # | # | # |"
    yield ("| the paper's block, 2 cm range noise, 10 seeds, RMS error " + seven,
           page("calibration.md", "## Accuracy over ten seeds").row("RMS error"))
    yield "100 seeds, RMS error " + seven, coverage.row("RMS error")
    helios = page("calibration.md", "HELIOS++ block, the commands above")
    yield ("| HELIOS++, error of one block " + seven,
           differences(helios.row("rigorous"), helios.row("true")))
    roll, pitch, heading = helios.sentence(
        'recovered within #" (roll), #" (pitch), #" (heading)')
    yield "applied biases recovered to | | #, #, # |", [pitch, roll, heading]
    bound = page("calibration_uncertainty.md", "## Bound of the standard deviations")
    yield "too large (error / std # to #)", extent(bound.row("RMS of error / std"))
    for share in ("68", "95"):
        name = f"in the {share} % interval"
        yield name + " in # to # %", percent(extent(coverage.row(name)))
    process = page("calibration_uncertainty.md", "## Coverage by process")
    others = []
    for name in ("band_limited", "drift", "random_walk", "jumps"):
        others += process.row(name)
    yield "RMS values of error / std from # to #;", extent(others)
    yield "white errors is overestimated (# to #)", extent(process.row("white"))
    attitude = page("calibration_uncertainty.md", "## Effect of the attitude model")
    yield ("method as published leaves # to # mm",
           attitude.sentence("and leaves # to # mm in plan"))


def quotations_of_points(page):
    """The same, for the standard deviations of points."""
    tables = [page("point_uncertainty.md", start)
              for start in ("Without strip corrections:", "With strip corrections:")]
    for text, column in (("points of twelve blocks: # to # horizontally", 5),
                         ("horizontally, # to # vertically", 8)):
        yield text, extent([n for table in tables for n in table.column(column)])
    other = page("point_uncertainty.md", "Other blocks, root mean square").table()
    drone = next(cells for cells in other if cells[0].startswith("`uav`"))
    yield ("MEMS trajectory have # to # horizontally without and # to # with strip corrections",
           numbers(drone[1])[:2] + numbers(drone[2])[:2])
    single = ("Single blocks lie between # and # horizontally without and between # and # with "
              "strip ")
    every = page("point_uncertainty.md")
    yield "a single block can have # to #", extent(every.sentence(single + "corrections, because"))
    yield "(single ones # to #)", extent(every.sentence(single + "corrections. What"))


def quotations_of_strips(page):
    """The same, for corrected strips and the delivery check."""
    quality = page("quality.md", "## The paper's block (Table 3)")
    rms = {state: extent(quality.column(8, lambda cells, state=state: cells[1] == state))
           for state in ("before", "after")}
    yield "RMSDz of four pairs | # to # m | # to # m,", rms["before"] + rms["after"]
    yield ("| its control, RMSE | # m | # m |",
           quality.sentence("Control: RMSE # m before, # m after"))
    images = page("paper_experiments.md", "## Check points of an image block").row("RMSE plan")
    yield ("check points of an image block, plan | # m | # to # m |",
           images[:1] + extent(images[1:5]))
    yield "within # mm (Delft)", page("quality.md").sentence("the means within #: the offset")
    yield ("and # mm (British Columbia)",
           page("real_blocks.md").sentence("agree with the independent offsets within # mm"))
    halves = page("real_blocks.md", "## Halves of overlaps").table()
    yield ("differ by # to # of their combined",
           extent([numbers(cell)[0] for cells in halves for cell in cells[1:]]))
    peers = page("alignment_peers.md", "## HELIOS, strips at their true positions").table()
    yield ("positions ICPatch finds # mm and other programs # and # mm",
           [cells[6] for cells in peers[:3]])


def quotations_of_sources(page):
    """The same, for further error sources and trajectories from points."""
    found = page("practice.md")
    yield "# situations of practice", found.sentence("All # situations hold")
    yield ("finds the misfit that the first one states within # %",
           found.sentence("both agree within # %"))

    found = page("diagnosis.md", "## How often errors are found")
    yield "In # simulated blocks", found.sentence("occurs in one of the # blocks")
    yield ("a probability above 0.9 in # of # blocks",
           found.sentence("have a probability above 0.9 in # of the # blocks that have any"))
    kept = [numbers(cells[-1]) for cells in found.table()]
    yield ("95 % intervals in # to # % of the blocks, by source",
           percent(extent([str(int(part) / int(whole)) for part, whole in kept])))
    paths = page("trajectory_reconstruction.md", "All times of the strips")
    def aircraft(cells):
        return not re.search("exact|drone|bare", cells[0])
    yield "Positions to # to # mm RMS", extent(paths.column(2, aircraft))
    yield "that hold (error / std # to #)", extent(paths.column(4, aircraft))
    bare = next(cells for cells in paths.table() if cells[0].startswith("bare"))
    yield "; # and # m in plan over bare ground", metres(numbers(bare[2])[:2])
    drones = [numbers(cells[2]) for cells in paths.table() if "drone" in cells[0]]
    yield "drones to # and # mm along", sorted((errors[0] for errors in drones), key=float)
    yield ("course, # to # mm in the other",
           extent([error for errors in drones for error in errors[1:]]))
    seeds = page("trajectory_reconstruction.md", "Simulated blocks, 20 seeds at half density")
    yield "95 % intervals in # of # blocks, without lever arm", numbers(seeds.table()[0][1])


def quotations_of_intensity(page):
    """The same, for intensity, land cover and time."""
    yield "met within # %", page("intensity.md").sentence("All means are within **# %**")
    delft = page("intensity.md", "## Delft, three strips").table()
    yield ("falls from # to # by the radar equation and to # with gains",
           [cells[1] for cells in delft])
    yield ("roofs of more than # degrees",
           page("intensity.md").sentence("roofs over # degrees get worse"))
    cover = page("land_cover.md", "Bands height and intensity, about those of the paper:")
    yield ("from # to # % to # to # % with height and intensity alone",
           extent(cover.column(1)) + extent(cover.column(2)))
    bands = page("land_cover.md", "## Delft (AHN3), against the classes").table()
    yield "on Delft # % of the check", [bands[1][3]]
    block = page("calibration.md", "## One block")
    yield ("of # million points takes # s on two cores",
           block.sentence("HELIOS++ block: # million points") + [block.row("`-model rigorous`")[0]])
    check = page("quality.md")
    points = "".join(re.search(r"# (\d+ \d+ \d+) points", check.text).group(1).split())
    yield "of # million # s;", [f"{int(points) / 1e6:.1f}", check.row("all")[0]]


def quotations_of_waveforms(page):
    """The same, for waveforms."""
    forest = next(cells for cells in page("waveform.md").table() if cells[0] == "as above")
    yield "decomposition finds # % more echoes", numbers(forest[3])[:1]
    yield "same waveforms, # % of them false", numbers(forest[4])[:1]
    yield "ground under # instead of # %", [numbers(forest[7])[0], numbers(forest[6])[0]]
    yield ("on slopes of # degrees, # to # mm by the size",
           page("waveform.md").sentence("systematic error** on slopes of #°, # to # mm by"))


def quotations(root):
    """All of them."""
    def page(name, start=None):
        return Benchmark(root, name, start)
    for part in (quotations_of_parameters, quotations_of_points, quotations_of_strips,
                 quotations_of_sources, quotations_of_intensity, quotations_of_waveforms):
        yield from part(page)


# Numbers of the page that are no results: what a block, an interval or a limit is called.
PLAIN = [
    "2 cm range noise, 10 seeds", 'trajectory errors of 1.5 cm, 8", 16", 100 seeds',
    "scale, 10⁻⁶",
    "Delft (real, 450 m", "100 simulated blocks with trajectory errors", "in the 68 % interval",
    "in the 95 % interval", "1 m cells", "a probability above 0.9", "probability above 0.5",
    "their 95 % intervals", "crab of 5 degrees and roll of 3 degrees", "exit status 3",
]


def without_links(text):
    """The page with the targets of its links as blanks."""
    return re.sub(r"\]\([^)]*\)", lambda m: " " * len(m.group()), text)


def place(text, position):
    return f"{PAGE}:{text.count(chr(10), 0, position) + 1}"


def unquoted(text, spans):
    """The numbers of the page outside of the spans, with their lines."""
    return [f"{place(text, number.start())}: {number.group()} is no quotation of a benchmark page"
            for number in re.finditer(NUMBER, without_links(text))
            if not any(start <= number.start() and number.end() <= end for start, end in spans)]


def main():
    root = pathlib.Path(sys.argv[1])
    path = root / PAGE
    text = path.read_text(encoding="utf-8")
    faults = []
    edits = []
    for quotation, figures in quotations(root):
        places = list(pattern_of(quotation).finditer(text))
        if len(places) != 1 or len(places[0].groups()) != len(figures):
            faults.append(f"{PAGE}: has {len(places)} texts '{quotation}' for {', '.join(figures)}")
            continue
        found = places[0]
        for group, figure in enumerate(figures, 1):
            start, end = found.span(group)
            edits.append((start, end, figure))
            if text[start:end] != figure:
                faults.append(f"{place(text, start)}: {text[start:end]} is {figure} in the "
                              f"benchmark page: {quotation}")
    spans = [(start, end) for start, end, _ in edits]
    for plain in PLAIN:
        places = [m.span() for m in re.finditer(spaced(plain), text)]
        if not places:
            faults.append(f"{PAGE}: has no text '{plain}'")
        spans += places
    faults += unquoted(text, spans)
    if "--write" in sys.argv[2:]:
        for start, end, figure in sorted(edits, reverse=True):
            text = text[:start] + figure + text[end:]
        path.write_text(text, encoding="utf-8")
    for fault in faults:
        print(fault)
    if not faults:
        print(f"{len(edits)} figures of {PAGE} are those of the benchmark pages.")
    return 1 if faults else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Mismatch as error:
        sys.exit(str(error))
