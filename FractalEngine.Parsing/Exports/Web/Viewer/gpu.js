// Buffers, programs and targets of WebGL2.
class Gpu {
  constructor(canvas, shaders) {
    const gl = canvas.getContext("webgl2", { antialias: false, powerPreference: "high-performance" });
    if (!gl) throw new Error("this browser has no WebGL2");
    this.gl = gl;
    this.shaders = shaders;
    this.hasFloats = Boolean(gl.getExtension("EXT_color_buffer_float"));
    this.scene = this.program("scene.vert", "scene.frag");
    this.shadow = this.program("scene.vert", "shadow.frag");
    this.sky = this.program("sky.vert", "sky.frag");
    this.finalScene = this.program("scene.vert", "scene.frag", "#define FINAL\n");
    this.finalSky = this.program("sky.vert", "sky.frag", "#define FINAL\n");
    this.gather = this.program("sky.vert", "gather.frag");
    this.show = this.program("sky.vert", "show.frag");
    this.keyMap = this.depthMap(1024);
    this.skyMap = this.depthMap(512);
    this.empty = gl.createVertexArray();
    this.white = this.texture();
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array([255, 255, 255, 255]));
  }

  program(vertex, fragment, symbols = "") {
    const { gl } = this, program = gl.createProgram();
    for (const [name, kind] of [[vertex, gl.VERTEX_SHADER], [fragment, gl.FRAGMENT_SHADER]]) {
      const shader = gl.createShader(kind);
      const text = id => this.shaders[id].replace(/#include (\S+)/g, (_, other) => text(other));
      gl.shaderSource(shader, text(name).replace("\n", "\n" + symbols));
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(name + ": " + gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    const places = {};
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
      const { name, type, size } = gl.getActiveUniform(program, i);
      places[name.replace("[0]", "")] = { at: gl.getUniformLocation(program, name), type, size };
    }
    return { program, places };
  }

  // Sets uniforms by their names; numbers of samplers are units.
  use({ program, places }, values) {
    const { gl } = this;
    gl.useProgram(program);
    for (const [name, value] of Object.entries(values)) {
      const place = places[name];
      if (!place) continue;
      const list = value.length === undefined ? [value] : value;
      if (place.type === gl.FLOAT) gl.uniform1fv(place.at, list);
      else if (place.type === gl.FLOAT_VEC2) gl.uniform2fv(place.at, list);
      else if (place.type === gl.FLOAT_VEC3) gl.uniform3fv(place.at, list);
      else if (place.type === gl.FLOAT_VEC4) gl.uniform4fv(place.at, list);
      else if (place.type === gl.FLOAT_MAT3) gl.uniformMatrix3fv(place.at, false, list);
      else if (place.type === gl.FLOAT_MAT4) gl.uniformMatrix4fv(place.at, false, list);
      else if (place.type === gl.INT_VEC3) gl.uniform3iv(place.at, list);
      else gl.uniform1iv(place.at, list);
    }
  }

  texture(filter = this.gl.NEAREST) {
    const { gl } = this, texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filter);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filter);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    return texture;
  }

  depthMap(size) {
    const { gl } = this, texture = this.texture(gl.LINEAR), frame = gl.createFramebuffer();
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, size, size);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, texture, 0);
    return { texture, frame, size };
  }

  // Three textures, and depth where surfaces are drawn.
  target(width, height, hasDepth) {
    const { gl } = this, frame = gl.createFramebuffer(), textures = [];
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    for (let i = 0; i < 3; i++) {
      textures.push(this.texture());
      gl.texStorage2D(gl.TEXTURE_2D, 1, this.hasFloats ? (hasDepth && i === 1 ? gl.RGBA32F : gl.RGBA16F) : gl.RGBA8, width, height);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + i, gl.TEXTURE_2D, textures[i], 0);
    }
    const depth = hasDepth ? gl.createRenderbuffer() : null;
    if (depth) {
      gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
      gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
    }
    gl.drawBuffers([0, 1, 2].map(i => gl.COLOR_ATTACHMENT0 + i));
    return { frame, textures, buffers: [depth] };
  }

  // A target for frames of less than all pixels.
  coarseTarget(width, height) {
    const { gl } = this, frame = gl.createFramebuffer(), buffers = [gl.createRenderbuffer(), gl.createRenderbuffer()];
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    [[gl.RGBA8, gl.COLOR_ATTACHMENT0], [gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]].forEach(([format, place], i) => {
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffers[i]);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, buffers[i]);
    });
    return { frame, textures: [], buffers };
  }

  resize(width, height) {
    const { gl } = this;
    for (const { frame, textures, buffers } of this.drawn ? [this.drawn, this.sum, this.coarse] : []) {
      textures.forEach(texture => gl.deleteTexture(texture));
      buffers.forEach(buffer => gl.deleteRenderbuffer(buffer));
      gl.deleteFramebuffer(frame);
    }
    this.coarse = this.coarseTarget(width, height);
    this.drawn = this.target(width, height, true);
    this.sum = this.target(width, height, false);
    Object.assign(this, { width, height });
  }

  // A mesh as buffers, with several copies of a small one.
  mesh(data) {
    const { gl } = this, box = data.box, mesh = { data };
    mesh.positions = sums(data.positions, 3, box.slice(0, 3), box.slice(3));
    mesh.half = [0, 1, 2].map(k => 32767.5 * box[3 + k]);
    mesh.centre = [0, 1, 2].map(k => box[k] + mesh.half[k]);
    mesh.batches = [];
    const indices = [];
    for (const batch of data.batches) {
      mesh.batches.push({ material: batch.material, first: indices.length, count: batch.indices.length });
      for (const index of sums(batch.indices, 1, [0], [1])) indices.push(index);
    }
    mesh.indices = Uint32Array.from(indices);
    mesh.canHide = indices.length <= 3 * 64 && mesh.positions.length <= 3 * 256;
    mesh.count = mesh.positions.length / 3;
    mesh.copies = Math.max(1, Math.floor(4096 / mesh.count));
    mesh.array = gl.createVertexArray();
    gl.bindVertexArray(mesh.array);
    const t = data.textureBox;
    this.attribute(mesh, 0, 3, mesh.positions);
    this.attribute(mesh, 1, 3, sums(data.normals, 3, [0, 0, 0], [1 / 127, 1 / 127, 1 / 127]));
    if (t) this.attribute(mesh, 2, 2, sums(data.texture, 2, t.slice(0, 2), t.slice(2)));
    if (data.colours) this.attribute(mesh, 3, 3, sums(data.colours, 3, [0, 0, 0], [1 / 255, 1 / 255, 1 / 255]).map(linear));
    const elements = new Uint32Array(mesh.copies * indices.length);
    let n = 0;
    for (const batch of mesh.batches) {
      const { first, count } = batch;
      batch.start = n;
      for (let copy = 0; copy < mesh.copies; copy++) {
        for (let i = first; i < first + count; i++) elements[n++] = indices[i] + copy * mesh.count;
      }
    }
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, elements, gl.STATIC_DRAW);
    gl.bindVertexArray(null);
    return mesh;
  }

  attribute(mesh, place, components, array) {
    const { gl } = this, copied = new Float32Array(array.length * mesh.copies);
    for (let copy = 0; copy < mesh.copies; copy++) copied.set(array, copy * array.length);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, copied, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, components, gl.FLOAT, false, 0, 0);
  }

  upload(list, { data, count }) {
    const { gl } = this, rows = Math.ceil(count / ROW);
    list.count = count;
    list.texture ??= this.texture();
    this.bind(6, list.texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, 5 * ROW, rows, 0, gl.RGBA, gl.FLOAT, data.subarray(0, INSTANCE * ROW * rows));
  }

  draw(program, mesh, batch, list) {
    const { gl } = this;
    gl.bindVertexArray(mesh.array);
    gl.vertexAttrib3f(3, 1, 1, 1);
    this.bind(6, list.texture);
    this.use(program, { instances: 6, counts: [mesh.count, mesh.copies, list.count] });
    const draws = Math.ceil(list.count / mesh.copies);
    gl.drawElementsInstanced(gl.TRIANGLES, batch.count * mesh.copies, gl.UNSIGNED_INT, 4 * batch.start, draws);
  }

  bind(unit, texture) {
    this.gl.activeTexture(this.gl.TEXTURE0 + unit);
    this.gl.bindTexture(this.gl.TEXTURE_2D, texture);
  }

  // A triangle that covers the target.
  fill(program, values) {
    this.use(program, values);
    this.gl.bindVertexArray(this.empty);
    this.gl.drawArrays(this.gl.TRIANGLES, 0, 3);
  }
}

const linear = x => x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
