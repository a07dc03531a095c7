// SPDX-License-Identifier: GPL-3.0-or-later
"use strict";
// Pictures of a sweep as SVG: they take the page's colours by themselves, print sharply and are read aloud.
const Plots = (() => {
  const svgElement = (name, attributes = {}, ...children) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
  };
  const picture = (width, height, label) =>
    svgElement("svg", {class: "sweep-plot", viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": label});

  const raised = number => String(number).replace(/[-\d]/g, digit => digit === "-" ? "\u207b" : "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[digit]);
  const short = (value, digits = 4) => {
    if (value === null || value === undefined) return "\u2013";
    if (value === 0) return "0";
    const power = Math.floor(Math.log10(Math.abs(value)) + 1e-12);
    const plain = number => String(Number(number.toPrecision(digits))).replace("-", "\u2212");
    return power >= 5 || power < -3 ? `${plain(value / 10 ** power)}\u00b710${raised(power)}` : plain(value);
  };
  const titled = ({name, unit}) => unit ? `${name}, ${unit}` : name;

  // A map of values to pixels with its ticks; of a key that holds texts each text is a tick.
  function scale(lowest, highest, from, to, {log = false, texts = null} = {}) {
    if (texts) { lowest -= .5; highest += .5; }
    if (!(highest > lowest)) {
      const margin = Math.abs(lowest) * .05 || 1;
      log = false;
      lowest -= margin;
      highest += margin;
    }
    const share = log ? value => Math.log(value / lowest) / Math.log(highest / lowest) : value => (value - lowest) / (highest - lowest);
    const place = value => from + share(value) * (to - from);
    const value = pixel => {
      const part = (pixel - from) / (to - from);
      return log ? lowest * (highest / lowest) ** part : lowest + part * (highest - lowest);
    };
    return {place, value, lowest, highest, ticks: texts ? texts.map((text, at) => [at, text]) : ticks(lowest, highest, log, Math.abs(to - from))};
  }
  function ticks(lowest, highest, log, pixels) {
    const most = Math.max(2, Math.floor(pixels / 60)), found = [];
    if (log) {
      // The sparsest of these sets that has enough ticks, as a decade may hold the whole range.
      const powers = [];
      for (let power = Math.floor(Math.log10(lowest)); power <= Math.log10(highest); ++power) powers.push(power);
      for (const steps of [[1], [1, 3], [1, 2, 5], [1, 1.5, 2, 3, 4, 5, 6, 8]]) {
        const inside = powers.flatMap(power => steps.map(step => step * 10 ** power)).filter(value => value >= lowest * (1 - 1e-9) && value <= highest * (1 + 1e-9));
        if (inside.length >= Math.min(3, most) || steps.length === 8) return inside.filter((_, at) => at % Math.ceil(inside.length / most) === 0).map(value => [value, short(value)]);
      }
    }
    const rough = (highest - lowest) / most, power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map(factor => factor * power).find(size => size >= rough * .999);
    for (let at = Math.ceil(lowest / step - 1e-9); at * step <= highest + 1e-9 * step; ++at) found.push([at * step, short(at * step)]);
    return found;
  }
  const keyScale = (key, from, to) => scale(key.lowest, key.highest, from, to, {log: key.log, texts: key.texts});

  // Left and lower axis of a plot with a grid; the names of texts are cut to what fits.
  function frame(svg, x, y, box, xTitle) {
    for (const [value, text] of y.ticks) {
      const at = y.place(value);
      svg.append(svgElement("line", {class: "grid", x1: box.left, x2: box.right, y1: at, y2: at}),
                 svgElement("text", {x: box.left - 6, y: at + 4, "text-anchor": "end"}, cut(text, (box.left - 8) / 6.6)));
    }
    const room = (box.right - box.left) / Math.max(1, x.ticks.length);
    for (const [value, text] of x.ticks) {
      const at = x.place(value);
      svg.append(svgElement("line", {class: "axis", x1: at, x2: at, y1: box.bottom, y2: box.bottom + 5}),
                 svgElement("text", {x: at, y: box.bottom + 18, "text-anchor": "middle"}, cut(text, Math.max(4, room / 6.6))));
    }
    svg.append(svgElement("line", {class: "axis", x1: box.left, x2: box.right, y1: box.bottom, y2: box.bottom}),
               svgElement("text", {x: (box.left + box.right) / 2, y: box.bottom + 36, "text-anchor": "middle"}, xTitle));
  }
  const cut = (text, most) => text.length > most ? `${text.slice(0, Math.max(1, Math.floor(most) - 1))}\u2026` : text;

  // Viridis: light and dark in order also for the colour-blind and in grey.
  const stops = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
  function shade(share) {
    const at = Math.min(.9999, Math.max(0, share)) * (stops.length - 1), below = Math.floor(at);
    return `rgb(${stops[below].map((value, k) => Math.round(value + (at - below) * (stops[below + 1][k] - value))).join(" ")})`;
  }

  const extremes = values => values.reduce(([low, high], value) =>
    value === null ? [low, high] : [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);

  // Quantity against a key: quantiles at each level.
  function effect(width, key, quantity, found) {
    const height = 250, box = {left: 62, right: width - 12, top: 8, bottom: height - 44};
    const [low, high] = extremes([...found.q05, ...found.q95]);
    const margin = .05 * (high - low);
    const x = keyScale(key, box.left + 10, box.right - 10), y = scale(low - margin, high + margin, box.bottom, box.top);
    const svg = picture(width, height, `${titled(quantity)} against ${titled(key)}: medians ${found.q50.map(value => short(value)).join(", ")}`);
    frame(svg, x, y, box, titled(key));
    const mean = [];
    key.places.forEach((place, level) => {
      if (found.q50[level] === null) return;
      const at = x.place(place), line = (kind, from, to) => svgElement("line", {class: kind, x1: at, x2: at, y1: y.place(from), y2: y.place(to)});
      const dot = svgElement("circle", {class: "dot", cx: at, cy: y.place(found.q50[level]), r: 4.5}, svgElement("title", {},
        `${key.texts ? key.texts[level] : short(place)}: median ${short(found.q50[level])}, middle half ${short(found.q25[level])} to ${short(found.q75[level])}, 90 % ${short(found.q05[level])} to ${short(found.q95[level])}, ${found.count[level]} points`));
      svg.append(line("thin", found.q05[level], found.q95[level]), line("thick", found.q25[level], found.q75[level]), dot);
      mean.push(`${at},${y.place(found.mean[level])}`);
    });
    svg.append(svgElement("polyline", {class: "mean", points: mean.join(" ")}));
    return svg;
  }

  // Horizontal bars from `from` to `to` with names; whiskers where there are intervals.
  function bars(width, label, rows, {lowest, highest, title}) {
    const line = 24, height = rows.length * line + 52, left = Math.min(210, width * .42);
    const box = {left, right: width - 14, top: 4, bottom: height - 44};
    const x = scale(lowest, highest, box.left, box.right);
    const svg = picture(width, height, label);
    frame(svg, x, {ticks: []}, box, title);
    rows.forEach((row, at) => {
      const top = box.top + at * line + 4, middle = top + 8;
      const from = Math.min(x.place(row.from), x.place(row.to)), to = Math.max(x.place(row.from), x.place(row.to));
      svg.append(svgElement("text", {class: "name", x: left - 8, y: middle + 4, "text-anchor": "end"}, cut(row.name, (left - 10) / 6.4), svgElement("title", {}, row.name)),
                 svgElement("rect", {class: `bar ${row.kind || ""}`, x: from, y: top, width: Math.max(1, to - from), height: 16, rx: 2}, svgElement("title", {}, row.text)));
      if (row.low !== undefined && row.low !== null)
        svg.append(svgElement("path", {class: "whisker", fill: "none", d: `M${x.place(row.low)},${middle}H${x.place(row.high)}M${x.place(row.low)},${middle - 4}v8M${x.place(row.high)},${middle - 4}v8`}));
    });
    return svg;
  }

  // Means over the levels of two keys, and the scale of their colours.
  function map(width, first, second, quantity, means) {
    const height = Math.min(460, Math.max(260, width * .5)), box = {left: 110, right: width - 90, top: 8, bottom: height - 44};
    const [low, high] = extremes(means);
    const svg = picture(width, height, `Mean of ${titled(quantity)} over ${titled(first)} and ${titled(second)}: ${short(low)} to ${short(high)}`);
    const edges = (key, from, to) => {
      const count = key.places.length, size = (to - from) / count;
      return {size: Math.abs(size), place: level => from + (level + .5) * size};
    };
    // Cells stand side by side in equal size, whatever their values' distances are; ticks tell the values.
    const x = edges(second, box.left, box.right), y = edges(first, box.bottom, box.top);
    const marks = (key, side) => {
      const every = Math.ceil(key.places.length / Math.max(2, side));
      return key.places.map((place, level) => [level, key.texts ? key.texts[level] : short(place, 3)]).filter(([level]) => level % every === 0);
    };
    frame(svg, {place: x.place, ticks: marks(second, (box.right - box.left) / 80)}, {place: y.place, ticks: []}, box, titled(second));
    for (const [level, text] of marks(first, (box.bottom - box.top) / 26))
      svg.append(svgElement("text", {x: box.left - 6, y: y.place(level) + 4, "text-anchor": "end"}, cut(text, 15)));
    svg.append(svgElement("text", {transform: `translate(13 ${(box.top + box.bottom) / 2}) rotate(-90)`, "text-anchor": "middle"}, titled(first)));
    means.forEach((mean, at) => {
      if (mean === null) return;
      const row = Math.floor(at / second.places.length), column = at % second.places.length;
      const told = (key, level) => `${key.name} ${key.texts ? key.texts[level] : short(key.places[level])}`;
      svg.append(svgElement("rect", {class: "cell", x: x.place(column) - x.size / 2, y: y.place(row) - y.size / 2, width: x.size, height: y.size,
        fill: shade(high > low ? (mean - low) / (high - low) : .5)}, svgElement("title", {}, `${told(first, row)}, ${told(second, column)}: ${short(mean)} ${quantity.unit}`)));
    });
    const steps = 40, barTop = box.top + 4, barHeight = box.bottom - box.top - 8;
    for (let k = 0; k < steps; ++k)
      svg.append(svgElement("rect", {x: box.right + 14, y: barTop + (steps - 1 - k) * barHeight / steps, width: 14, height: barHeight / steps + .5, fill: shade(k / (steps - 1))}));
    for (const share of [0, .5, 1])
      svg.append(svgElement("text", {x: box.right + 33, y: barTop + (1 - share) * barHeight + 4}, short(low + share * (high - low), 3)));
    return svg;
  }

  return {svgElement, picture, short, titled, scale, keyScale, shade, extremes, cut, effect, bars, map};
})();
