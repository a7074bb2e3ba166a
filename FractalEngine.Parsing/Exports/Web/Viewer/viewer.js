// Shows the scene: coarse while it moves, then finer, and then the mean of many frames, each with the shadows of one direction of the sky.
// Four ways to lay pixels over the scene, with the shadows of six directions each.
const FRAMES = 24, JITTERS = 4, FINEST = 2, BUDGET = 300000;

// Points of a square around 0, the next always where there is most room (M. Roberts, "The Unreasonable Effectiveness of
// Quasirandom Sequences", 2018).
const spread = i => [(0.5 + 0.7548776662 * i) % 1 - 0.5, (0.5 + 0.569840291 * i) % 1 - 0.5];

class Viewer {
  constructor(scene) {
    this.scene = scene;
    this.canvas = document.getElementById("canvas");
    this.gpu = new Gpu(this.canvas, scene.shaders);
    const meshes = scene.meshes.map(mesh => this.gpu.mesh(mesh));
    this.fractals = scene.fractals.map(data => new Levels(data));
    this.objects = scene.objects.map(object => this.prepare(object, meshes));
    this.images = scene.textures.map(bytes => this.image(bytes));
    this.maxDepth = Infinity;
    this.movingSize = 6;
    this.part = 1;
    this.lastMove = 0;
    this.directions = Array.from({ length: FRAMES }, (_, i) => {
      const [a, b] = spread(i + 1), y = -2 * a, angle = 2 * Math.PI * b, r = Math.sqrt(1 - y * y);
      return [r * Math.cos(angle), y, r * Math.sin(angle)];
    });
    this.camera = new OrbitCamera(this.canvas, scene, (x, y) => this.depthAt(x, y), () => this.change());
    this.panel();
    new ResizeObserver(() => this.change()).observe(this.canvas);
    const step = time => {
      this.step(time);
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  prepare(data, meshes) {
    const levels = this.fractals[data.model], mesh = meshes[data.model], { whole, stops } = data;
    const palette = place => {
      let i = 4;
      while (i < stops.length - 4 && !(stops[i] > place)) i += 4;
      const from = stops[i - 4], part = clamp((place - from) / (stops[i] - from) || 0, 0, 1);
      return [1, 2, 3].map(k => stops[i - 4 + k] + part * (stops[i + k] - stops[i - 4 + k]));
    };
    const lists = { main: { count: 0 }, key: { count: 0 }, sky: { count: 0 } };
    return {
      levels, mesh, lists, palette, map: data.map, colour: data.colour, gradient: data.gradient || 0, middle: whole.slice(0, 3),
      centre: whole.slice(0, 3), height: whole[4] || 1, diagonal: length(whole.slice(3)) || 1,
      isClosed: mesh.data.isClosed && !data.isMirrored,
    };
  }

  image(bytes) {
    const texture = this.gpu.texture(), { gl } = this.gpu, binary = atob(bytes);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array([153, 153, 153, 255]));
    createImageBitmap(new Blob([Uint8Array.from(binary, c => c.charCodeAt(0))]), { premultiplyAlpha: "none", colorSpaceConversion: "none" })
      .then(bitmap => {
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
        gl.generateMipmap(gl.TEXTURE_2D);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
        for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, wrap, gl.REPEAT);
        this.change();
      });
    return texture;
  }

  // Sliders for the numbers, and one for the levels.
  panel() {
    const panel = document.getElementById("panel");
    const slider = (name, [value, from, to], isWhole, write, changed) => {
      const label = document.createElement("label"), input = document.createElement("input"), output = document.createElement("output");
      Object.assign(input, { type: "range", min: from, max: to, step: isWhole ? 1 : (to - from) / 500, value, title: name });
      const show = () => output.textContent = write(Number(input.value));
      input.addEventListener("input", () => {
        show();
        changed(Number(input.value));
        this.change();
      });
      show();
      label.append(name, input, output);
      panel.append(label);
    };
    const numbers = this.scene.numbers.map(number => ({ ...number, value: number.range[0] }));
    for (const number of numbers) {
      slider(number.name, number.range, false, x => String(Number(x.toPrecision(4))), value => {
        number.value = value;
        this.setNumbers(numbers, number);
      });
    }
    const count = Math.max(...this.fractals.map(one => one.shape.count)), most = Math.min(count, 12);
    if (count > 1) {
      slider("levels", [most, 0, most], true, x => x === most ? "all" : String(x), x => this.maxDepth = x === most ? Infinity : x);
    }
  }

  // Numbers that were moved add up what each changes alone. Where one changes the levels themselves, its nearest sample is shown.
  setNumbers(numbers, moved) {
    this.fractals.forEach((fractal, index) => {
      const sampled = moved.fractals.find(one => one.fractal === index), [, from, to, samples] = moved.range;
      if (sampled?.others) {
        const other = sampled.others[Math.round((moved.value - from) / (to - from) * (samples - 1))];
        Object.assign(fractal, new Levels(other));
        return;
      }
      fractal.values.set(fractal.data.values);
      for (const number of numbers) {
        const one = number.fractals.find(entry => entry.fractal === index);
        const [start, low, high] = number.range;
        if (!one || one.others || number.value === start) continue;
        const length = one.changing.length, at = (number.value - low) / (high - low) * (samples - 1);
        const before = clamp(Math.floor(at), 0, samples - 2), part = at - before;
        one.changing.forEach((place, i) => {
          const [a, b] = [one.values[before * length + i], one.values[(before + 1) * length + i]];
          fractal.values[place] += a + part * (b - a) - fractal.data.values[place];
        });
      }
      fractal.means.clear();
      fractal.rests.clear();
    });
  }

  change() {
    this.isChanged = true;
    this.lastMove = performance.now();
    this.plan = null;
  }

  view(minSize) {
    const { width, height } = this.gpu, { position, axes, slope } = this.camera;
    return { axes, origin: position, focal: 0.5 * height / slope, width, height, minSize, maxDepth: this.maxDepth };
  }

  get slopes() {
    return [this.camera.slope * this.gpu.width / this.gpu.height, this.camera.slope];
  }

  step(time) {
    const ratio = Math.min(devicePixelRatio, 2);
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight].map(size => Math.max(1, Math.round(size * ratio)));
    if (width !== this.canvas.width || height !== this.canvas.height || !this.gpu.drawn) {
      Object.assign(this.canvas, { width, height });
      this.gpu.resize(width, height);
      this.occlusion = new OcclusionBuffer(width, height);
      this.isChanged = true;
    }
    if (this.isChanged) {
      this.isChanged = false;
      this.drawMoving(time);
    } else if (performance.now() - this.lastMove > 120) {
      this.plan ??= this.refine();
      if (this.plan.next().done) this.tell("done");
    }
  }

  tell(state) {
    if (this.canvas.dataset.state === state) return;
    this.canvas.dataset.state = state;
    this.canvas.dataset.instances = this.instances;
    document.getElementById("status").textContent = state === "refining" ? "…" : "";
  }

  // A frame within a thirtieth of a second: sub-fractals are opened as far as the last such frames had time for.
  drawMoving(time) {
    const took = time - this.lastFrame;
    if (took < 1000) this.movingSize = clamp(this.movingSize * (took > 31 ? 1.15 : took < 24 ? 0.93 : 1), FINEST, 80);
    this.part = this.movingSize > 40 ? 0.5 : this.movingSize > 20 ? 0.75 : 1;
    this.lastFrame = time;
    this.tell("moving");
    const walk = new Walk(this.objects, this.view(this.movingSize), this.occlusion, 60000);
    if (!walk.run(performance.now() + 40) || walk.isOver) this.movingSize *= 1.5;
    this.list(walk, "main");
    if (!this.key) this.key = this.shadow(this.gpu.keyMap, "key", this.keyDirection(), 6);
    this.draw(walk.view);
    this.part = 1;
  }

  // Draws finer and finer, step by step, then gathers frames.
  *refine() {
    this.tell("refining");
    let view, isOver = false;
    for (let size = Math.max(FINEST, 0.5 * this.movingSize); ;) {
      view = this.view(size);
      const walk = new Walk(this.objects, view, this.occlusion, BUDGET);
      while (!walk.run(performance.now() + 14)) yield;
      if (walk.isOver) {
        isOver = true;
        size *= 1.5;
        continue;
      }
      this.list(walk, "main");
      this.draw(view);
      yield;
      if (isOver || size === FINEST) break;
      size = Math.max(FINEST, 0.5 * size);
    }
    this.key = this.shadow(this.gpu.keyMap, "key", this.keyDirection(), 4);
    // What is transparent is left out in a part of the frames, so that each has to differ.
    const jitters = this.scene.materials.some(material => material.opacity < 1) ? FRAMES : JITTERS;
    for (let i = 0; i < (this.gpu.hasFloats ? FRAMES : 1); i++) {
      yield;
      const jitter = Math.floor(i * jitters / FRAMES), direction = this.directions[i];
      if (i * jitters % FRAMES === 0) {
        const [x, y] = spread(jitter);
        this.draw(view, [2 * x / view.width, 2 * y / view.height], jitter / jitters);
      }
      this.gather(view, direction, i === 0);
      if (i % 4 === 3) this.present(i + 1);
    }
  }

  // Takes over the instances that a walk has listed, and where they are, for shadow maps.
  list(walk, name) {
    this.objects.forEach((object, i) => this.gpu.upload(object.lists[name], walk.lists[i]));
    if (name !== "main") return;
    this.instances = walk.count;
    const { view } = walk, places = new Float32Array(4 * walk.count), [right, up, forward] = view.axes;
    let n = 0;
    walk.lists.forEach(({ data, count }, i) => {
      const { centre: [x, y, z], half } = this.objects[i].mesh, reach = Math.max(...half) * 1.8;
      for (let d = 0; d < INSTANCE * count; d += INSTANCE) {
        const p = [0, 4, 8].map(row => data[d + row] * x + data[d + row + 1] * y + data[d + row + 2] * z + data[d + row + 3]);
        for (let k = 0; k < 3; k++) places[n + k] = right[k] * p[0] + up[k] * p[1] + forward[k] * p[2];
        places[n + 3] = reach * Math.max(Math.hypot(data[d], data[d + 4], data[d + 8]), Math.hypot(data[d + 1], data[d + 5], data[d + 9]),
          Math.hypot(data[d + 2], data[d + 6], data[d + 10]));
        n += 4;
      }
    });
    Object.assign(this, { listedView: view, places, origin: view.origin, nearest: walk.nearest, farthest: walk.farthest });
  }

  keyDirection() {
    const light = this.scene.lights[0];
    return !light ? [0, -1, 0] : light.position ? unit(subtract(this.scene.centre, light.position)) : light.axis;
  }

  // Draws the depths along a direction, of all that may shade what is seen.
  shadow(map, name, direction, minSize) {
    const { gl } = this.gpu, axes = axesAlong(direction), { places } = this;
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < places.length; i += 4) {
      // What is much larger than what it shows lies mostly out of view.
      const reach = Math.min(places[i + 3], Math.hypot(places[i], places[i + 1], places[i + 2]) + 0.5 * this.scene.size);
      for (let k = 0; k < 3; k++) {
        const axis = axes[k], at = axis[0] * places[i] + axis[1] * places[i + 1] + axis[2] * places[i + 2];
        low[k] = Math.min(low[k], at - reach);
        high[k] = Math.max(high[k], at + reach);
      }
    }
    if (!(low[0] < high[0])) return null;
    const half = 0.5 * Math.max(high[0] - low[0], high[1] - low[1]), middle = [0, 1].map(k => 0.5 * (low[k] + high[k]));
    const origin = add(add(this.origin, axes[0], middle[0]), axes[1], middle[1]), focal = 0.5 * map.size / half;
    map.occlusion ??= new OcclusionBuffer(map.size, map.size);
    const size = { width: map.size, height: map.size, minSize, maxDepth: this.maxDepth };
    const view = { axes, origin, focal, ...size, isParallel: true, end: high[2] };
    const walk = new Walk(this.objects, view, map.occlusion, BUDGET);
    walk.run(Infinity);
    this.list(walk, name);
    const near = Math.min(walk.nearest, low[2]), far = high[2];
    gl.bindFramebuffer(gl.FRAMEBUFFER, map.frame);
    gl.viewport(0, 0, map.size, map.size);
    gl.enable(gl.DEPTH_TEST);
    gl.disable(gl.CULL_FACE);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    this.gpu.use(this.gpu.shadow, {
      toWorld: [1, 0, 0, 0, 1, 0, 0, 0, 1], toCamera: [1, 0, 0, 0, 1, 0, 0, 0, 1], offset: [0, 0, 0], jitter: [0, 0], isParallel: 1,
      projection: [1 / half, 1 / half, 2 / (far - near), -(far + near) / (far - near)],
    });
    for (const { mesh, lists } of this.objects) {
      for (const batch of lists[name].count > 0 ? mesh.batches : []) {
        const material = this.scene.materials[batch.material];
        if (!(material?.opacity < 1)) this.gpu.draw(this.gpu.shadow, mesh, batch, lists[name]);
      }
    }
    return { axes, origin, half, near, far, texel: 2 * half / map.size, direction };
  }

  // The map from a point relative to the camera to a shadow map, by columns.
  toShadow(shadow) {
    if (!shadow) return [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1, -1, -1, 1];
    const { axes, origin, half, near, far } = shadow, offset = subtract(this.camera.position, origin);
    const ends = [[-half, half], [-half, half], [near, far]];
    const rows = axes.map((axis, k) => [...axis, dot(axis, offset) - ends[k][0]].map(x => x / (ends[k][1] - ends[k][0])));
    return [0, 1, 2, 3].flatMap(column => [rows[0][column], rows[1][column], rows[2][column], column === 3 ? 1 : 0]);
  }

  // Draws what is listed: onto the screen at once, or with a jitter, into the parts that frames add up.
  draw(view, jitter = null, seed = 0) {
    const { gpu, scene, camera, slopes } = this, { gl } = gpu, listed = this.listedView, [right, up, forward] = view.axes;
    const program = jitter ? gpu.scene : gpu.finalScene;
    const width = Math.round(this.part * gpu.width), height = Math.round(this.part * gpu.height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, jitter ? gpu.drawn.frame : this.part < 1 ? gpu.coarse.frame : null);
    gl.viewport(0, 0, width, height);
    gl.depthFunc(gl.LEQUAL);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    const far = Math.max(this.farthest, 1e-12) * 1.01, near = clamp(this.nearest * 0.9, 1e-5 * far, 0.5 * far);
    const lights = scene.lights, position = light => light.position ? subtract(light.position, camera.position) : scale(light.axis, -1);
    gpu.bind(0, gpu.keyMap.texture);
    const display = { display: scene.display, background: [...scene.background, scene.sky ? 0 : 1] };
    gpu.use(program, {
      ...scene.ambient, ...display, toWorld: listed.axes.flat(), offset: subtract(listed.origin, camera.position),
      toCamera: [0, 1, 2].flatMap(k => [right[k], up[k], forward[k]]), jitter: jitter || [0, 0], isParallel: 0, seed,
      projection: [1 / slopes[0], 1 / slopes[1], (far + near) / (far - near), -2 * far * near / (far - near)],
      lightCount: lights.length, lightColours: lights.flatMap(light => [...light.colour, light.position ? 1 : 0]),
      lightPositions: lights.flatMap(light => [...position(light), light.range || 0]),
      lightAxes: lights.flatMap(light => [...light.axis, light.cone[0]]), lightEdges: lights.map(light => light.cone[1]),
      keyMap: this.toShadow(this.key), keyShadow: 0, image: 2, texel: this.key ? this.key.texel : 0,
      fog: [...scene.fog, scene.display[2]],
    });
    gl.cullFace(gl.BACK);
    gl.frontFace(dot(cross(right, up), forward) > 0 ? gl.CW : gl.CCW);
    for (const object of this.objects) {
      if (object.lists.main.count === 0) continue;
      (object.isClosed ? gl.enable : gl.disable).call(gl, gl.CULL_FACE);
      for (const batch of object.mesh.batches) {
        const material = scene.materials[batch.material] || { colour: [1, 1, 1], opacity: 1, ambient: [1, 1, 1], emission: [0, 0, 0] };
        const isTextured = material.texture !== undefined;
        gpu.bind(2, isTextured ? this.images[material.texture] : gpu.white);
        gpu.use(program, {
          kd: [...material.colour, batch.material < 0 ? 0 : 1], opacity: material.opacity, isTextured,
          material: [...material.ambient, ...material.emission], texturePlace: material.place || [1, 1, 0, 0],
        });
        gpu.draw(program, object.mesh, batch, object.lists.main);
      }
    }
    // Behind all surfaces, so that only what they leave is computed.
    gl.disable(gl.CULL_FACE);
    gpu.fill(jitter ? gpu.sky : gpu.finalSky, {
      ...display, fromCamera: view.axes.flat(), slopes, zenith: [0, 0, 0], horizon: [0, 0, 0], ground: [0, 0, 0], ...scene.sky,
    });
    if (this.part < 1) {
      gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
      gl.blitFramebuffer(0, 0, width, height, 0, 0, gpu.width, gpu.height, gl.COLOR_BUFFER_BIT, gl.LINEAR);
    }
  }

  // What the sky, or other light from all around, brings from a direction.
  skyLight([, y]) {
    const { sky, ambient } = this.scene;
    const mix = (from, to, part) => [0, 1, 2].map(k => from[k] + part * (to[k] - from[k]));
    if (!sky) return mix(ambient.below, ambient.above, 0.5 + 0.5 * y);
    return y >= 0 ? mix(sky.horizon, sky.zenith, y) : mix(sky.horizon, sky.ground, Math.sqrt(-y));
  }

  // Adds the frame to the sum of those before, or begins a new one, with the shadows of a direction of the sky.
  gather(view, direction, isFirst) {
    const { gpu, scene } = this, { gl } = gpu, shadow = direction && this.shadow(gpu.skyMap, "sky", scale(direction, -1), 12);
    gl.bindFramebuffer(gl.FRAMEBUFFER, gpu.sum.frame);
    gl.viewport(0, 0, gpu.width, gpu.height);
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.CULL_FACE);
    (isFirst ? gl.disable : gl.enable).call(gl, gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    gpu.drawn.textures.forEach((texture, i) => gpu.bind(3 + i, texture));
    gpu.bind(1, gpu.skyMap.texture);
    gpu.fill(gpu.gather, {
      direct: 3, reflected: 4, facing: 5, skyShadow: 1, fromCamera: view.axes.flat(), slopes: this.slopes, ...scene.ambient,
      skyMap: this.toShadow(shadow), texel: shadow ? shadow.texel : 0, skyDirection: shadow ? [...direction, 1] : [0, 1, 0, 0],
      skyRadiance: this.skyLight(direction || [0, 1, 0]),
    });
    gl.disable(gl.BLEND);
  }

  present(frames) {
    const { gpu } = this, { gl } = gpu, { display, background, sky, lights } = this.scene;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.CULL_FACE);
    gl.viewport(0, 0, gpu.width, gpu.height);
    gpu.sum.textures.forEach((texture, i) => gpu.bind(3 + i, texture));
    gpu.fill(gpu.show, {
      direct: 3, reflected: 4, sky: 5, frames, display, background: [...background, sky ? 0 : 1],
      lamps: lights.reduce((sum, light) => add(sum, light.colour), [0, 0, 0]),
    });
  }

  // The depth of what a pixel shows, as the walk has found it; 0 for the sky. Large meshes are drawn to find theirs.
  depthAt(x, y) {
    if (!this.occlusion) return 0;
    const { gl, width, height, drawn } = this.gpu, ratio = width / this.canvas.clientWidth;
    const column = Math.floor(x * ratio), row = height - 1 - Math.floor(y * ratio), near = this.occlusion.near[row * width + column];
    if (near > 0 || this.objects.every(object => object.mesh.canHide) || !this.gpu.hasFloats) return near > 0 ? 1 / near : 0;
    this.draw(this.view(FINEST), [0, 0]);
    const texel = new Float32Array(4);
    gl.readBuffer(gl.COLOR_ATTACHMENT1);
    gl.readPixels(column, row, 1, 1, gl.RGBA, gl.FLOAT, texel);
    return texel[3] / length(this.camera.ray(x, y));
  }
}

async function readData() {
  const binary = atob(document.getElementById("data").textContent), bytes = Uint8Array.from(binary, c => c.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"))).json();
}

let viewer;
readData().then(data => viewer = new Viewer(data)).catch(error => {
  document.getElementById("status").textContent = "This page can't be shown: " + error.message;
  console.error(error);
});
