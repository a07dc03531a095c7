// SPDX-License-Identifier: GPL-3.0-or-later
"use strict";
// The artery in space. Viewer.show({...}) sets what is shown and draws at once; the address may hold the same
// after a #, as in report.html#still&part=wall&field=von_mises&time=0.25&cut=1, where "still" leaves out all but
// the picture. <html data-viewer> is "ok", or "missing" without WebGL.
const Viewer = (() => {
  const page = document.documentElement;
  const at = name => document.getElementById(`viewer-${name}`);
  const holder = document.getElementById("viewer"), canvas = holder.querySelector("canvas");
  const {element} = Chart;
  const context = canvas.getContext("webgl2", {antialias: true, alpha: true});
  if (!context) {
    page.dataset.viewer = "missing";
    at("missing").hidden = false;
    holder.remove();
    for (const tool of document.querySelectorAll(".viewer-tools")) tool.remove();
    return null;
  }

  // Numbers that the page holds as base64, decoded when they are first asked for.
  const bytes = text => {
    const raw = atob(text), made = new Uint8Array(raw.length);
    for (let k = 0; k < raw.length; ++k) made[k] = raw.charCodeAt(k);
    return made.buffer;
  };
  const codes = values => values.codes ??= values.bytes === 2 ? new Uint16Array(bytes(values.data)) : new Uint8Array(bytes(values.data));
  const valueAt = (values, index) => {
    const code = codes(values)[index];
    return code === (values.bytes === 2 ? 0xffff : 0xff) ? NaN : values.lowest + values.step * code;
  };

  const plainColours = {wall: [.80, .70, .64], blood: [.60, .13, .14]};
  const table = Shaders.table();
  const scene = new THREE.Scene();

  // One part of a run, in as many copies as its planes of symmetry ask for.
  class Body {
    constructor(part) {
      this.part = part;
      this.points = new Float32Array(bytes(part.points));
      this.places = new Int32Array(bytes(part.vertices));
      const count = this.places.length;
      const attribute = size => new THREE.BufferAttribute(new Float32Array(size * count), size);
      this.attributes = {position: attribute(3), normal: attribute(3), share: attribute(1), height: attribute(1)};
      this.places.forEach((place, vertex) => { this.attributes.height.array[vertex] = this.points[3 * place + 1]; });
      this.triangles = ["outer", "section"].map(name => new Uint32Array(bytes(part[name])));
      this.outerVertices = 1 + this.triangles[0].reduce((a, b) => Math.max(a, b), -1);
      this.uniforms = {
        table: {value: table}, plain: {value: new THREE.Vector3(...(plainColours[part.name] || [.7, .7, .7]))},
        cut: {value: part.cut}, coloured: {value: true}, open: {value: false}, shaded: {value: true},
      };
      const [outer, section] = this.triangles.map(triangles => {
        const geometry = new THREE.BufferGeometry();
        for (const [name, values] of Object.entries(this.attributes)) geometry.setAttribute(name, values);
        geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
        return geometry;
      });
      const signs = mirrored => mirrored ? [1, -1] : [1];
      const add = (geometry, x, y, side) => {
        // The blood's surface lies in that of the wall and gives way to it.
        const behind = part.name === "blood" ? 2 : 0;
        const mesh = new THREE.Mesh(geometry, new THREE.ShaderMaterial({
          uniforms: {...this.uniforms, side: {value: side}}, vertexShader: Shaders.vertex, fragmentShader: Shaders.fragment,
          side: THREE.DoubleSide, polygonOffset: behind > 0, polygonOffsetFactor: behind, polygonOffsetUnits: behind}));
        mesh.scale.set(x, y, 1);
        mesh.frustumCulled = false;
        scene.add(mesh);
        return mesh;
      };
      this.copies = signs(part.mirrored[0]).flatMap(x => signs(part.mirrored[1]).map(y => add(outer, x, y, y)));
      // Side 0: nothing of the section is cut away.
      this.sections = signs(part.mirrored[0]).map(x => add(section, x, 1, 0));
      // Nothing that only touches the cut from above may stay.
      this.uniforms.cut.value -= 1e-5 * Math.max(...this.box().map(Math.abs));
    }

    // Lowest x, y, z and highest x, y, z of the whole unloaded body.
    box() {
      const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
      this.points.forEach((value, index) => {
        const axis = index % 3;
        for (const sign of this.part.mirrored[axis] ? [1, -1] : [1]) {
          box[axis] = Math.min(box[axis], sign * value);
          box[axis + 3] = Math.max(box[axis + 3], sign * value);
        }
      });
      return box;
    }

    // A few hundred points of the whole unloaded body.
    outline() {
      const count = this.points.length / 3, step = Math.ceil(count / 500), found = [];
      for (let place = 0; place < count; place += step)
        for (const mesh of this.copies)
          found.push(new THREE.Vector3(...this.points.subarray(3 * place, 3 * place + 3)).multiply(mesh.scale));
      return found;
    }

    deform(frame, scale) {
      const {position, normal} = this.attributes, {displacement, mirrored} = this.part, count = this.points.length;
      const moved = displacement ? this.points.map((value, k) => value + scale * valueAt(displacement, frame * count + k)) : this.points;
      this.places.forEach((place, vertex) => { for (let k = 0; k < 3; ++k) position.array[3 * vertex + k] = moved[3 * place + k]; });
      const p = position.array, n = normal.array.fill(0);
      for (const triangles of this.triangles)
        for (let t = 0; t < triangles.length; t += 3) {
          const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
          const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
          const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
          const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
          for (const corner of [a, b, c]) { n[corner] += x; n[corner + 1] += y; n[corner + 2] += z; }
        }
      // On a plane of symmetry the other half's triangles count too, except for the section, which lies in it.
      for (let vertex = 0; vertex < this.outerVertices; ++vertex)
        for (let axis = 0; axis < 2; ++axis)
          if (mirrored[axis] && Math.abs(this.points[3 * this.places[vertex] + axis]) < 1e-6) n[3 * vertex + axis] = 0;
      position.needsUpdate = normal.needsUpdate = true;
    }

    colour(field, frame, lowest, highest) {
      const {share} = this.attributes, count = this.points.length / 3, width = highest - lowest;
      this.uniforms.coloured.value = Boolean(field);
      if (!field) return;
      this.places.forEach((place, vertex) => {
        const value = valueAt(field, frame * count + place);
        share.array[vertex] = Number.isNaN(value) ? -1 : width > 0 ? Math.min(1, Math.max(0, (value - lowest) / width)) : 0;
      });
      share.needsUpdate = true;
    }

    // The value that a field has where a ray meets the body, and how far that is; nothing where it meets none.
    meet(ray, field, frame) {
      const {height} = this.attributes, {open, cut} = this.uniforms, count = this.points.length / 3;
      for (const mesh of [...this.copies, ...this.sections]) mesh.geometry.boundingSphere = null;
      for (const hit of ray.intersectObjects([...this.copies, ...this.sections].filter(mesh => mesh.visible))) {
        const corners = [hit.face.a, hit.face.b, hit.face.c], weights = hit.barycoord.toArray();
        const mean = at => corners.reduce((sum, vertex, k) => sum + weights[k] * at(vertex), 0);
        const isCutAway = open.value && this.copies.includes(hit.object) && hit.object.scale.y * mean(vertex => height.array[vertex]) > cut.value;
        if (!isCutAway) return {distance: hit.distance, value: field ? mean(vertex => valueAt(field, frame * count + this.places[vertex])) : NaN};
      }
      return null;
    }

    show(shown, open, shaded) {
      this.uniforms.open.value = open;
      this.uniforms.shaded.value = shaded;
      for (const mesh of this.copies) mesh.visible = shown;
      for (const mesh of this.sections) mesh.visible = shown && open;
    }

    dispose() {
      for (const mesh of [...this.copies, ...this.sections]) {
        scene.remove(mesh);
        mesh.geometry.dispose();
        mesh.material.dispose();
      }
    }
  }

  const runs = JSON.parse(document.getElementById("scene").textContent).runs;
  const renderer = new THREE.WebGLRenderer({canvas, context, antialias: true, alpha: true});
  const view = ViewerCamera(canvas, () => ask());
  // lowest and highest are typed limits, which the field has that they were typed for.
  const state = {run: 0, part: "", field: "", time: 0, cut: false, scale: 1, shaded: true, range: "all", lowest: NaN, highest: NaN};
  let bodies = [], frame = -1, playing = 0, waiting = 0;

  const ask = () => { waiting ||= requestAnimationFrame(draw); };
  function draw() {
    cancelAnimationFrame(waiting);
    waiting = 0;
    view.prepare();
    renderer.render(scene, view.camera);
  }

  const partNames = () => runs[state.run].parts.map(part => part.name);
  const fieldsOf = name => runs[state.run].parts.find(part => part.name === name)?.fields || [];
  const isShown = name => state.part === "both" || state.part === name;
  // The part that is coloured, and its field; "wall/von_mises" in the list.
  const chosen = () => {
    const [part, name] = [state.field.slice(0, state.field.indexOf("/")), state.field.slice(state.field.indexOf("/") + 1)];
    return {part, field: fieldsOf(part).find(field => field.name === name)};
  };
  // Of all times and all runs, so that a colour is the same number everywhere; `of` may be this run's alone.
  const rangeOf = (part, name, key, of = runs) => {
    const ranges = of.flatMap(run => run.parts.filter(one => one.name === part)
      .flatMap(one => one.fields.filter(field => field.name === name).map(field => field[key])));
    return [Math.min(...ranges.map(range => range[0])), Math.max(...ranges.map(range => range[1]))];
  };
  const rangeAt = (field, frame) => {
    const count = codes(field).length / runs[state.run].times.length;
    let lowest = Infinity, highest = -Infinity;
    for (let place = 0; place < count; ++place) {
      const value = valueAt(field, frame * count + place);
      if (value < lowest) lowest = value;
      if (value > highest) highest = value;
    }
    return lowest <= highest ? [lowest, highest] : [0, 1];
  };
  const isTyped = () => state.range === "typed" && state.lowest < state.highest;
  // The ends of the colours, and of the values that are there to be coloured.
  function ranges() {
    const {part, field} = chosen();
    if (!field) return {colours: [0, 1], whole: [0, 1]};
    if (state.range === "time") return {colours: rangeAt(field, frame), whole: rangeAt(field, frame)};
    const of = state.range === "run" ? [runs[state.run]] : runs;
    return {colours: isTyped() ? [state.lowest, state.highest] : rangeOf(part, field.name, "colours", of),
            whole: rangeOf(part, field.name, "range", of)};
  }
  const text = (value, width) => Math.abs(value) < 1e-6 * width ? "0" : Number(value.toPrecision(3)).toString().replace("-", "\u2212");

  // "1.011 s, 0.211 s in the beat"
  const timeText = () => {
    const {beat} = runs[state.run], within = beat ? state.time - beat[0] : -1;
    return `${state.time.toFixed(3)} s${beat && beat[0] > 0 && within > -1e-9 ? `, ${Math.max(0, within).toFixed(3)} s in the last beat` : ""}`;
  };

  function label() {
    const {part, field} = chosen();
    if (!field) return;
    const {colours: [lowest, highest], whole} = ranges();
    const title = `${field.label} in the ${part}${field.unit ? `, ${field.unit}` : ""}${field.has_gaps ? " (grey: none)" : ""}`;
    const ticks = [0, .25, .5, .75, 1].map(share => text(lowest + share * (highest - lowest), highest - lowest));
    if (whole[0] < lowest) ticks[0] = `\u2264 ${ticks[0]}`;
    if (whole[1] > highest) ticks[4] = `\u2265 ${ticks[4]}`;
    at("quantity").textContent = title;
    at("ticks").replaceChildren(...ticks.map(tick => element("span", {}, tick)));
    at("legend").setAttribute("aria-label", `Colours: ${title}, from ${ticks[0]} to ${ticks[4]}`);
    const clock = `t = ${timeText()}${state.scale === 1 ? "" : `, displacement × ${state.scale}`}`;
    at("clock").textContent = clock;
    canvas.setAttribute("aria-label", `The artery in space, ${state.part}${state.cut ? ", cut open" : ""}, ${clock}, coloured by ${title}`);
  }

  // What the picture's colour is worth at the pointer.
  const ray = new THREE.Raycaster();
  function read(event) {
    const box = canvas.getBoundingClientRect(), {part, field} = chosen();
    ray.setFromCamera(new THREE.Vector2(2 * (event.clientX - box.left) / box.width - 1, 1 - 2 * (event.clientY - box.top) / box.height), view.camera);
    const hits = bodies.filter(body => isShown(body.part.name)).map(body => ({name: body.part.name, ...body.meet(ray, body.part.name === part ? field : null, frame)}))
      .filter(hit => hit.distance !== undefined).sort((a, b) => a.distance - b.distance);
    const value = hits.length && hits[0].name === part ? hits[0].value : NaN;
    at("pointer").textContent = Number.isNaN(value) ? "" : `${field.label} ${text(value, 0)}${field.unit ? ` ${field.unit}` : ""}`;
  }

  function fill(select, options, value) {
    select.replaceChildren(...options);
    select.value = value;
  }

  // A run without a stored time near its peak flow, or without flow, has none.
  const peakOf = run => {
    if (!Number.isFinite(run.peak)) return null;
    const closest = run.times.reduce((best, time) => Math.abs(time - run.peak) < Math.abs(best - run.peak) ? time : best);
    return Math.abs(closest - run.peak) <= .01 * run.beat[1] ? closest : null;
  };

  function changeRun() {
    for (const body of bodies) body.dispose();
    bodies = runs[state.run].parts.map(part => new Body(part));
    const names = partNames();
    const choices = names.length > 1 ? [...names, "both"] : names;
    if (!choices.includes(state.part)) state.part = names.includes("wall") ? "wall" : names[0];
    if (!chosen().field) state.field = `${names.includes(state.part) ? state.part : names[0]}/displacement`;
    at("parts").hidden = choices.length < 2;
    at("parts").replaceChildren(at("parts").querySelector("legend"), ...choices.map(name => {
      const radio = element("input", {type: "radio", name: "viewer-part", value: name});
      radio.addEventListener("change", () => show({part: name}));
      return element("label", {}, radio, name[0].toUpperCase() + name.slice(1));
    }));
    fill(at("field"), names.map(name => {
      const group = element("optgroup", {label: name[0].toUpperCase() + name.slice(1)});
      group.append(...fieldsOf(name).map(field => element("option", {value: `${name}/${field.name}`}, field.label)));
      return group;
    }), state.field);
    at("time").max = runs[state.run].times.length - 1;
    at("peak").hidden = peakOf(runs[state.run]) === null;
    const boxes = bodies.map(body => body.box());
    view.frame(bodies.flatMap(body => body.outline()), [0, 1, 2, 3, 4, 5].map(k => Math[k < 3 ? "min" : "max"](...boxes.map(box => box[k]))));
  }

  // The stored time that is closest.
  const frameAt = time => runs[state.run].times.reduce((best, one, index, all) =>
    Math.abs(one - time) < Math.abs(all[best] - time) ? index : best, 0);

  function show(wanted = {}) {
    const before = {...state};
    Object.assign(state, wanted);
    state.run = Math.min(runs.length - 1, Math.max(0, state.run));
    if (wanted.field && !wanted.field.includes("/"))
      state.field = `${[state.part, ...partNames()].find(name => fieldsOf(name).some(field => field.name === wanted.field))}/${wanted.field}`;
    if (!["both", ...partNames()].includes(state.part)) state.part = before.part;
    if (!chosen().field) state.field = before.field;
    if (!bodies.length || state.run !== before.run) changeRun();
    // What is coloured is shown.
    if (!isShown(chosen().part)) {
      if (wanted.part) state.field = `${state.part}/${(fieldsOf(state.part).find(field => field.name === chosen().field?.name) || fieldsOf(state.part)[0]).name}`;
      else state.part = chosen().part;
    }
    frame = frameAt(state.time);
    state.time = runs[state.run].times[frame];
    const {part, field} = chosen();
    if (state.field !== before.field && wanted.lowest === undefined) {
      // Limits mean nothing for another field.
      state.lowest = state.highest = NaN;
      if (state.range === "typed") state.range = "all";
    }
    // Typing begins with the limits that are shown.
    if (state.range === "typed" && Number.isNaN(state.lowest) && Number.isNaN(state.highest)) {
      state.range = before.range === "typed" ? "all" : before.range;
      [state.lowest, state.highest] = ranges().colours;
      state.range = "typed";
    }
    const {colours: range} = ranges();
    for (const body of bodies) {
      body.show(isShown(body.part.name), state.cut, state.shaded);
      body.deform(frame, state.scale);
      body.colour(body.part.name === part ? field : null, frame, ...range);
    }
    at("run").value = String(state.run);
    at("field").value = state.field;
    at("range").value = state.range;
    at("limits").hidden = state.range !== "typed";
    for (const name of ["lowest", "highest"]) {
      if (document.activeElement !== at(name)) at(name).value = Number.isNaN(state[name]) ? "" : String(Number(state[name].toPrecision(4)));
      at(name).setAttribute("aria-invalid", String(state.range === "typed" && !isTyped()));
    }
    at("cut").checked = state.cut;
    at("scale").value = String(state.scale);
    at("scale-shown").textContent = String(state.scale);
    at("time").value = String(frame);
    at("time").setAttribute("aria-valuetext", timeText());
    at("time-shown").textContent = timeText();
    const radio = at("parts").querySelector(`input[value="${state.part}"]`);
    if (radio) radio.checked = true;
    at("pointer").textContent = "";
    label();
    draw();
  }

  function play(on) {
    clearInterval(playing);
    playing = on ? setInterval(() => {
      const {times} = runs[state.run];
      show({time: times[(frame + 1) % times.length]});
    }, 100) : 0;
    at("play").setAttribute("aria-pressed", String(on));
    at("play").textContent = on ? "Pause" : "Play";
  }

  fill(at("run"), runs.map((run, index) => element("option", {value: index}, run.label)), "0");
  at("runs").hidden = runs.length < 2;
  if (runs.length < 2) {
    at("range").querySelector("[value=run]").remove();
    at("range").querySelector("[value=all]").textContent = "all times";
  }
  at("run").addEventListener("change", event => show({run: Number(event.target.value)}));
  at("field").addEventListener("change", event => show({field: event.target.value}));
  at("range").addEventListener("change", event => show({range: event.target.value}));
  for (const name of ["lowest", "highest"])
    at(name).addEventListener("input", event => show({range: "typed", [name]: event.target.value === "" ? NaN : Number(event.target.value)}));
  at("cut").addEventListener("change", event => show({cut: event.target.checked}));
  at("scale").addEventListener("input", event => show({scale: Number(event.target.value)}));
  at("time").addEventListener("input", event => { play(false); show({time: runs[state.run].times[event.target.value]}); });
  at("play").addEventListener("click", () => play(!playing));
  at("peak").addEventListener("click", () => { play(false); show({time: peakOf(runs[state.run])}); });
  at("home").addEventListener("click", () => view.home());
  canvas.addEventListener("pointermove", event => { if (!event.buttons) read(event); });
  canvas.addEventListener("pointerleave", () => { at("pointer").textContent = ""; });
  at("bar").style.background = Shaders.gradient;

  const address = new URLSearchParams(location.hash.slice(1));
  if (address.has("still")) page.classList.add("still");
  const asked = {};
  for (const [key, value] of address)
    if (["run", "time", "scale", "lowest", "highest"].includes(key) && Number.isFinite(Number(value))) asked[key] = Number(value);
    else if (["cut", "shaded"].includes(key)) asked[key] = value !== "0";
    else if (["part", "field"].includes(key)) asked[key] = value;
    else if (key === "range" && ["all", "run", "time", "typed"].includes(value)) asked.range = value;
  if (asked.lowest < asked.highest) asked.range = "typed";
  const resize = () => {
    const {clientWidth: width, clientHeight: height} = holder;
    renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    renderer.setSize(width, height, false);
    view.resize(width / Math.max(1, height));
    draw();
  };
  new ResizeObserver(resize).observe(holder);
  addEventListener("beforeprint", draw);
  // The picture begins at peak flow, as the paper's do, or else where the displacement is largest.
  const largest = run => {
    const values = (run.parts.find(part => part.name === "wall") || run.parts[0]).fields.find(field => field.name === "displacement");
    if (!values) return 0;
    const all = codes(values), count = all.length / run.times.length;
    const sums = run.times.map((_, k) => all.subarray(k * count, (k + 1) * count).reduce((sum, code) => sum + code, 0));
    return run.times[sums.indexOf(Math.max(...sums))];
  };
  state.time = peakOf(runs[0]) ?? largest(runs[0]);
  show(asked);
  view.look(address);
  resize();
  page.dataset.viewer = "ok";
  return {show, state, view, canvas, colourAt: Shaders.colourAt, rangeOf};
})();
