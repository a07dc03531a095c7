// SPDX-License-Identifier: GPL-3.0-or-later
"use strict";
// A camera that goes around the vessel by mouse, touch and keys. Lengthwise lies the vessel's longest side, and
// the camera begins on the side that a cut opens, at larger y.
function ViewerCamera(canvas, changed) {
  const camera = new THREE.PerspectiveCamera(25);
  let controls = null, box = null, points = null, moved = false;
  const start = {azimuth: -20, elevation: 20, zoom: 1};  // degrees

  const axes = () => {
    const size = [0, 1, 2].map(k => box[k + 3] - box[k]);
    const along = size.indexOf(Math.max(...size)), towards = along === 1 ? 0 : 1;
    const unit = k => new THREE.Vector3(...[0, 1, 2].map(axis => Number(axis === k)));
    const right = unit(along), back = unit(towards);
    return {right, back, up: back.clone().cross(right)};
  };
  // Sets the camera so far away that all points are seen, and so that they fill the picture.
  function home() {
    const {right, back, up} = axes(), radians = Math.PI / 180;
    const azimuth = start.azimuth * radians, elevation = start.elevation * radians;
    const to = back.clone().multiplyScalar(Math.cos(azimuth)).addScaledVector(right, Math.sin(azimuth))
      .multiplyScalar(Math.cos(elevation)).addScaledVector(up, Math.sin(elevation));
    const across = up.clone().cross(to).normalize(), above = to.clone().cross(across);
    const target = new THREE.Vector3(), half = Math.tan(camera.fov * radians / 2);
    for (const direction of [across, above, to]) {
      let least = Infinity, greatest = -Infinity;
      for (const point of points) {
        least = Math.min(least, point.dot(direction));
        greatest = Math.max(greatest, point.dot(direction));
      }
      target.addScaledVector(direction, (least + greatest) / 2);
    }
    let distance = 0;
    for (const point of points) {
      const from = point.clone().sub(target);
      distance = Math.max(distance, from.dot(to) + Math.max(Math.abs(from.dot(across)) / camera.aspect, Math.abs(from.dot(above))) / half);
    }
    // Below is the legend.
    target.addScaledVector(above, -.06 * distance * half);
    controls.target.copy(target);
    camera.position.copy(target).addScaledVector(to, 1.22 * distance / start.zoom);
    controls.update();
    moved = false;
    changed();
  }
  // Shows a vessel: points of its surface, and the box they fill, lowest x, y, z and highest.
  function frame(its, wanted) {
    points = its;
    box = wanted;
    controls?.dispose();
    camera.up.copy(axes().up);
    controls = new THREE.OrbitControls(camera, canvas);
    controls.enableZoom = document.activeElement === canvas;
    controls.addEventListener("change", () => changed());
    controls.addEventListener("start", () => { moved = true; });
    home();
  }
  // A page with a picture that takes the wheel cannot be scrolled past: it does so when it has been clicked.
  canvas.addEventListener("focus", () => { controls.enableZoom = true; });
  canvas.addEventListener("blur", () => { controls.enableZoom = false; });
  canvas.addEventListener("keydown", event => {
    const step = {ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (step && event.shiftKey) controls.pan(40 * step[0], 40 * step[1]);
    else if (step) { controls.rotateLeft(-.1 * step[0]); controls.rotateUp(-.1 * step[1]); }
    else if (event.key === "+" || event.key === "=") controls.dollyIn(1.1);
    else if (event.key === "-" || event.key === "\u2212") controls.dollyOut(1.1);
    else if (event.key === "0") home();
    else return;
    event.preventDefault();
    if (event.key !== "0") moved = true;
    controls.update();
    changed();
  });

  return {
    camera, frame, home,
    resize(aspect) {
      camera.aspect = aspect;
      camera.updateProjectionMatrix();
      if (!moved) home();
    },
    // Near and far around the vessel, for a fine depth buffer.
    prepare() {
      const radius = Math.hypot(...[0, 1, 2].map(k => box[k + 3] - box[k]));
      const distance = camera.position.distanceTo(controls.target);
      camera.near = Math.max(distance - 2 * radius, .01 * distance);
      camera.far = distance + 2 * radius;
      camera.updateProjectionMatrix();
    },
    // From an address: azimuth and elevation in degrees, zoom.
    look(address) {
      for (const key of Object.keys(start)) {
        const value = Number(address.get(key));
        if (address.has(key) && Number.isFinite(value) && (key !== "zoom" || value > 0)) start[key] = value;
      }
      home();
    },
  };
}
