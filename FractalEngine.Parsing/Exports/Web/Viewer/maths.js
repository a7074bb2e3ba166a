// Affine maps are 12 numbers by rows: three rows of a matrix, each with its part of the translation.

// Writes the product of two maps: the second one, at an offset of its array, is applied first.
function compose(target, at, a, aAt, b, bAt) {
  for (let row = 0; row < 12; row += 4) {
    const x = a[aAt + row], y = a[aAt + row + 1], z = a[aAt + row + 2];
    target[at + row] = x * b[bAt] + y * b[bAt + 4] + z * b[bAt + 8];
    target[at + row + 1] = x * b[bAt + 1] + y * b[bAt + 5] + z * b[bAt + 9];
    target[at + row + 2] = x * b[bAt + 2] + y * b[bAt + 6] + z * b[bAt + 10];
    target[at + row + 3] = x * b[bAt + 3] + y * b[bAt + 7] + z * b[bAt + 11] + a[aAt + row + 3];
  }
}

function invert(m) {
  const [a, b, c, x, d, e, f, y, g, h, i, z] = m;
  const A = e * i - f * h, B = f * g - d * i, C = d * h - e * g, det = a * A + b * B + c * C;
  const r = [A, c * h - b * i, b * f - c * e, 0, B, a * i - c * g, c * d - a * f, 0, C, b * g - a * h, a * e - b * d, 0].map(v => v / det);
  for (let row = 0; row < 12; row += 4) r[row + 3] = -(r[row] * x + r[row + 1] * y + r[row + 2] * z);
  return r;
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const add = (a, b, factor = 1) => [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]];
const subtract = (a, b) => add(a, b, -1);
const scale = (a, factor) => [a[0] * factor, a[1] * factor, a[2] * factor];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = a => Math.hypot(a[0], a[1], a[2]);
const unit = a => scale(a, 1 / (length(a) || 1));
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

// A vector turned about a unit axis (Rodrigues' formula).
function turn(v, axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return add(add(scale(v, c), cross(axis, v), s), axis, dot(axis, v) * (1 - c));
}

// Three axes with the third one in a direction.
function axesAlong(forward) {
  const right = unit(cross(Math.abs(forward[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0], forward));
  return [right, cross(forward, right), forward];
}

// What the page keeps as differences, as numbers again.
function sums(differences, components, origin, step) {
  const result = new Float32Array(differences.length), last = new Float64Array(components);
  for (let i = 0; i < differences.length; i++) {
    const k = i % components;
    last[k] += differences[i];
    result[i] = origin[k] + step[k] * last[k];
  }
  return result;
}
