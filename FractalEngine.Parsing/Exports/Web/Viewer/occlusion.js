// How near the closest surface is at the middle of each pixel, to skip what that hides. Nearness is affine on the screen: 1 / depth in
// perspective, the negative depth otherwise.
class OcclusionBuffer {
  constructor(width, height) {
    this.width = width;
    this.height = height;
    this.near = new Float32Array(width * height);
    this.columns = width + 7 >> 3;
    this.tiles = new Float32Array(this.columns * (height + 7 >> 3));
    this.isStale = new Uint8Array(this.tiles.length);
  }

  clear() {
    this.near.fill(-Infinity);
    this.tiles.fill(-Infinity);
    this.isStale.fill(0);
  }

  // Whether all pixels of a rectangle show something nearer.
  hides(left, bottom, right, top, nearness) {
    const x0 = Math.max(0, Math.floor(left)), y0 = Math.max(0, Math.floor(bottom));
    const x1 = Math.min(this.width - 1, Math.floor(right)), y1 = Math.min(this.height - 1, Math.floor(top));
    for (let row = y0 >> 3; row <= y1 >> 3; row++) {
      for (let column = x0 >> 3; column <= x1 >> 3; column++) {
        const tile = row * this.columns + column;
        if (this.isStale[tile]) this.refresh(tile, column, row);
        if (this.tiles[tile] > nearness) continue;
        const endX = Math.min(x1, 8 * column + 7), endY = Math.min(y1, 8 * row + 7);
        for (let y = Math.max(y0, 8 * row); y <= endY; y++) {
          for (let x = Math.max(x0, 8 * column); x <= endX; x++) {
            if (!(this.near[y * this.width + x] > nearness)) return false;
          }
        }
      }
    }
    return true;
  }

  refresh(tile, column, row) {
    let least = Infinity;
    for (let y = 8 * row; y < Math.min(this.height, 8 * row + 8); y++) {
      for (let x = 8 * column; x < Math.min(this.width, 8 * column + 8); x++) {
        least = Math.min(least, this.near[y * this.width + x]);
      }
    }
    this.tiles[tile] = least;
    this.isStale[tile] = 0;
  }

  // Draws a triangle whose corners are at offsets of an array: x, y and nearness each.
  draw(v, a, b, c) {
    const ax = v[a], ay = v[a + 1], bx = v[b] - ax, by = v[b + 1] - ay, cx = v[c] - ax, cy = v[c + 1] - ay;
    const area = bx * cy - by * cx;
    if (area === 0) return;
    const x0 = Math.max(0, Math.ceil(ax + Math.min(0, bx, cx) - 0.5)), y0 = Math.max(0, Math.ceil(ay + Math.min(0, by, cy) - 0.5));
    const x1 = Math.min(this.width - 1, Math.floor(ax + Math.max(0, bx, cx) - 0.5));
    const y1 = Math.min(this.height - 1, Math.floor(ay + Math.max(0, by, cy) - 0.5));
    const db = v[b + 2] - v[a + 2], dc = v[c + 2] - v[a + 2];
    for (let y = y0; y <= y1; y++) {
      const py = y + 0.5 - ay;
      for (let x = x0; x <= x1; x++) {
        const px = x + 0.5 - ax, s = (px * cy - py * cx) / area, t = (bx * py - by * px) / area;
        if (s >= 0 && t >= 0 && s + t <= 1) {
          const near = v[a + 2] + s * db + t * dc, i = y * this.width + x;
          if (near > this.near[i]) {
            this.near[i] = near;
            this.isStale[(y >> 3) * this.columns + (x >> 3)] = 1;
          }
        }
      }
    }
  }
}
