// SPDX-License-Identifier: GPL-3.0-or-later
"use strict";
(() => {
  const page = document.documentElement, byId = id => document.getElementById(id);
  const fail = message => {
    page.dataset.status = "error";
    page.dataset.message = message;
    byId("failure").textContent = `The charts could not be drawn: ${message}`;
    byId("failure").hidden = false;
  };
  addEventListener("error", event => fail(event.message));
  addEventListener("unhandledrejection", event => fail(String(event.reason)));

  const {element, Figure} = Chart, {svgElement, short, titled} = Plots;
  const data = JSON.parse(byId("data").textContent), {keys, quantities, points} = data;
  const chosen = () => Number(byId("quantity").value), second = () => Number(byId("second").value);
  const heading = (text, unit) => {
    const made = element("h3", {}, text);
    if (unit) made.append(element("span", {class: "unit"}, `, ${unit}`));
    return made;
  };
  const widthOf = parent => Math.max(280, parent.clientWidth);
  const show = (figure, ...content) => figure.replaceChildren(...content);

  function fillSelects() {
    const first = ["pressure.max", "radial_displacement.P1.change"];
    for (const [id, wanted] of [["quantity", first[0]], ["second", first[1]]]) {
      quantities.forEach((quantity, at) => byId(id).append(element("option", {value: at}, titled(quantity))));
      byId(id).value = Math.max(0, quantities.findIndex(quantity => quantity.name === wanted));
      byId(id).addEventListener("change", draw);
    }
    data.pairs.forEach((pair, at) => byId("pair").append(element("option", {value: at}, `${keys[pair.first].name} and ${keys[pair.second].name}`)));
    byId("pair").addEventListener("change", drawMap);
    byId("map-section").hidden = data.pairs.length === 0;
  }

  // From the lowest to the highest mean over a key's levels: what the key moves while the others do as they do.
  function drawReach() {
    const at = chosen(), quantity = quantities[at], parent = byId("reach");
    const rows = keys.map((key, k) => {
      const [from, to] = Plots.extremes(data.effects[at][k].mean);
      return {name: key.name, from, to, text: `${key.name}: mean ${short(from)} to ${short(to)} ${quantity.unit}`};
    }).sort((a, b) => (b.to - b.from) - (a.to - a.from));
    const [low] = Plots.extremes(rows.map(row => row.from)), [, high] = Plots.extremes(rows.map(row => row.to));
    show(parent, heading("Reach of each key", quantity.unit),
         Plots.bars(widthOf(parent), `Reach of each key on ${titled(quantity)}: ${rows.map(row => row.text).join("; ")}`, rows,
                    {lowest: low, highest: high, title: `mean of ${titled(quantity)}`}),
         element("figcaption", {}, "Bars: from the lowest to the highest mean over the key's values, the other keys averaged."));
  }
  function drawIndices() {
    const parent = byId("indices"), found = data.indices, quantity = quantities[chosen()];
    const own = found ? found.quantity.map((name, at) => at).filter(at => found.quantity[at] === quantity.name) : [];
    const surrogate = found?.surrogates.find(one => one.quantity === quantity.name);
    const known = own.some(at => found.total[at] !== null);
    if (!known && surrogate?.reason)
      return show(parent, heading("Sobol\u2019 indices"), element("p", {class: "note"}, `No indices of ${quantity.name}: ${surrogate.reason}.`));
    if (!own.length)
      return show(parent, heading("Sobol\u2019 indices"), element("p", {class: "note"}, found ? `No indices of ${quantity.name} in indices.csv.` : "No indices.csv among the results."));
    own.sort((a, b) => found.total[b] - found.total[a]);
    const rows = own.flatMap(at => ["first", "total"].map(kind => ({
      name: kind === "first" ? found.parameter[at] : "total", kind: kind === "total" ? "total" : "", from: 0, to: Math.max(0, found[kind][at] ?? 0),
      low: found[`${kind}_low`][at], high: found[`${kind}_high`][at],
      text: `${found.parameter[at]}, ${kind}: ${short(found[kind][at], 3)} (${short(found[`${kind}_low`][at], 3)} to ${short(found[`${kind}_high`][at], 3)})`,
    })));
    const [low] = Plots.extremes([0, ...rows.map(row => row.low)]), [, high] = Plots.extremes([1, ...rows.map(row => row.high)]);
    show(parent, heading("Sobol\u2019 indices"),
         Plots.bars(widthOf(parent), `Sobol\u2019 indices of ${quantity.name}: ${rows.map(row => row.text).join("; ")}`, rows, {lowest: low, highest: high, title: "share of the variance"}),
         element("figcaption", {}, "First order: the key alone. Total: with its part in interactions. Whiskers: " + (surrogate
           ? `95 % intervals, with what the surrogate misses. It is ${surrogate.kind} of ${surrogate.points} points; held-out Q\u00b2 ${short(surrogate.q2, 4)}${surrogate.reason ? `: ${surrogate.reason}` : ""}.`
           : "confidence intervals of indices.csv.")));
  }
  function drawEffects() {
    const quantity = quantities[chosen()];
    byId("effects").replaceChildren(...keys.map((key, k) => {
      const figure = element("figure", {id: `effect-${k}`});
      byId("effects").append(figure);
      show(figure, heading(`${quantity.name} against ${key.name}`, quantity.unit), Plots.effect(widthOf(figure), key, quantity, data.effects[chosen()][k]));
      return figure;
    }));
  }
  function drawMap() {
    const pair = data.pairs[Number(byId("pair").value)];
    if (!pair) return;
    const quantity = quantities[chosen()], first = keys[pair.first], other = keys[pair.second], parent = byId("map");
    const binned = [first, other].some(key => key.binned);
    show(parent, heading(`Mean of ${quantity.name}`, quantity.unit), Plots.map(widthOf(parent), first, other, quantity, pair.means[chosen()]),
         element("figcaption", {}, `${binned ? "Ranges are cut into equal parts, told by their middles. " : ""}The other keys are averaged; empty cells have no point.${keys.length > 4 ? " Maps are made of the first four keys." : ""}`));
  }

  // Parallel coordinates: a line for each point, an axis for each key and two quantities. Brushes are ranges of
  // values by the axis' name, so that they outlast a new choice of quantities.
  const brushes = new Map();
  let axes = [], lines = [], selected = null;
  const inside = at => axes.every(axis => {
    const range = brushes.get(axis.name), value = axis.values[at];
    return !range || (value !== null && value >= range[0] && value <= range[1]);
  });

  function drawParallel() {
    const shownQuantities = [...new Set([chosen(), second()])];
    const definitions = [...keys.map((key, k) => ({...key, values: points.keys[k]})), ...shownQuantities.map(at => {
      const [lowest, highest] = Plots.extremes(points.values[at]);
      return {...quantities[at], lowest: Number.isFinite(lowest) ? lowest : 0, highest: Number.isFinite(highest) ? highest : 1, values: points.values[at]};
    })];
    const parent = byId("parallel"), width = Math.max(widthOf(parent), 118 * definitions.length), height = 380;
    const top = 42, bottom = height - 14, left = 62, right = width - 62;
    const svg = Plots.picture(width, height, `Parallel coordinates of ${points.number.length} points over ${definitions.map(titled).join(", ")}`);
    svg.setAttribute("role", "group");
    if (width > parent.clientWidth) svg.style.width = `${width}px`;
    axes = definitions.map((definition, at) => ({...definition, x: left + at * (right - left) / Math.max(1, definitions.length - 1), scale: Plots.keyScale(definition, bottom, top)}));
    const colours = points.values[chosen()], [low, high] = Plots.extremes(colours);
    const body = svgElement("g", {class: points.number.length > 300 ? "many" : ""});
    lines = points.number.map((number, at) => {
      const places = axes.filter(axis => axis.values[at] !== null).map(axis => `${axis.x.toFixed(1)},${axis.scale.place(axis.values[at]).toFixed(1)}`);
      const made = svgElement("polyline", {class: points.done[at] ? "line" : "line failed", points: places.join(" ")});
      if (points.done[at]) made.style.stroke = colours[at] === null ? "var(--faint)" : Plots.shade(high > low ? (colours[at] - low) / (high - low) : .5);
      made.addEventListener("click", () => choose(at));
      body.append(made);
      return made;
    });
    svg.append(body, ...axes.map(axisGroup));
    show(parent, element("div", {class: "sideways"}, svg),
         element("figcaption", {}, `Colour: ${titled(quantities[chosen()])}, dark is low.${points.done.includes(0) ? " Dashed: points without a result." : ""}`));
    applyBrushes();
  }

  function axisGroup(axis) {
    const group = svgElement("g"), {x, scale} = axis;
    const label = svgElement("text", {class: "name", x, y: 14, "text-anchor": "middle"}, Plots.cut(axis.name, 17), svgElement("title", {}, axis.name));
    group.append(label, svgElement("text", {x, y: 29, "text-anchor": "middle"}, axis.unit || ""),
                 svgElement("line", {class: "upright", x1: x, x2: x, y1: scale.place(scale.lowest), y2: scale.place(scale.highest)}));
    for (const [value, text] of scale.ticks)
      group.append(svgElement("text", {class: "over", x: x + 5, y: scale.place(value) + 4}, Plots.cut(text, 13)));
    axis.brush = svgElement("rect", {class: "brush", x: x - 8, width: 16, visibility: "hidden"});
    const grip = svgElement("rect", {class: "grip", x: x - 22, y: 36, width: 44, height: 336, tabindex: 0, role: "slider",
      "aria-orientation": "vertical", "aria-label": `Brush of ${titled(axis)}`, "aria-valuemin": axis.lowest, "aria-valuemax": axis.highest});
    axis.grip = grip;
    let start = null;
    const valueAt = event => {
      const bounds = grip.ownerSVGElement.getBoundingClientRect();
      return scale.value((event.clientY - bounds.top) * grip.ownerSVGElement.viewBox.baseVal.height / bounds.height);
    };
    grip.addEventListener("pointerdown", event => { start = valueAt(event); grip.setPointerCapture(event.pointerId); });
    grip.addEventListener("pointermove", event => { if (start !== null) setBrush(axis, start, valueAt(event)); });
    grip.addEventListener("pointerup", event => {
      // A mere click takes the brush away.
      const end = valueAt(event);
      if (Math.abs(scale.place(end) - scale.place(start)) < 4) setBrush(axis, null);
      start = null;
    });
    grip.addEventListener("pointercancel", () => { start = null; });
    grip.addEventListener("keydown", event => moveByKey(axis, event));
    group.append(axis.brush, grip);
    return group;
  }
  function moveByKey(axis, event) {
    const steps = {ArrowUp: [1, 1], ArrowDown: [-1, -1], "+": [-.5, .5], "-": [.5, -.5]};
    if (event.key === "Escape") setBrush(axis, null);
    else if (steps[event.key]) {
      const {scale} = axis, span = scale.place(scale.highest) - scale.place(scale.lowest);
      const share = value => (scale.place(value) - scale.place(scale.lowest)) / span;
      const value = part => scale.value(scale.place(scale.lowest) + Math.min(1, Math.max(0, part)) * span);
      const [from, to] = brushes.has(axis.name) ? brushes.get(axis.name).map(share) : [.4, .6];
      const [down, up] = steps[event.key].map(step => step * .1);
      if (from + down < to + up - .01) setBrush(axis, value(from + down), value(to + up));
    } else return;
    event.preventDefault();
  }
  function setBrush(axis, from, to) {
    if (from === null) brushes.delete(axis.name);
    else brushes.set(axis.name, [Math.min(from, to), Math.max(from, to)]);
    applyBrushes();
  }
  function applyBrushes() {
    for (const axis of axes) {
      const range = brushes.get(axis.name);
      axis.brush.setAttribute("visibility", range ? "visible" : "hidden");
      axis.grip.setAttribute("aria-valuetext", range ? `${short(range[0])} to ${short(range[1])}` : "all");
      axis.grip.setAttribute("aria-valuenow", range ? (range[0] + range[1]) / 2 : (axis.lowest + axis.highest) / 2);
      if (!range) continue;
      const [high, low] = range.map(value => axis.scale.place(value));
      axis.brush.setAttribute("y", Math.min(high, low));
      axis.brush.setAttribute("height", Math.max(1, Math.abs(high - low)));
    }
    const kept = points.number.map((_, at) => at).filter(inside);
    const isKept = new Set(kept);
    lines.forEach((line, at) => { line.classList.toggle("off", !isKept.has(at)); line.classList.toggle("chosen", at === selected); });
    byId("brushed").textContent = brushes.size ? `${kept.length} of ${points.number.length} points within the brushes.` : `${points.number.length} points drawn.`;
    listPoints(kept);
  }

  const most = 10;
  function listPoints(kept) {
    const rows = kept.slice(0, most).map(at => {
      const pick = element("button", {type: "button", "aria-pressed": String(at === selected)}, `Point ${points.number[at]}`);
      pick.addEventListener("click", () => choose(at));
      return element("tr", {}, element("th", {scope: "row"}, pick), ...axes.map(axis =>
        element("td", {"data-head": titled(axis)}, axis.texts ? axis.texts[axis.values[at]] : short(axis.values[at]))));
    });
    if (!rows.length) return byId("listed").replaceChildren();
    byId("listed").replaceChildren(element("div", {class: "scroll", tabindex: 0}, element("table", {},
      element("caption", {}, kept.length > most ? `The first ${most} of them; a click on a line chooses it too.` : "A click on a line chooses it too."),
      element("thead", {}, element("tr", {}, element("th", {scope: "col"}, "Point"), ...axes.map(axis => element("th", {scope: "col"}, titled(axis))))),
      element("tbody", {}, ...rows))));
    fitTables();
  }
  function fitTables() {
    for (const box of document.querySelectorAll(".scroll, .legend")) {
      box.classList.remove("narrow");
      box.classList.toggle("narrow", box.scrollWidth > box.clientWidth + 1);
    }
  }
  function choose(at) {
    selected = at;
    const number = points.number[at], run = data.curve_points.indexOf(number);
    applyBrushes();
    if (run >= 0) {
      byId("command").textContent = `Point ${number} is among the curves below.`;
      figures.forEach(figure => data.curve_points.forEach((_, other) => figure.toggleRun(other, other === run)));
      byId("curves-section").scrollIntoView({block: "nearest"});
    } else {
      byId("command").replaceChildren(`Curves of point ${number} are computed and added to this page by `, element("code", {}, data.command + number));
    }
  }

  // Curves of the points whose whole results are kept: colour tells the point.
  const figures = [], runs = data.curves.runs;
  const wallPoints = ["P1", "P2", "P3", "P4"];
  let wallPoint = "P1";
  function curveChart(spec, column) {
    const known = run => run.columns[column()];
    const make = () => runs.map((run, at) => ({run, at})).filter(({run}) => known(run)).map(({run, at}) => {
      const first = run.time.findIndex(time => time >= run.beat.start - 1e-9);
      return {run: at, runLabel: `${data.curve_points[at]}: ${run.label}`, part: 0, partLabel: "",
              x: run.time.slice(first).map(time => Math.round((time - run.beat.start) * 1e8) / 1e8), y: known(run).slice(first)};
    });
    const made = make();
    if (!made.length) return;
    const figure = new Figure(byId("time-charts"), {sync: "time", xLabel: () => "time in the last beat, s", digits: 3, ...spec, lines: made});
    figure.changePoint = () => {
      const now = make();
      for (const line of figure.spec.lines) Object.assign(line, {y: now.find(other => other.run === line.run)?.y ?? []});
      figure.update();
    };
    figures.push(figure);
  }
  function drawCurves() {
    byId("command").textContent = runs.length ? "A point chosen above is shown alone here when it is among these." :
      "No point's curves are kept yet: choose a point above, and the command that computes them stands here.";
    if (!runs.length) return;
    curveChart({id: "pressure", title: "Pressure", unit: "mmHg", digits: 2}, () => "pressure");
    curveChart({id: "flow", title: "Outflow", unit: "cm\u00b3/s", digits: 4}, () => "outflow");
    curveChart({id: "displacement", title: "Displacement", unit: "cm", digits: 5}, () => `radial_displacement.${wallPoint}`);
    curveChart({id: "mises", title: "Von Mises stress", unit: "10\u2075 dyn/cm\u00b2"}, () => `von_mises.${wallPoint}`);
    curveChart({id: "angle", title: "Fibre angle", unit: "\u00b0", digits: 2}, () => `fiber_angle.${wallPoint}`);
    curveChart({id: "recruitment", title: "Recruitment H", range: () => [-.06, 1.06]}, () => `recruitment.${wallPoint}`);
    const choice = byId("wall-points");
    choice.hidden = false;
    choice.append(element("fieldset", {}, element("legend", {class: "hidden"}, "Point in the wall"), ...wallPoints.map(point => {
      const radio = element("input", {type: "radio", name: "wall-point", value: point});
      radio.checked = point === wallPoint;
      radio.addEventListener("change", () => { wallPoint = point; figures.forEach(figure => figure.changePoint()); });
      return element("label", {}, radio, point);
    })), element("p", {class: "hint"}, "P1 lies on the inner, P4 on the outer surface."));
  }

  function draw() {
    drawReach();
    drawIndices();
    drawEffects();
    drawMap();
    drawParallel();
  }
  fillSelects();
  draw();
  drawCurves();
  byId("clear").addEventListener("click", () => { brushes.clear(); applyBrushes(); });
  for (const table of document.querySelectorAll("main > section > .scroll > table"))
    for (const row of table.tBodies[0].rows)
      [...row.cells].forEach((cell, at) => { cell.dataset.head = table.tHead.rows[0].cells[at].textContent; });
  fitTables();

  let waiting = 0, lastWidth = document.querySelector("main").clientWidth;
  new ResizeObserver(() => {
    cancelAnimationFrame(waiting);
    waiting = requestAnimationFrame(() => {
      const width = document.querySelector("main").clientWidth;
      if (width === lastWidth) return;
      lastWidth = width;
      draw();
      figures.forEach(figure => figure.resize());
      fitTables();
    });
  }).observe(document.querySelector("main"));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    Chart.forgetColours();
    figures.forEach(figure => figure.repaint());
  });

  Promise.all(figures.map(figure => figure.drawn)).then(() => {
    page.dataset.points = String(points.number.length);
    page.dataset.charts = String(figures.length);
    if (page.dataset.status === "loading") page.dataset.status = "ok";
  });
})();
