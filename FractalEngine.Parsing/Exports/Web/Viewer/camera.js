// A camera that turns about a point, moves along the screen, and goes towards what is under the pointer.
class OrbitCamera {
  // Calls changed() after each change; pick(x, y) gives the depth of what a pixel shows, or 0.
  constructor(canvas, scene, pick, changed) {
    Object.assign(this, { canvas, scene, pick, changed, pointers: new Map() });
    this.reset();
    canvas.addEventListener("pointerdown", event => this.down(event));
    canvas.addEventListener("pointermove", event => this.move(event));
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, event => this.up(event));
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      this.zoom(event.clientX, event.clientY, Math.exp(-0.002 * event.deltaY * (event.deltaMode === 1 ? 20 : 1)));
    }, { passive: false });
    canvas.addEventListener("contextmenu", event => event.preventDefault());
    canvas.addEventListener("dblclick", () => this.reset());
  }

  reset() {
    const { position, axes } = this.scene.camera;
    this.position = [...position];
    this.axes = [axes.slice(0, 3), axes.slice(3, 6), axes.slice(6)];
    this.pivot = add(this.position, this.axes[2], Math.max(dot(subtract(this.scene.centre, this.position), this.axes[2]),
      1e-3 * this.scene.size));
    this.changed();
  }

  // Half the visible height at depth 1. Narrow screens show as much across as that of the scene's own image.
  get slope() {
    const { slope, aspect } = this.scene.camera;
    return slope * Math.max(1, aspect / (this.canvas.clientWidth / this.canvas.clientHeight) / 1.3);
  }

  // The direction of a pixel, of length 1 along the middle of the view.
  ray(x, y) {
    const { clientWidth: width, clientHeight: height } = this.canvas, [right, up, forward] = this.axes, s = this.slope;
    return add(add(forward, right, s * (2 * x - width) / height), up, s * (1 - 2 * y / height));
  }

  // The point that a pixel shows; in the plane of the pivot where that is nothing.
  pointAt(x, y) {
    return add(this.position, this.ray(x, y), this.pick(x, y) || dot(subtract(this.pivot, this.position), this.axes[2]));
  }

  down(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (this.pointers.size > 1) return;
    this.isPan = event.button !== 0 || event.shiftKey;
    if (this.pick(event.clientX, event.clientY) > 0) this.pivot = this.pointAt(event.clientX, event.clientY);
  }

  move(event) {
    const last = this.pointers.get(event.pointerId);
    if (!last) return;
    const dx = event.clientX - last[0], dy = event.clientY - last[1];
    const others = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (others.length > 0) {
      const [x, y] = others[0], before = Math.hypot(last[0] - x, last[1] - y), after = Math.hypot(event.clientX - x, event.clientY - y);
      this.pan(0.5 * dx, 0.5 * dy);
      this.zoom(0.5 * (x + event.clientX), 0.5 * (y + event.clientY), after / Math.max(before, 1));
    } else if (this.isPan) {
      this.pan(dx, dy);
    } else {
      this.orbit(dx, dy);
    }
  }

  up(event) {
    this.pointers.delete(event.pointerId);
  }

  pan(dx, dy) {
    const [right, up, forward] = this.axes;
    const unit = 2 * this.slope * dot(subtract(this.pivot, this.position), forward) / this.canvas.clientHeight;
    const way = add(scale(right, -dx * unit), up, dy * unit);
    this.position = add(this.position, way);
    this.pivot = add(this.pivot, way);
    this.changed();
  }

  orbit(dx, dy) {
    const [right, up, forward] = this.axes, hand = dot(cross(right, up), forward), step = 5 / this.canvas.clientHeight;
    const pitch = Math.asin(clamp(forward[1], -1, 1)), target = clamp(pitch - dy * step, -1.55, 1.55);
    const turned = v => turn(turn(v, right, hand * (pitch - target)), [0, 1, 0], hand * dx * step);
    const offset = subtract(this.position, this.pivot);
    this.position = add(this.pivot, turned(offset));
    this.axes = this.axes.map(turned);
    this.straighten();
    this.changed();
  }

  // Takes away what rounding adds.
  straighten() {
    let [right, up, forward] = this.axes;
    const hand = Math.sign(dot(cross(right, up), forward));
    forward = unit(forward);
    right = unit(add(right, forward, -dot(right, forward)));
    this.axes = [right, scale(cross(forward, right), hand), forward];
  }

  // Goes towards the point under a pixel, until it appears larger by a factor.
  zoom(x, y, factor) {
    const target = this.pointAt(x, y), part = 1 - 1 / clamp(factor, 0.2, 5);
    this.position = add(this.position, subtract(target, this.position), part);
    this.pivot = target;
    this.changed();
  }
}
