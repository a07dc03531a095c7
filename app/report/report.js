// SPDX-License-Identifier: GPL-3.0-or-later
"use strict";
(() => {
  const page = document.documentElement;
  const fail = message => {
    page.dataset.status = "error";
    page.dataset.message = message;
    const banner = document.getElementById("failure");
    banner.textContent = `The charts could not be drawn: ${message}`;
    banner.hidden = false;
  };
  addEventListener("error", event => fail(event.message));
  addEventListener("unhandledrejection", event => fail(String(event.reason)));

  const {Figure, element, colour} = Chart;
  const points = ["P1", "P2", "P3", "P4"];
  const figures = [];
  const runs = JSON.parse(document.getElementById("data").textContent).runs;
  let span = "beat";

  // Rows shown: all, or those of the run's last beat with time counted from its start. Times are rounded
  // so that equal instants of different runs are equal numbers.
  const rounded = time => Math.round(time * 1e8) / 1e8;
  for (const run of runs) {
    const slack = 1e-9 + 1e-9 * run.beat.period;
    const first = run.time.findIndex(time => time >= run.beat.start - slack);
    let end = run.time.length;
    while (end > first && run.time[end - 1] > run.beat.start + run.beat.period + slack) --end;
    run.spans = {
      run: {first: 0, end: run.time.length, x: run.time},
      beat: {first, end, x: run.time.slice(first, end).map(time => rounded(time - run.beat.start))},
    };
  }
  const timeLabel = () => span === "beat" ? "time in the last beat, s" : "time, s";
  const cut = (run, values) => values.slice(run.spans[span].first, run.spans[span].end);

  const note = (parent, text) => parent.append(element("p", {class: "note"}, text));
  // A single row is a state, which has no curve over time.
  const isState = run => run.time.length === 1;
  const missing = (lines, why) => {
    const without = runs.filter((run, index) => !isState(run) && !lines.some(line => line.run === index)).map(run => run.label);
    return without.length ? `Not shown: ${without.join("; ")} (${why}).` : "";
  };

  // A chart over time. parts: [[column, label], ...].
  function timeChart(spec, parts) {
    const parent = document.getElementById("time-charts");
    const lines = [];
    runs.forEach((run, at) => !isState(run) && parts.forEach(([column, label], part) => {
      const values = run.columns[column];
      if (values) lines.push({run: at, runLabel: run.label, part, partLabel: label, source: values, x: run.spans[span].x, y: cut(run, values)});
    }));
    const why = spec.why || "not among the results";
    if (!lines.length) return note(parent, `${spec.title}: ${why}.`);
    const figure = new Figure(parent, {
      sync: "time", xLabel: timeLabel, digits: 3, ...spec, lines,
      caption: [spec.caption, missing(lines, why)].filter(Boolean).join(" "),
    });
    figure.changeSpan = () => {
      for (const line of lines) {
        line.x = runs[line.run].spans[span].x;
        line.y = cut(runs[line.run], line.source);
      }
      figure.update();
    };
    figures.push(figure);
  }
  const atPoints = quantity => points.map(point => [`${quantity}.${point}`, point]);

  // States at P1..P4: a point for each, joined by a line.
  function stateChart(spec, quantity) {
    const states = runs.map((run, index) => ({run, index})).filter(entry => isState(entry.run));
    const lines = states.filter(({run}) => run.columns[`${quantity}.P1`]).map(({run, index}) => ({
      run: index, runLabel: run.label, part: 0, partLabel: "", x: points.map((_, part) => part + 1),
      y: points.map(point => run.columns[`${quantity}.${point}`]?.[0] ?? null),
    }));
    if (!lines.length) return;
    const without = states.filter(({index}) => !lines.some(line => line.run === index)).map(({run}) => run.label);
    figures.push(new Figure(document.getElementById("state-charts"), {
      sync: "states", xLabel: () => "point, from the inner (P1) to the outer surface (P4)", ...spec, lines,
      xRange: () => [.8, points.length + .2],
      xAxis: {splits: () => points.map((_, part) => part + 1), values: () => points},
      caption: without.length ? `Not shown: ${without.join("; ")} (no fibres).` : "",
    }));
  }
  // Quantities of states against the number that alone tells them apart, at P1..P4: dots, joined in its order. These lines
  // belong to no single run, so that hiding one leaves them.
  function statesAgainstTheirKey(spec, columns) {
    const states = runs.filter(run => run.setting).sort((a, b) => a.setting.value - b.setting.value);
    if (states.length < 2) return;
    const {name, unit} = states[0].setting;
    const lines = columns.filter(([column]) => states.some(run => run.columns[column])).map(([column, label], part) => ({
      run: runs.length, runLabel: "", part, partLabel: label, x: states.map(run => run.setting.value), y: states.map(run => run.columns[column]?.[0] ?? null),
    }));
    if (lines.length)
      figures.push(new Figure(document.getElementById("state-charts"), {sync: "settings", xLabel: () => unit ? `${name}, ${unit}` : name, dots: true, ...spec,
        id: `${spec.id}-by-key`, title: `${spec.title} against ${name}`, lines}));
  }
  function stateCharts() {
    if (!runs.some(isState)) return;
    const byKey = [[{id: "state-pressure", title: "Pressure", unit: "mmHg", digits: 2}, [["pressure", "mid-length"], ["transmural_pressure", "transmural"]]],
                   [{id: "state-displacement", title: "Displacement", unit: "cm", digits: 5}, atPoints("radial_displacement")],
                   [{id: "state-mises", title: "Von Mises stress", unit: "10\u2075 dyn/cm²", digits: 3}, atPoints("von_mises")],
                   [{id: "state-angle", title: "Fibre angle", unit: "°", digits: 2}, atPoints("fiber_angle")]];
    for (const [spec, columns] of byKey) statesAgainstTheirKey(spec, columns);
    stateChart({id: "state-displacement", title: "Displacement", unit: "cm", digits: 5}, "radial_displacement");
    stateChart({id: "state-mises", title: "Von Mises stress", unit: "10\u2075 dyn/cm²", digits: 3}, "von_mises");
    stateChart({id: "state-angle", title: "Fibre angle", unit: "°", digits: 2}, "fiber_angle");
    stateChart({id: "state-stretch", title: "Fibre stretch", digits: 4}, "fiber_stretch");
    stateChart({id: "state-recruitment", title: "Recruitment H", digits: 3, range: () => [-.06, 1.06]}, "recruitment");
  }

  // Bars of the intervals in which fibres are recruited, a lane for each point, P1 on top, and a bar for each
  // run in a lane. The inflow of the first run lies behind, as in the paper's figure.
  function intervalChart() {
    const parent = document.getElementById("time-charts");
    const withFibres = runs.map((run, index) => ({run, index})).filter(entry => entry.run.recruited);
    // Of many runs each bar keeps a few pixels.
    const spec = {id: "intervals", title: "Intervals of recruitment", figure: "cf. Fig. 14d", height: Math.max(250, 60 + 38 * withFibres.length)};
    if (!withFibres.length) return note(parent, `${spec.title}: no fibres in these laws.`);
    const lane = part => points.length - 1 - part;
    const lines = withFibres.flatMap(({run, index}) => points.map((point, part) => ({
      run: index, runLabel: run.label, part, partLabel: point, intervals: run.recruited[point],
    })));
    const shift = line => span === "beat" ? runs[line.run].beat.start : 0;
    const reach = () => Math.max(...withFibres.map(({run}) => span === "beat" ? run.beat.period : run.time.at(-1)));
    // The bars have no samples of their own: a fine grid lets the cursor tell what is recruited.
    const setData = () => {
      const x = Array.from({length: 1601}, (_, index) => rounded(reach() * index / 1600));
      for (const line of lines) { line.x = x; line.y = x.map(() => lane(line.part)); }
    };
    setData();
    const draw = figure => {
      const {plot} = figure, {ctx, bbox} = plot, ratio = uPlot.pxRatio;
      ctx.save();
      ctx.beginPath();
      ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
      ctx.clip();
      const flow = withFibres[0].run;
      if (flow.columns.inflow) {
        const values = cut(flow, flow.columns.inflow);
        const highest = Math.max(...values);
        ctx.beginPath();
        flow.spans[span].x.forEach((time, index) => ctx.lineTo(plot.valToPos(time, "x", true),
          bbox.top + bbox.height * (1 - .9 * Math.max(0, values[index]) / highest)));
        ctx.lineTo(plot.valToPos(flow.spans[span].x.at(-1), "x", true), bbox.top + bbox.height);
        ctx.lineTo(plot.valToPos(flow.spans[span].x[0], "x", true), bbox.top + bbox.height);
        ctx.fillStyle = colour("--shade");
        ctx.fill();
      }
      const laneHeight = Math.abs(plot.valToPos(0, "y", true) - plot.valToPos(1, "y", true)) * .64;
      const barHeight = Math.min(16 * ratio, laneHeight / withFibres.length), gap = Math.min(ratio, barHeight / 6);
      for (const line of lines) {
        if (!line.shown) continue;
        const order = withFibres.findIndex(entry => entry.index === line.run);
        const top = plot.valToPos(lane(line.part), "y", true) + (order - withFibres.length / 2) * barHeight;
        ctx.fillStyle = colour(line.colour);
        for (const [from, to] of line.intervals) {
          const left = plot.valToPos(from - shift(line), "x", true), right = plot.valToPos(to - shift(line), "x", true);
          ctx.fillRect(left, top + gap, Math.max(ratio, right - left), barHeight - 2 * gap);
        }
      }
      ctx.restore();
    };
    const figure = new Figure(parent, {
      ...spec, sync: "time", xLabel: timeLabel, digits: 0, lines, draw,
      caption: `Bars: fibres recruited. Grey: inflow, scaled. ${missing(lines, "no fibres")}`,
      range: () => [-.6, points.length - .4],
      axis: {splits: () => points.map((_, part) => lane(part)).reverse(),
             values: () => [...points].reverse(), grid: {show: false}, ticks: {show: false}},
      valueAt: (line, time) => line.intervals.some(([from, to]) => time + shift(line) >= from && time + shift(line) <= to)
        ? "recruited" : "–",
    });
    figure.changeSpan = () => { setData(); figure.update(); };
    figures.push(figure);
  }

  // Curves at a few times: through the wall (profiles) or along the artery.
  const places = {
    profiles: {place: "reference_radius", label: "radius in the unloaded wall, cm", why: "no profiles among the results"},
    along: {place: "z", label: "distance from the inlet, cm", why: "no curves along the artery among the results"},
  };
  function profileChart(table, spec, column) {
    const {place, label, why: without} = places[table];
    const parent = document.getElementById(`${table === "along" ? "along" : "profile"}-charts`);
    const times = [...new Set(runs.flatMap(run => (run[table] || []).map(profile => profile.time.toFixed(4))))]
      .sort((a, b) => a - b);
    const lines = [];
    runs.forEach((run, at) => (run[table] || []).forEach(profile => {
      if (profile.columns[column] && profile.columns[place])
        lines.push({run: at, runLabel: run.label, part: times.indexOf(profile.time.toFixed(4)),
                    partLabel: `${Number(profile.time.toFixed(4))} s`, x: profile.columns[place], y: profile.columns[column]});
    }));
    const why = spec.why || without;
    if (!lines.length) return note(parent, `${spec.title}: ${why}.`);
    figures.push(new Figure(parent, {
      sync: place, xLabel: () => label, digits: 3, ...spec, lines,
      caption: [spec.caption, missing(lines, why)].filter(Boolean).join(" "),
      range: spec.insideOnly && (() => insideRange(lines)),
    }));
  }
  // What becomes singular at clamped ends would leave the rest of its curve flat.
  function insideRange(lines) {
    const values = lines.filter(line => line.shown !== false).flatMap(line =>
      line.y.filter((y, at) => y !== null && line.x[at] > .1 * line.x.at(-1) && line.x[at] < .9 * line.x.at(-1)));
    const least = Math.min(...values), greatest = Math.max(...values);
    const margin = .3 * (greatest - least) || .1 * Math.abs(greatest) || 1;
    return [least - margin, greatest + margin];
  }
  // Only the tiers that know the length have something to show.
  function alongCharts() {
    if (!runs.some(run => run.along)) return;
    document.getElementById("along-section").hidden = false;
    profileChart("along", {id: "along-radius", title: "Radius of the lumen", unit: "cm", digits: 5}, "lumen_radius");
    profileChart("along", {id: "along-pressure", title: "Pressure at the wall", unit: "mmHg", digits: 2}, "pressure");
    profileChart("along", {id: "along-shear", title: "Wall shear stress", unit: "dyn/cm²", digits: 2,
      insideOnly: true, caption: "Scaled for what is away from the ends."}, "wall_shear_stress");
    profileChart("along", {id: "along-mises", title: "Von Mises stress on the inner surface", unit: "10\u2075 dyn/cm²",
      insideOnly: true, caption: "Scaled for what is away from the ends."}, "von_mises.inner");
  }

  function sensitivityChart() {
    const section = document.getElementById("sensitivity-section");
    const parent = document.getElementById("sensitivity-charts");
    const select = document.getElementById("quantity");
    const withThem = runs.map((run, index) => ({run, index})).filter(entry => entry.run.sensitivities);
    const order = Object.keys(withThem[0]?.run.columns || {});
    const quantities = [...new Set(withThem.flatMap(({run}) => Object.keys(run.sensitivities.quantities)))]
      .sort((a, b) => (b === "pressure") - (a === "pressure") || order.indexOf(a) - order.indexOf(b));
    if (!withThem.length) return;
    section.hidden = false;
    const keys = [...new Set(withThem.flatMap(({run}) => Object.values(run.sensitivities.quantities).flatMap(Object.keys)))].sort();
    const skipped = [...new Set(withThem.flatMap(({run}) => run.sensitivities.without_percent))];
    if (skipped.length) note(parent, `Not shown, as 1 % of them is nothing: ${skipped.join(", ")}. See sensitivities.csv.`);
    if (!quantities.length) return;
    for (const quantity of quantities) select.append(element("option", {}, quantity));
    const unitOf = quantity => /^von_mises/.test(quantity) ? "10\u2075 dyn/cm²" : /pressure/.test(quantity) ? "mmHg" :
      /flow/.test(quantity) ? "cm³/s" : /displacement/.test(quantity) ? "cm" : /angle/.test(quantity) ? "°" : "";
    let figure = null;
    const show = () => {
      const lines = withThem.flatMap(({run, index}) => keys.filter(key => run.sensitivities.quantities[select.value]?.[key]).map(key => ({
        run: index, runLabel: run.label, part: keys.indexOf(key), partLabel: key, source: run.sensitivities.quantities[select.value][key],
      })));
      const place = () => {
        for (const line of lines) {
          const run = runs[line.run], all = run.sensitivities.time;
          const kept = all.map((time, at) => at).filter(at => span === "run" ||
            (all[at] >= run.beat.start - 1e-9 && all[at] <= run.beat.start + run.beat.period + 1e-9));
          line.x = kept.map(at => span === "run" ? all[at] : rounded(all[at] - run.beat.start));
          line.y = kept.map(at => line.source[at]);
        }
      };
      place();
      if (figure) { figure.plot.destroy(); figure.root.remove(); figures.splice(figures.indexOf(figure), 1); }
      figure = new Figure(parent, {id: "sensitivity", title: `Change of ${select.value} for +1 %`, unit: unitOf(select.value),
        sync: "time", xLabel: timeLabel, digits: 4, height: 320, lines});
      figure.changeSpan = () => { place(); figure.update(); };
      figures.push(figure);
    };
    select.addEventListener("change", show);
    show();
  }

  // What a verification found: the difference of a tier to the reference, and what it is made of.
  function differenceCharts() {
    const section = document.getElementById("comparison-charts");
    if (!section) return;
    const {comparisons} = JSON.parse(document.getElementById("differences").textContent);
    const select = document.getElementById("compared-quantity");
    for (const name of [...new Set(comparisons.flatMap(one => Object.keys(one.quantities)))])
      select.append(element("option", {}, name));
    let shown = [];
    const show = () => {
      for (const figure of shown) {
        figure.plot.destroy();
        figure.root.remove();
        figures.splice(figures.indexOf(figure), 1);
      }
      shown = comparisons.filter(one => one.quantities[select.value]).map(one => {
        const {unit, limit, lines} = one.quantities[select.value];
        return new Figure(section, {
          id: `difference-${one.tier}`, title: `${one.tier} minus ${one.reference}: ${select.value}`, unit, sync: "time",
          xLabel: () => "time in the last beat, s", digits: 3, height: 320,
          caption: `The difference and its parts, which add up to it. Limit: ${Number(limit.toPrecision(3))}${unit === "°" ? "" : " "}${unit}.`,
          lines: lines.map((y, run) => ({run, runLabel: one.labels[run], part: 0, partLabel: "", x: one.time, y})),
        });
      });
      figures.push(...shown);
    };
    select.addEventListener("change", show);
    if (select.options.length) show();
  }

  function timeCharts() {
    timeChart({id: "pressure", title: "Pressure", unit: "mmHg", figure: "cf. Fig. 6", digits: 2},
              [["pressure", "mid-length"], ["outlet_pressure", "outlet"]]);
    timeChart({id: "transmural", title: "Transmural pressure", unit: "mmHg", digits: 2}, [["transmural_pressure", "transmural"]]);
    timeChart({id: "flow", title: "Flow", unit: "cm³/s", figure: "cf. Fig. 5", digits: 4}, [["inflow", "in"], ["outflow", "out"]]);
    timeChart({id: "displacement", title: "Displacement of the inner surface", unit: "cm", figure: "cf. Fig. 10", digits: 5},
              [["radial_displacement.P1", "P1"]]);
    timeChart({id: "displacement-points", title: "Displacement through the wall", unit: "cm", figure: "cf. Fig. 14b", digits: 5},
              atPoints("radial_displacement"));
    timeChart({id: "angle", title: "Fibre angle", unit: "°", figure: "cf. Figs. 12–13", digits: 2, why: "no fibres"}, atPoints("fiber_angle"));
    timeChart({id: "stretch", title: "Fibre stretch", digits: 4, why: "no fibres"}, atPoints("fiber_stretch"));
    timeChart({id: "mises", title: "Von Mises stress", unit: "10\u2075 dyn/cm²", digits: 3}, atPoints("von_mises"));
    timeChart({id: "recruitment", title: "Recruitment H", figure: "cf. Fig. 14c", digits: 3, why: "no fibres", range: () => [-.06, 1.06]},
              atPoints("recruitment"));
    intervalChart();
  }
  function profileCharts() {
    profileChart("profiles", {id: "profile-circumferential", title: "Circumferential stretch", digits: 4}, "circumferential_stretch");
    profileChart("profiles", {id: "profile-fiber", title: "Fibre stretch", digits: 4, why: "no fibres"}, "fiber_stretch");
    profileChart("profiles", {id: "profile-mises", title: "Von Mises stress", unit: "10\u2075 dyn/cm²", figure: "cf. Figs. 15–16"}, "von_mises");
  }

  differenceCharts();
  stateCharts();
  if (runs.every(isState)) document.getElementById("beat-section").hidden = true;
  else timeCharts();
  if (runs.some(run => run.profiles)) profileCharts();
  else document.getElementById("wall-section").hidden = true;
  alongCharts();
  sensitivityChart();

  // Lines of several runs at four points tangle: one point can be shown alone, which a page of many runs begins with.
  const hiddenRuns = new Set(), manyRuns = 4;
  const atWallPoints = figures.filter(figure => figure.spec.sync === "time" && !figure.spec.draw &&
    figure.spec.lines.some(line => line.partLabel === points[1]));
  const wallPoint = document.getElementById("wall-point");
  const showPoints = () => {
    for (const figure of atWallPoints)
      for (const point of points)
        figure.toggle(figure.spec.lines.filter(line => line.partLabel === point && !hiddenRuns.has(line.run)),
                      !wallPoint.value || wallPoint.value === point);
  };
  if (runs.length > 1 && atWallPoints.length) {
    document.getElementById("point-choice").hidden = false;
    if (runs.length > manyRuns) wallPoint.value = points[0];
    wallPoint.addEventListener("change", showPoints);
    showPoints();
  }

  // With several runs, a button for each hides or shows it in all charts.
  if (runs.length > 1) {
    const list = document.getElementById("run-list");
    list.hidden = false;
    runs.forEach((run, index) => {
      const swatch = element("span", {class: "swatch", style: `background:var(--c${index % Chart.colours})`});
      const button = element("button", {type: "button", "aria-pressed": "true"}, swatch, run.label);
      button.addEventListener("click", () => {
        const shown = button.getAttribute("aria-pressed") !== "true";
        button.setAttribute("aria-pressed", String(shown));
        for (const figure of figures) figure.toggleRun(index, shown);
        if (shown) hiddenRuns.delete(index);
        else hiddenRuns.add(index);
        showPoints();
      });
      list.append(button);
    });
  }

  for (const radio of document.querySelectorAll("input[name=span]"))
    radio.addEventListener("change", () => {
      span = radio.value;
      for (const figure of figures) if (figure.changeSpan) figure.changeSpan();
    });
  document.getElementById("reset").addEventListener("click", () => figures.forEach(figure => figure.resetZoom()));

  // Tables that are wider than their place become lists, whose values need their heads beside them.
  const tables = [...document.querySelectorAll(".scroll > table")];
  function eachCell(rows, visit) {
    const taken = [];
    [...rows].forEach((row, at) => {
      let column = 0;
      for (const cell of row.cells) {
        while (taken[at]?.[column]) ++column;
        visit(cell, column);
        for (let down = 0; down < cell.rowSpan; ++down)
          for (let right = 0; right < cell.colSpan; ++right) (taken[at + down] ??= [])[column + right] = true;
        column += cell.colSpan;
      }
    });
  }
  for (const table of tables) {
    const heads = [];
    eachCell(table.tHead.rows, (cell, column) => {
      const words = cell.cloneNode(true);
      for (const end of words.querySelectorAll("br")) end.replaceWith(" ");
      for (let right = 0; right < cell.colSpan; ++right) (heads[column + right] ??= []).push(words.textContent.trim());
    });
    eachCell(table.tBodies[0].rows, (cell, column) => { cell.dataset.head = (heads[column] || []).join(": "); });
  }
  function fitTables() {
    const boxes = [...document.querySelectorAll(".scroll, .legend")];
    for (const box of boxes) box.classList.remove("narrow");
    const wide = boxes.filter(box => box.scrollWidth > box.clientWidth + 1);
    for (const box of wide) box.classList.add("narrow");
  }
  for (const details of document.querySelectorAll("details")) details.addEventListener("toggle", fitTables);

  let waiting = 0;
  const refit = () => {
    figures.forEach(figure => figure.resize());
    fitTables();
  };
  new ResizeObserver(() => {
    cancelAnimationFrame(waiting);
    waiting = requestAnimationFrame(refit);
  }).observe(document.querySelector("main"));
  fitTables();

  const repaint = () => {
    Chart.forgetColours();
    figures.forEach(figure => figure.repaint());
  };
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", repaint);
  // Paper is white and narrower than most windows.
  addEventListener("beforeprint", () => {
    page.classList.add("printing");
    figures.forEach(figure => figure.resize(330));
    repaint();
  });
  addEventListener("afterprint", () => {
    page.classList.remove("printing");
    figures.forEach(figure => figure.resize());
    repaint();
  });

  Promise.all(figures.map(figure => figure.drawn)).then(() => {
    page.dataset.charts = String(figures.length);
    if (page.dataset.status === "loading") page.dataset.status = "ok";
  });
})();
