# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: fields.py TUNICA SCENES FOLDER

Runs scenes and reads fields/wall.xdmf as a viewer of XDMF would: well-formed XML, a temporal collection whose
grids have a mesh (in place or included from the first grid) and data of the announced sizes, times from 0 to
the end, and at P1 and P4 the numbers of observables.csv."""

import csv
import math
import pathlib
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

INCLUDE = "{http://www.w3.org/2001/XInclude}include"
PEAK_FLOW = 0.2112  # s in the beat, of the paper's figures
MESH = "xpointer(/Xdmf/Domain/Grid/Grid[1]/*[self::Topology or self::Geometry or @Center='Cell'])"


def check(holds, what):
    if not holds:
        sys.exit(f"fields.py: {what}")


def numbers(element):
    item = element.find("DataItem")
    # As meshio asks for: whatever else an Attribute holds makes it refuse the file.
    check(list(element) == [item], f"{element.attrib} holds more than its numbers")
    check(item.get("Format") == "XML", "data outside of the file")
    values = [float(text) for text in item.text.split()]
    check(len(values) == math.prod(map(int, item.get("Dimensions").split())), f"size of {element.attrib}")
    return values


def read(file):
    """Points, cells, and for each time a dictionary of point fields."""
    root = ElementTree.parse(file).getroot()
    check(root.tag == "Xdmf" and root.get("Version").startswith("3"), "not XDMF 3")
    series = root.findall("Domain/Grid")
    check(len(series) == 1 and series[0].get("CollectionType") == "Temporal", "not one temporal collection")
    grids = series[0].findall("Grid")
    check(list(series[0]) == grids, "the collection holds more than its grids")
    points = numbers(grids[0].find("Geometry"))
    cells = numbers(grids[0].find("Topology"))
    count = int(grids[0].find("Topology").get("NumberOfElements"))
    check(len(cells) == 4 * count, "cells are no quadrilaterals")
    check(set(cells) == set(range(len(points) // 3)), "points without cells, or corners without points")
    layer = grids[0].find("Attribute[@Name='layer']")
    check(layer.get("Center") == "Cell" and len(numbers(layer)) == count, "no layer for each cell")
    units = {i.get("Name"): i.get("Value") for i in root.findall("Domain/Information")}
    check(units["unit of displacement"] == "cm" and units["unit of von_mises"] == "dyn/cm2", f"units {units}")
    frames = []
    for grid in grids:
        check(grid.get("GridType") == "Uniform", "not a uniform grid")
        if grid is not grids[0]:
            included = [include.get("xpointer") for include in grid.findall(INCLUDE)]
            check(included == [MESH], f"mesh included from {included}")
        fields = {a.get("Name"): numbers(a) for a in grid.findall("Attribute[@Center='Node']")}
        check(len(fields["displacement"]) == len(points), "a displacement for each point")
        check(all(len(fields[name]) * 3 == len(points) for name in fields if name != "displacement"),
              "a number for each point")
        frames.append((float(grid.find("Time").get("Value")), fields))
    return points, frames


def compare(folder, has_fibers):
    points, frames = read(folder / "fields" / "wall.xdmf")
    check((folder / "fields" / "wall.xdmf").stat().st_size < 1.5e6, "the file is larger than 1.5 MB")
    times = [time for time, _ in frames]
    check(times[0] == 0, "t = 0 is missing")
    expected = sorted([0.05 * k for k in range(33)] + [0.8 + PEAK_FLOW])
    check(len(times) == 34 and all(abs(t - e) < 1e-9 for t, e in zip(times, expected)), f"times {times}")
    with open(folder / "observables.csv", encoding="ascii") as file:
        rows = {round(float(row["time[s]"]), 6): row for row in csv.DictReader(file)}
    inner, outer = 0, len(points) // 3 - 1
    for time, fields in frames:
        check(("recruitment" in fields) == has_fibers, "recruitment is there if and only if there are fibres")
        # Peak flow lies between two rows.
        if abs(time - 0.8 - PEAK_FLOW) < 1e-9:
            continue
        row = rows[round(time, 6)]
        for name, point in (("P1", inner), ("P4", outer)):
            x, y = points[3 * point], points[3 * point + 1]
            u = fields["displacement"][3 * point:3 * point + 3]
            outwards = (u[0] * x + u[1] * y) / math.hypot(x, y)
            expected = float(row[f"radial_displacement.{name}[cm]"])
            check(abs(outwards - expected) < 1e-6 * abs(expected) + 1e-10, f"{name} displaced at {time} s")
            for quantity in ("von_mises", "fiber_stretch", "recruitment"):
                unit = "dyn/cm2" if quantity == "von_mises" else "1"
                cell = row[f"{quantity}.{name}[{unit}]"]
                if quantity in fields and cell:
                    value = fields[quantity][point]
                    # In the front of recruitment H follows the stretch with a slope of up to 1e5.
                    allowed = 0.01 if quantity == "recruitment" else 1e-5 * abs(float(cell)) + 1e-2
                    check(abs(value - float(cell)) < allowed, f"{quantity}.{name} = {value} at {time} s, not {cell}")
                elif quantity in fields:
                    check(math.isnan(fields[quantity][point]), f"{quantity}.{name} is a number at {time} s")


def main():
    program, scenes, folder = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    for scene, has_fibers in (("cylinder", True), ("cylinder_exp1", False), ("layered", True)):
        run = [program, "run", scenes / f"{scene}.toml", "--quiet", "--no-report", "--out", folder / scene]
        subprocess.run(run, check=True)
        compare(folder / scene, has_fibers)
        subprocess.run(run + ["--set", "output.field_interval=0"], check=True)
        check(not (folder / scene / "fields").exists(), "fields of an earlier run are left")


main()
