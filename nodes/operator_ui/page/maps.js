// The robot's maps as pictures: mean reward as colour, cells where the target cannot go as hatching.

const RAMP = [[0.267, 0.125, 0.427], [0.283, 0.302, 0.545], [0.196, 0.475, 0.557], [0.184, 0.63, 0.49], [0.52, 0.77, 0.31], [0.993, 0.91, 0.36]];

/** Colour of a value from 0 to 1: dark violet over green to bright yellow, readable without colour vision. */
export function colour(t) {
  const x = Math.min(0.999999, Math.max(0, t)) * (RAMP.length - 1), i = Math.floor(x), f = x - i;
  return [0, 1, 2].map((c) => Math.round(255 * (RAMP[i][c] * (1 - f) + RAMP[i + 1][c] * f)));
}

/** Smallest and largest of the finite values; null when there are none. */
export function range(values) {
  let low = Infinity, high = -Infinity;
  for (const v of values) if (v !== null) { low = Math.min(low, v); high = Math.max(high, v); }
  return low <= high ? [low, high] : null;
}

function canvas(side) {
  const c = document.createElement("canvas");
  c.width = c.height = side;
  return c;
}

/** The reward map as a data URL, top row farthest from the robot; null without a map. */
export function rewardPicture(plan) {
  const n = plan.map_side, span = n && range(plan.reward_map);
  if (!span) return null;
  const c = canvas(n), context = c.getContext("2d"), image = context.createImageData(n, n);
  for (let j = 0; j < n; j++) for (let i = 0; i < n; i++) {
    const v = plan.reward_map[j * n + i], at = 4 * ((n - 1 - j) * n + i);
    if (v === null) continue;
    image.data.set([...colour((v - span[0]) / (span[1] - span[0] || 1)), 255], at);
  }
  context.putImageData(image, 0, 0);
  return c.toDataURL();
}

/** Hatching over occupied spots (1, one way) and unreachable ones (2, the other way, denser), as a data URL. */
export function shadePicture(stateAt, dark) {
  const coarse = 384, size = 768, c = canvas(size), context = c.getContext("2d"), image = context.createImageData(size, size);
  const states = new Uint8Array(coarse * coarse);
  for (let j = 0; j < coarse; j++) for (let i = 0; i < coarse; i++) states[j * coarse + i] = stateAt((i + 0.5) / coarse, (j + 0.5) / coarse);
  const styles = dark ? [null, [255, 140, 110, 14, 74, 14], [175, 185, 215, 22, 96, 10]] : [null, [165, 60, 30, 10, 58, 14], [55, 65, 95, 20, 78, 10]];
  for (let y = 0; y < size; y++) for (let x = 0; x < size; x++) {
    const state = states[((size - 1 - y) >> 1) * coarse + (x >> 1)];
    if (!state) continue;
    const [r, g, b, low, high, step] = styles[state];
    const across = state === 1 ? (x + y) % step : (x + size - y) % step;
    const line = Math.max(0, 1 - Math.abs(across - step / 2) / 1.6);
    image.data.set([r, g, b, low + line * (high - low)], 4 * (y * size + x));
  }
  context.putImageData(image, 0, 0);
  return c.toDataURL();
}
