// SPDX-License-Identifier: GPL-3.0-or-later
"use strict";
// How the viewer colours a surface: a scalar by a table of colours, or plain, under a light that goes with the
// camera, so that shape shows from every side.
const Shaders = (() => {
  // Viridis by S. van der Walt and N. Smith (matplotlib, CC0), every 17th of its 256 colours; between them it
  // is close to linear. Its lightness grows evenly, also for the colour-blind.
  const viridis = ["440154", "481a6c", "472f7d", "414487", "39568c", "31688e", "2a788e", "23888e", "1f988b", "22a884",
                   "35b779", "54c568", "7ad151", "a5db36", "d2e21b", "fde725"];
  const stops = viridis.map(text => [0, 2, 4].map(at => parseInt(text.slice(at, at + 2), 16)));

  // Red, green and blue, 0 to 255, of a value between 0 and 1.
  function colourAt(share) {
    const at = Math.min(1, Math.max(0, share)) * (stops.length - 1), low = Math.min(stops.length - 2, Math.floor(at));
    return stops[low].map((from, k) => Math.round(from + (at - low) * (stops[low + 1][k] - from)));
  }
  const gradient = `linear-gradient(to right, ${viridis.map(text => `#${text}`).join(", ")})`;

  const vertex = `
    attribute float share, height;
    varying float vShare, vHeight;
    varying vec3 vNormal, vEye;
    void main() {
      vec4 seen = modelViewMatrix * vec4(position, 1.0);
      vShare = share;
      vHeight = height;
      vNormal = normalMatrix * normal;
      vEye = -seen.xyz;
      gl_Position = projectionMatrix * seen;
    }`;
  // share < 0 stands for no value. A body cut open lacks what lies above the cut when it is unloaded.
  const fragment = `
    uniform sampler2D table;
    uniform vec3 plain;
    uniform float side, cut;
    uniform bool coloured, open, shaded;
    varying float vShare, vHeight;
    varying vec3 vNormal, vEye;
    void main() {
      if (open && side != 0.0 && side * vHeight > cut) discard;
      vec3 colour = plain;
      if (coloured)
        colour = vShare < -0.01 ? vec3(0.62) : texture2D(table, vec2((clamp(vShare, 0.0, 1.0) * 255.0 + 0.5) / 256.0, 0.5)).rgb;
      if (shaded) {
        vec3 normal = normalize(vNormal) * (gl_FrontFacing ? 1.0 : -1.0);
        vec3 eye = normalize(vEye), light = normalize(vec3(-0.30, 0.50, 0.85));
        float lit = max(dot(normal, light), 0.0), fill = max(dot(normal, normalize(vec3(0.8, -0.5, 0.6))), 0.0);
        float gloss = pow(max(dot(normal, normalize(light + eye)), 0.0), 40.0);
        colour = colour * (0.38 + 0.60 * lit + 0.22 * fill) + 0.12 * gloss;
      }
      gl_FragColor = vec4(colour, 1.0);
    }`;

  function table() {
    const pixels = new Uint8Array(4 * 256);
    for (let at = 0; at < 256; ++at) pixels.set([...colourAt(at / 255), 255], 4 * at);
    const texture = new THREE.DataTexture(pixels, 256, 1);
    texture.minFilter = texture.magFilter = THREE.LinearFilter;
    texture.needsUpdate = true;
    return texture;
  }

  return {colourAt, gradient, vertex, fragment, table};
})();
