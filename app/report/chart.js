// SPDX-License-Identifier: GPL-3.0-or-later
"use strict";
// A chart of several runs: colour tells the run and the line's dashes tell the point or quantity; with one run
// both tell the point. The legend is a small table, runs down and points across, that shows the values at the
// cursor and hides or shows a run, a point, or one line.
const Chart = (() => {
  const dashes = [[], [7, 4], [2, 3], [10, 3, 2, 3], [14, 5], [4, 2, 1, 2, 1, 2]];
  const colours = 12;
  const fewest = 9;  // a line of fewer values is drawn with a point for each
  let theme = new Map();

  const colour = name => {
    if (!theme.has(name)) theme.set(name, getComputedStyle(document.documentElement).getPropertyValue(name).trim());
    return theme.get(name);
  };
  const element = (name, attributes = {}, ...children) => {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
  };
  const format = (value, digits) => {
    if (value === null || value === undefined) return "";
    const text = value !== 0 && Math.abs(value) < 10 ** (1 - digits) ? value.toPrecision(3) : value.toFixed(digits);
    return text.replace("-", "\u2212");
  };
  // All ticks of an axis with the decimals that their distance needs.
  const axisValues = (chart, splits, axis, space, step) => {
    const decimals = Math.max(0, Math.min(9, ...[0, 1, 2, 3, 4, 5, 6, 7, 8].filter(count =>
      Math.abs(step * 10 ** count - Math.round(step * 10 ** count)) < 1e-6)));
    return splits.map(value => value === null ? "" : value.toFixed(decimals).replace(/^-(?=.*[1-9])/, "\u2212").replace(/^-/, ""));
  };

  // The picture of a line, or of a bar, for the legend.
  function sample(line, isBar) {
    const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    for (const [key, value] of Object.entries({width: 26, height: 10, "aria-hidden": "true"})) svg.setAttribute(key, value);
    const stroke = document.createElementNS("http://www.w3.org/2000/svg", "line");
    const shape = {x1: 1, x2: 25, y1: 5, y2: 5, "stroke-width": isBar ? 8 : line.width + .4,
                   "stroke-dasharray": isBar ? "" : line.dash.join(" ")};
    for (const [key, value] of Object.entries(shape)) stroke.setAttribute(key, value);
    stroke.style.stroke = `var(${line.colour})`;
    svg.append(stroke);
    return svg;
  }

  // Puts lines over one x: the same array when all agree, otherwise all x of all lines with holes that
  // are bridged (undefined), unlike missing values (null).
  function align(lines) {
    const same = (a, b) => a === b || (a.length === b.length && a.every((value, index) => value === b[index]));
    if (lines.every(line => same(line.x, lines[0].x))) return [lines[0].x, ...lines.map(line => line.y)];
    return uPlot.join(lines.map(line => [line.x, line.y]));
  }

  class Figure {
    // spec: {id, title, unit, figure, digits, xLabel, sync, lines, caption, height, range, xRange, axis, xAxis, draw, valueAt, dots}
    // lines: [{run, runLabel, part, partLabel, x, y}], run and part count the colours and dashes.
    constructor(parent, spec) {
      this.spec = spec;
      const severalRuns = new Set(spec.lines.map(line => line.run)).size > 1;
      const severalParts = new Set(spec.lines.map(line => line.part)).size > 1;
      for (const line of spec.lines) {
        line.colour = `--c${(severalRuns ? line.run : severalParts ? line.part : line.run) % colours}`;
        line.dash = severalParts ? dashes[line.part % dashes.length] : [];
        line.width = 1.8;
        line.shown = true;
      }
      this.box = element("div", {class: "plot"});
      const heading = element("h3", {}, spec.title);
      if (spec.unit) heading.append(element("span", {class: "unit"}, `, ${spec.unit}`));
      if (spec.figure) heading.prepend(element("span", {class: "figure"}, spec.figure));
      this.root = element("figure", {id: `chart-${spec.id}`}, heading, this.box);
      this.root.append(this.legend());
      if (spec.caption) this.root.append(element("figcaption", {}, spec.caption));
      parent.append(this.root);
      this.drawn = new Promise(resolve => this.build(resolve));
    }

    build(ready) {
      const spec = this.spec;
      const axis = {
        stroke: () => colour("--faint"), font: "12px system-ui, sans-serif", labelFont: "12px system-ui, sans-serif",
        grid: {stroke: () => colour("--grid"), width: 1}, ticks: {stroke: () => colour("--line"), width: 1, size: 5},
        values: axisValues,
      };
      this.plot = new uPlot({
        width: Math.max(200, this.box.clientWidth), height: spec.height || 250, padding: [10, 12, 0, 0],
        legend: {show: false},
        cursor: {sync: {key: spec.sync}, points: {size: 6}, y: false, drag: {x: true, y: false}},
        scales: {x: {time: false, ...(spec.xRange ? {range: spec.xRange} : {})}, y: spec.range ? {range: spec.range} : {}},
        axes: [{...axis, label: spec.xLabel(), labelSize: 22, size: 34, space: 55, ...spec.xAxis},
               {...axis, size: 54, space: 34, ...spec.axis}],
        series: [{}, ...spec.lines.map(line => ({
          stroke: () => colour(line.colour), width: line.width, dash: line.dash, pxAlign: 0,
          points: {show: spec.dots || line.y.length < fewest, size: 9, stroke: () => colour(line.colour), fill: () => colour(line.colour)},
          ...(spec.draw ? {paths: () => null} : {}),
        }))],
        hooks: {setCursor: [() => this.showValues()], ready: [ready], ...(spec.draw ? {draw: [() => spec.draw(this)]} : {})},
      }, align(spec.lines), this.box);
      this.describe();
    }

    describe() {
      const canvas = this.box.querySelector("canvas");
      const digits = this.spec.digits;
      const parts = this.spec.lines.map(line => {
        const values = line.y.filter(value => value !== null && value !== undefined);
        let lowest = Infinity, highest = -Infinity;
        for (const value of values) { lowest = Math.min(lowest, value); highest = Math.max(highest, value); }
        return `${[line.runLabel, line.partLabel].filter(Boolean).join(" ")}: ${format(lowest, digits)} to ${format(highest, digits)}`;
      });
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label",
        `${this.spec.title}${this.spec.unit ? " in " + this.spec.unit : ""} against ${this.spec.xLabel()}. ${parts.join("; ")}`);
    }

    legend() {
      const lines = this.spec.lines;
      const runs = [...new Map(lines.map(line => [line.run, line.runLabel]))];
      const parts = [...new Map(lines.map(line => [line.part, line.partLabel]))].sort((a, b) => a[0] - b[0]);
      this.buttons = [];
      const button = (owned, ...content) => {
        const made = element("button", {type: "button", "aria-pressed": "true"}, ...content);
        made.addEventListener("click", () => this.toggle(owned));
        this.buttons.push({made, owned});
        return made;
      };
      const cell = (line, name) => {
        line.output = element("output", {"aria-live": "off"});
        const part = element("span", {class: "part"}, line.partLabel);
        const made = button([line], sample(line, this.spec.draw), name || part, line.output);
        if (!name) made.setAttribute("aria-label", `${line.runLabel} ${line.partLabel}`);
        return element("td", {}, made);
      };
      const body = element("tbody");
      const table = element("table", {"aria-label": `Lines of the chart ${this.spec.title}`}, body);
      const isList = runs.length === 1 || parts.length === 1;
      if (isList) {
        for (const line of lines) body.append(element("tr", {}, cell(line, parts.length === 1 ? line.runLabel : line.partLabel)));
      } else {
        const head = element("tr", {}, element("td"));
        for (const [part, label] of parts)
          head.append(element("th", {scope: "col"}, button(lines.filter(line => line.part === part), label)));
        table.prepend(element("thead", {}, head));
        for (const [run, label] of runs) {
          const row = element("tr", {}, element("th", {scope: "row"}, button(lines.filter(line => line.run === run), label)));
          for (const [part] of parts) {
            const line = lines.find(one => one.run === run && one.part === part);
            row.append(line ? cell(line) : element("td"));
          }
          body.append(row);
        }
      }
      return element("div", {class: isList ? "legend list" : "legend"}, table);
    }

    toggle(owned, shown = !owned.some(line => line.shown)) {
      for (const line of owned) {
        line.shown = shown;
        this.plot.setSeries(this.spec.lines.indexOf(line) + 1, {show: shown});
      }
      for (const {made, owned: lines} of this.buttons) made.setAttribute("aria-pressed", String(lines.some(line => line.shown)));
    }

    showValues() {
      const index = this.plot.cursor.idx;
      const outside = index === null || index === undefined || this.plot.cursor.left < 0;
      this.spec.lines.forEach((line, at) => {
        const value = outside ? null : this.spec.valueAt ? this.spec.valueAt(line, this.plot.data[0][index])
                                                         : this.plot.data[at + 1][index];
        line.output.textContent = typeof value === "string" ? value : format(value, this.spec.digits);
      });
    }

    toggleRun(run, shown) { this.toggle(this.spec.lines.filter(line => line.run === run), shown); }

    // New x and y of the same lines, as when another span of time is chosen.
    update() {
      this.plot.axes[0].label = this.spec.xLabel();
      this.plot.setData(align(this.spec.lines), true);
      this.describe();
    }
    resetZoom() { this.plot.setData(this.plot.data, true); }
    resize(width = this.box.clientWidth) {
      if (width > 0 && width !== this.plot.width) this.plot.setSize({width, height: this.plot.height});
    }
    repaint() { this.plot.redraw(false, true); }
  }

  return {Figure, element, colour, colours, format, forgetColours: () => { theme = new Map(); }};
})();
