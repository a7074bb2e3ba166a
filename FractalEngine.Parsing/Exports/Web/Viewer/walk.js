const FRAME = 32, LEVEL = 12, SIZE = 13, RECT = 14, NEAR = 18, FAR = 19, PIXELS = 20, COUNT = 21, PART = 22, WEIGHT = 23, APPROACH = 24;
const DEPTH = 25, TINT = 26;
const INSTANCE = 20, ROW = 400; // numbers of an instance, and instances in a row of a texture

// Walks the levels of all objects from the top, the nearest children first, and lists the instances that a view shows. What appears
// smaller than a number of pixels is one instance of its base mesh.
class Walk {
  // A view has axes, an origin, pixels per unit (at depth 1 in perspective), a size, and a smallest size of what is opened.
  constructor(objects, view, occlusion, budget) {
    Object.assign(this, { objects, view, occlusion, budget, count: 0, nearest: Infinity, farthest: 0, isOver: false });
    this.frames = new Float64Array(FRAME * 4096);
    this.ways = [];
    this.order = [];
    this.corners = new Float64Array(3 * 256);
    this.whole = new Float64Array(12);
    this.lists = objects.map(() => ({ data: new Float32Array(INSTANCE * ROW), count: 0 }));
    this.next = 0;
    this.top = 0;
    occlusion.clear();
    const { axes, origin } = view;
    this.toView = [...axes.flatMap(axis => [...axis, -dot(axis, origin)])];
    this.queue = objects.map((object, index) => {
      const t = add([object.map[3], object.map[7], object.map[11]], origin, -1);
      const map = new Float64Array(12);
      compose(map, 0, axes.flatMap(axis => [...axis, 0]), 0, object.map.map((x, i) => i % 4 === 3 ? t[i >> 2] : x), 0);
      const c = [0, 4, 8].map(row => dot(map.subarray(row, row + 3), object.centre) + map[row + 3]);
      return { index, map, depth: c[2] };
    }).sort((a, b) => a.depth - b.depth);
  }

  // Goes on until a time; tells whether all is done.
  run(deadline) {
    for (let steps = 0; !this.isOver; steps++) {
      if (this.top === 0) {
        if (this.next === this.queue.length) return true;
        this.begin(this.queue[this.next++]);
      } else {
        this.visit();
      }
      if ((steps & 255) === 255 && performance.now() > deadline) return false;
    }
    return true;
  }

  begin({ index, map }) {
    const object = this.objects[index];
    this.object = object;
    this.levels = object.levels;
    this.list = this.lists[index];
    this.toFractal = object.gradient >= 3 ? invert(map) : null;
    const { start } = this.levels;
    this.frames.set(map, 0);
    this.frames.set([start.level, start.size], LEVEL);
    this.frames.set([0, 0, 1, 1, 0, 0, 0, 0, 1], COUNT);
    this.ways[0] = start.way;
    const item = this.levels.itemAt(start.level);
    this.top = !item.isEmpty && this.project(0, item) ? 1 : 0;
  }

  // Finds the rectangle, the depths and the size in pixels of a box; false where it is out of view.
  project(f, item) {
    const m = this.frames, v = this.levels.values, b = item.box, view = this.view;
    const cx = v[b], cy = v[b + 1], cz = v[b + 2], hx = v[b + 3], hy = v[b + 4], hz = v[b + 5];
    const x = m[f] * cx + m[f + 1] * cy + m[f + 2] * cz + m[f + 3];
    const rx = Math.abs(m[f]) * hx + Math.abs(m[f + 1]) * hy + Math.abs(m[f + 2]) * hz;
    const y = m[f + 4] * cx + m[f + 5] * cy + m[f + 6] * cz + m[f + 7];
    const ry = Math.abs(m[f + 4]) * hx + Math.abs(m[f + 5]) * hy + Math.abs(m[f + 6]) * hz;
    const z = m[f + 8] * cx + m[f + 9] * cy + m[f + 10] * cz + m[f + 11];
    const rz = Math.abs(m[f + 8]) * hx + Math.abs(m[f + 9]) * hy + Math.abs(m[f + 10]) * hz;
    const near = z - rz, far = z + rz, w = 0.5 * view.width, h = 0.5 * view.height, p = view.focal;
    m[f + NEAR] = near;
    m[f + FAR] = far;
    if (view.isParallel) {
      m[f + RECT] = w + p * (x - rx);
      m[f + RECT + 1] = h + p * (y - ry);
      m[f + RECT + 2] = w + p * (x + rx);
      m[f + RECT + 3] = h + p * (y + ry);
      m[f + PIXELS] = 2 * p * Math.max(rx, ry);
      if (near > view.end) return false;
    } else if (far <= 0) {
      return false;
    } else if (near <= 1e-9 * (far + rx + ry)) {
      m[f + RECT] = m[f + RECT + 1] = -Infinity;
      m[f + RECT + 2] = m[f + RECT + 3] = Infinity;
      m[f + PIXELS] = Infinity;
      // The planes of the view's sides, through the eye.
      return Math.abs(x) - rx <= w / p * far && Math.abs(y) - ry <= h / p * far;
    } else {
      m[f + RECT] = w + p * (x - rx) / (x - rx < 0 ? near : far);
      m[f + RECT + 1] = h + p * (y - ry) / (y - ry < 0 ? near : far);
      m[f + RECT + 2] = w + p * (x + rx) / (x + rx > 0 ? near : far);
      m[f + RECT + 3] = h + p * (y + ry) / (y + ry > 0 ? near : far);
      m[f + PIXELS] = 2 * p * Math.max(rx, ry) / Math.max(z, near);
    }
    return m[f + RECT] < view.width && m[f + RECT + 1] < view.height && m[f + RECT + 2] > 0 && m[f + RECT + 3] > 0;
  }

  nearness(depth) {
    return this.view.isParallel ? -depth : 1 / depth;
  }

  visit() {
    const f = FRAME * --this.top, m = this.frames, view = this.view;
    if (m[f + PIXELS] < Infinity
      && this.occlusion.hides(m[f + RECT], m[f + RECT + 1], m[f + RECT + 2], m[f + RECT + 3], this.nearness(m[f + NEAR]))) return;
    const item = this.levels.itemAt(m[f + LEVEL]);
    if (item.list.length === 0 || m[f + PIXELS] < view.minSize || m[f + DEPTH] >= view.maxDepth) this.emit(f, item);
    else this.open(f, item, this.top);
  }

  // Replaces a level by its children, the nearest on top.
  open(f, item, first) {
    const { stride, values } = this.levels, { list } = item;
    const children = list.length / stride;
    while (FRAME * (first + children + 2) > this.frames.length) {
      const longer = new Float64Array(2 * this.frames.length);
      longer.set(this.frames);
      this.frames = longer;
    }
    const m = this.frames;
    // The level itself lies where its first child will.
    const parent = FRAME * (first + children);
    m.copyWithin(parent, f, f + FRAME);
    const place = { level: m[parent + LEVEL], way: this.ways[first], size: m[parent + SIZE] };
    const order = this.order;
    let count = 0;
    for (let at = 0; at < list.length; at += stride) {
      const next = this.levels.enter(place, list, at), below = this.levels.itemAt(next.level);
      if (below.isEmpty) continue;
      const c = FRAME * (first + count);
      compose(m, c, m, parent, values, 12 * list[at]);
      if (!this.project(c, below)) continue;
      m[c + LEVEL] = next.level;
      m[c + SIZE] = next.size;
      m[c + DEPTH] = m[parent + DEPTH] + 1;
      this.follow(c, parent, list, at);
      if (stride > 5) this.ways[first + count] = next.way;
      count++;
    }
    this.sort(first, count, parent);
    this.top = first + count;
  }

  // Notes what a map does to the colours of what it makes.
  follow(c, parent, list, at) {
    const m = this.frames, rank = list[at + 1];
    for (let k = COUNT; k <= APPROACH; k++) m[c + k] = m[parent + k];
    for (let k = TINT; k < TINT + 4; k++) m[c + k] = m[parent + k];
    if (rank >= 0) {
      m[c + COUNT]++;
      m[c + WEIGHT] *= 0.5;
      m[c + PART] += m[c + WEIGHT] * rank / Math.max(1, list[at + 2] - 1);
      if (this.object.gradient === 5) m[c + APPROACH] = Math.min(m[c + APPROACH], this.distance(c, this.object.middle));
    }
    if (list[at + 4] >= 0) {
      const t = this.levels.tintOf(list[at + 4]);
      for (let k = 0; k < 3; k++) m[c + TINT + k] += m[c + TINT + 3] * t[k];
      m[c + TINT + 3] *= t[3];
    }
  }

  sort(first, count, spare) {
    const m = this.frames;
    for (let i = 1; i < count; i++) {
      const near = m[FRAME * (first + i) + NEAR];
      let j = i;
      while (j > 0 && m[FRAME * (first + j - 1) + NEAR] < near) j--;
      if (j < i) {
        const from = FRAME * (first + i), to = FRAME * (first + j), way = this.ways[first + i];
        m.copyWithin(spare, from, from + FRAME);
        m.copyWithin(to + FRAME, to, from);
        m.copyWithin(to, spare, spare + FRAME);
        if (this.levels.stride > 5) {
          this.ways.copyWithin(first + j + 1, first + j, first + i);
          this.ways[first + j] = way;
        }
      }
    }
  }

  // A point of a level in the frame of the whole fractal.
  locate(f, [x, y, z]) {
    const m = this.frames, t = this.toFractal;
    const p = [0, 4, 8].map(row => m[f + row] * x + m[f + row + 1] * y + m[f + row + 2] * z + m[f + row + 3]);
    return [0, 4, 8].map(row => t[row] * p[0] + t[row + 1] * p[1] + t[row + 2] * p[2] + t[row + 3]);
  }

  // How far a point is from the middle of the whole fractal, by half its diagonal.
  distance(f, point) {
    return 2 * length(subtract(this.locate(f, point), this.object.middle)) / this.object.diagonal;
  }

  // The colour of an instance, or the mean one of what a proxy stands for.
  colour(f, item) {
    const { object, levels } = this, m = this.frames, v = levels.values, b = item.box, isProxy = item.list.length > 0;
    if (object.gradient === 0) return object.colour;
    if (object.gradient === 1) {
      const sweep = clamp(levels.shape.count, 1, 12);
      const phase = (m[f + COUNT] + (isProxy ? levels.restOf(m[f + LEVEL]) : 0)) % (2 * sweep) / sweep;
      return object.palette(phase <= 1 ? phase : 2 - phase);
    }
    if (object.gradient === 2) return object.palette(m[f + PART] + (isProxy ? 0.5 * m[f + WEIGHT] : 0));
    if (object.gradient === 5) return object.palette(m[f + APPROACH]);
    const centre = [v[b], v[b + 1], v[b + 2]];
    if (object.gradient === 4) return object.palette(this.distance(f, centre));
    const low = object.middle[1] - 0.5 * object.height;
    const middle = (this.locate(f, centre)[1] - low) / object.height;
    if (!isProxy) return object.palette(middle);
    let half = 0;
    for (let k = 0; k < 3; k++) {
      const corner = centre.map((x, i) => i === k ? x + v[b + 3 + k] : x);
      half += Math.abs((this.locate(f, corner)[1] - low) / object.height - middle);
    }
    const [first, second, last] = [-half, 0, half].map(offset => object.palette(clamp(middle + offset, 0, 1)));
    return first.map((x, i) => (x + 4 * second[i] + last[i]) / 6);
  }

  emit(f, item) {
    const m = this.frames, { mesh } = this.object, list = this.list;
    if (this.count++ >= this.budget) {
      this.isOver = true;
      return;
    }
    let map = m, at = f;
    if (item.list.length > 0) {
      const proxy = this.proxyOf(item);
      if (proxy) {
        compose(this.whole, 0, m, f, proxy, 0);
        map = this.whole;
        at = 0;
      }
    }
    if (INSTANCE * (list.count + 1) > list.data.length) {
      const longer = new Float32Array(2 * list.data.length);
      longer.set(list.data);
      list.data = longer;
    }
    const target = list.data, start = INSTANCE * list.count++;
    for (let k = 0; k < 12; k++) target[start + k] = map[at + k];
    target.set(this.colour(f, item), start + 12);
    const isTinted = this.levels.shape.tints > 0, mean = isTinted ? this.levels.meanTint(m[f + LEVEL]) : null;
    for (let k = 0; k < 3; k++) target[start + 16 + k] = isTinted ? m[f + TINT + k] + m[f + TINT + 3] * mean[k] : 0;
    target[start + 19] = isTinted ? m[f + TINT + 3] * mean[3] : 1;
    this.nearest = Math.min(this.nearest, m[f + NEAR]);
    this.farthest = Math.max(this.farthest, m[f + FAR]);
    if (mesh.canHide) this.hide(map, at, mesh);
  }

  // The map of the base mesh to the box of a level, where the mesh does not lie within it already.
  proxyOf(item) {
    const v = this.levels.values, b = item.box, { centre, half } = this.object.mesh;
    const isWithin = [0, 1, 2].every(k => Math.abs(centre[k] - v[b + k]) + half[k] <= v[b + 3 + k] * 1.001 + 1e-12);
    if (isWithin) return null;
    const proxy = new Float64Array(12);
    for (let k = 0; k < 3; k++) {
      const factor = half[k] > 0 ? v[b + 3 + k] / half[k] : 1;
      proxy[5 * k] = factor;
      proxy[4 * k + 3] = v[b + k] - factor * centre[k];
    }
    return proxy;
  }

  hide(map, at, mesh) {
    const { positions, indices } = mesh, view = this.view, corners = this.corners;
    const w = 0.5 * view.width, h = 0.5 * view.height, p = view.focal;
    for (let i = 0; i < positions.length; i += 3) {
      const x = positions[i], y = positions[i + 1], z = positions[i + 2];
      const depth = map[at + 8] * x + map[at + 9] * y + map[at + 10] * z + map[at + 11];
      if (!view.isParallel && depth <= 0) return;
      const k = view.isParallel ? p : p / depth;
      corners[i] = w + k * (map[at] * x + map[at + 1] * y + map[at + 2] * z + map[at + 3]);
      corners[i + 1] = h + k * (map[at + 4] * x + map[at + 5] * y + map[at + 6] * z + map[at + 7]);
      corners[i + 2] = view.isParallel ? -depth : 1 / depth;
    }
    for (let i = 0; i < indices.length; i += 3) this.occlusion.draw(corners, 3 * indices[i], 3 * indices[i + 1], 3 * indices[i + 2]);
  }
}
