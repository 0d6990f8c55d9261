// Solids as triangles: six numbers a corner, its place and the normal there.

const ROUND = 36;

/** A cube of side 1 about the origin. */
export function box() {
  const out = [];
  for (const axis of [0, 1, 2]) for (const side of [-1, 1]) {
    const u = (axis + 1) % 3, v = (axis + 2) % 3, normal = [0, 0, 0];
    normal[axis] = side;
    const corner = (a, b) => { const at = [0, 0, 0]; at[axis] = side / 2; at[u] = a / 2; at[v] = (b * side) / 2; return [...at, ...normal]; };
    out.push(...corner(-1, -1), ...corner(1, -1), ...corner(1, 1), ...corner(-1, -1), ...corner(1, 1), ...corner(-1, 1));
  }
  return new Float32Array(out);
}

/** Radius 1 and length 1 along z, about the origin. */
export function cylinder() {
  const out = [], at = (i) => [Math.cos((2 * Math.PI * i) / ROUND), Math.sin((2 * Math.PI * i) / ROUND)];
  for (let i = 0; i < ROUND; i++) {
    const [a, b] = [at(i), at(i + 1)], side = (p, z) => [p[0], p[1], z, p[0], p[1], 0];
    out.push(...side(a, -0.5), ...side(b, -0.5), ...side(b, 0.5), ...side(a, -0.5), ...side(b, 0.5), ...side(a, 0.5));
    for (const z of [-1, 1]) out.push(0, 0, z / 2, 0, 0, z, ...(z > 0 ? [a, b] : [b, a]).flatMap((p) => [p[0], p[1], z / 2, 0, 0, z]));
  }
  return new Float32Array(out);
}

/** Radius 1 about the origin. */
export function sphere() {
  const out = [], rows = ROUND / 2, at = (i, j) => {
    const polar = (Math.PI * j) / rows, turn = (2 * Math.PI * i) / ROUND, p = [Math.sin(polar) * Math.cos(turn), Math.sin(polar) * Math.sin(turn), Math.cos(polar)];
    return [...p, ...p];
  };
  for (let i = 0; i < ROUND; i++) for (let j = 0; j < rows; j++) out.push(...at(i, j), ...at(i, j + 1), ...at(i + 1, j + 1), ...at(i, j), ...at(i + 1, j + 1), ...at(i + 1, j));
  return new Float32Array(out);
}

/** Triangles between points, each with the normal of its own plane. */
export function flat(points, triangles) {
  const out = new Float32Array(6 * triangles.length), corner = (i) => points.slice(3 * triangles[i], 3 * triangles[i] + 3);
  for (let i = 0; i + 2 < triangles.length; i += 3) {
    const [a, b, c] = [corner(i), corner(i + 1), corner(i + 2)], u = b.map((v, k) => v - a[k]), v = c.map((w, k) => w - a[k]);
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]], length = Math.hypot(...n) || 1;
    [a, b, c].forEach((p, k) => out.set([...p, ...n.map((x) => x / length)], 6 * (i + k)));
  }
  return out;
}

/** A tube along a way of points, at most 240 of them. */
export function tube(way, radius) {
  const n = way.length / 3, step = Math.max(1, Math.ceil(n / 240)), points = [], out = [], sides = 8;
  for (let i = 0; i < n; i += step) points.push(way.slice(3 * i, 3 * i + 3));
  points.push(way.slice(-3));
  const rings = points.map((p, i) => {
    const from = points[Math.max(0, i - 1)], to = points[Math.min(points.length - 1, i + 1)], d = to.map((v, k) => v - from[k]), length = Math.hypot(...d) || 1, t = d.map((v) => v / length);
    const aside = Math.abs(t[2]) < 0.9 ? [-t[1], t[0], 0] : [0, -t[2], t[1]], norm = Math.hypot(...aside) || 1, u = aside.map((v) => v / norm), v = [t[1] * u[2] - t[2] * u[1], t[2] * u[0] - t[0] * u[2], t[0] * u[1] - t[1] * u[0]];
    return Array.from({ length: sides + 1 }, (_, j) => { const a = (2 * Math.PI * j) / sides, normal = u.map((x, k) => Math.cos(a) * x + Math.sin(a) * v[k]); return [...normal.map((x, k) => p[k] + radius * x), ...normal]; });
  });
  for (let i = 0; i + 1 < rings.length; i++) for (let j = 0; j < sides; j++) out.push(...rings[i][j], ...rings[i + 1][j], ...rings[i + 1][j + 1], ...rings[i][j], ...rings[i + 1][j + 1], ...rings[i][j + 1]);
  return new Float32Array(out);
}
