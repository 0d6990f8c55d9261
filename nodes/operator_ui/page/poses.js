// Poses as x, y, z and a unit quaternion x, y, z, w, and the matrices of a camera, column by column as WebGL takes them.

function rotate([x, y, z, w], v) {
  const t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])];
  return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2], v[2] + w * t[2] + x * t[1] - y * t[0]];
}

/** A point of the pose's own frame in the frame that the pose is given in. */
export function along(pose, point) {
  const turned = rotate(pose.slice(3), point);
  return [0, 1, 2].map((k) => pose[k] + turned[k]);
}

/** First b, then a. */
export function multiply(a, b) {
  const [ax, ay, az, aw] = a.slice(3), [bx, by, bz, bw] = b.slice(3);
  return [...along(a, b), aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz];
}

export function inverse(pose) {
  const back = [-pose[3], -pose[4], -pose[5], pose[6]];
  return [...rotate(back, pose.slice(0, 3).map((v) => -v)), ...back];
}

/** The quaternion of a turn about the vertical. */
export const turned = (yaw_rad) => [0, 0, Math.sin(yaw_rad / 2), Math.cos(yaw_rad / 2)];

export function matrix(pose) {
  const columns = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => [...rotate(pose.slice(3), axis), 0]);
  return [...columns.flat(), pose[0], pose[1], pose[2], 1];
}

/** The product of two matrices. */
export function times(a, b) {
  const out = new Array(16);
  for (let column = 0; column < 4; column++) for (let row = 0; row < 4; row++) out[4 * column + row] = [0, 1, 2, 3].reduce((sum, k) => sum + a[4 * k + row] * b[4 * column + k], 0);
  return out;
}

export function perspective(field_rad, aspect, near, far) {
  const f = 1 / Math.tan(field_rad / 2);
  // A tall picture keeps the field across instead of the field upright.
  const [x, y] = aspect < 1 ? [f, f * aspect] : [f / aspect, f];
  return [x, 0, 0, 0, 0, y, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0];
}

/** The camera at `eye`, looking at `middle`, with z upwards. */
export function look(eye, middle) {
  const unit = (v) => { const n = Math.hypot(...v) || 1; return v.map((x) => x / n); }, cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]], dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const back = unit(eye.map((v, k) => v - middle[k])), right = unit(cross([0, 0, 1], back)), up = cross(back, right);
  return [right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0, -dot(right, eye), -dot(up, eye), -dot(back, eye), 1];
}
