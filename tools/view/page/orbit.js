// Rotates, pans and zooms the free view by mouse, touch and keys. The world's z is up.

const LOWEST = -0.05;
const HIGHEST = 1.55;
const KEY_TURN = 0.12;
const KEY_MOVE = 0.06;

export class Orbit {
  /** @param element receives the dragging; @param onChange called when the view has changed. */
  constructor(element, onChange = () => {}) {
    this.element = element;
    this.onChange = onChange;
    this.pointers = new Map();
    this.home = {target: [0, 0, 900], distance: 7000, turn: -0.9, rise: 0.42};
    this.reset();
    element.addEventListener('pointerdown', (event) => this.down(event));
    element.addEventListener('pointermove', (event) => this.move(event));
    for (const name of ['pointerup', 'pointercancel']) {
      element.addEventListener(name, (event) => this.pointers.delete(event.pointerId));
    }
    element.addEventListener('wheel', (event) => this.wheel(event), {passive: false});
    element.addEventListener('contextmenu', (event) => event.preventDefault());
  }

  reset() {
    this.target = [...this.home.target];
    this.distance = this.home.distance;
    this.turn = this.home.turn;
    this.rise = this.home.rise;
    this.onChange();
  }

  /** Views a whole room of a radius about a point. */
  setHome(target, radius) {
    this.home = {...this.home, target, distance: 1.8 * radius};
    this.reset();
  }

  /** @return the position of the eye. */
  get eye() {
    const flat = this.distance * Math.cos(this.rise);
    return [
      this.target[0] + flat * Math.cos(this.turn),
      this.target[1] + flat * Math.sin(this.turn),
      this.target[2] + this.distance * Math.sin(this.rise),
    ];
  }

  rotate(turn, rise) {
    this.turn += turn;
    this.rise = Math.max(LOWEST, Math.min(HIGHEST, this.rise + rise));
    this.onChange();
  }

  /** Moves the target across the view, in shares of the view's height. */
  pan(right, up) {
    const scale = this.distance * 0.8;
    const [c, s] = [Math.cos(this.turn), Math.sin(this.turn)];
    const tilt = Math.sin(this.rise);
    this.target[0] += scale * (-s * right - c * tilt * up);
    this.target[1] += scale * (c * right - s * tilt * up);
    this.target[2] += scale * Math.cos(this.rise) * up;
    this.onChange();
  }

  zoom(factor) {
    this.distance = Math.max(400, Math.min(40000, this.distance * factor));
    this.onChange();
  }

  down(event) {
    this.element.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
  }

  move(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const here = [event.clientX, event.clientY];
    const height = this.element.clientHeight;
    const [dx, dy] = [(here[0] - before[0]) / height, (here[1] - before[1]) / height];
    if (this.pointers.size === 2)
      this.pinch(event.pointerId, before, here);
    else if (event.shiftKey || event.buttons & 6)
      this.pan(-dx, dy);
    else
      this.rotate(-3 * dx, 3 * dy);
    this.pointers.set(event.pointerId, here);
  }

  pinch(id, before, here) {
    const other = [...this.pointers].find(([key]) => key !== id)[1];
    const spread = (point) => Math.hypot(point[0] - other[0], point[1] - other[1]);
    this.zoom(spread(before) / Math.max(1, spread(here)));
    const height = 2 * this.element.clientHeight;
    this.pan((before[0] - here[0]) / height, (here[1] - before[1]) / height);
  }

  wheel(event) {
    event.preventDefault();
    this.zoom(Math.exp(0.0015 * event.deltaY * (event.deltaMode === 1 ? 30 : 1)));
  }

  /** Handles a key of the view. @return whether it was one. */
  key(key) {
    const small = key.toLowerCase();
    const isShift = key !== small;
    const [x, y] = {a: [-1, 0], d: [1, 0], w: [0, 1], s: [0, -1]}[small] ?? [0, 0];
    if (x || y)
      isShift ? this.pan(KEY_MOVE * x, KEY_MOVE * y) : this.rotate(KEY_TURN * x, KEY_TURN * y);
    else if (key === '+' || key === '=')
      this.zoom(0.9);
    else if (key === '-')
      this.zoom(1 / 0.9);
    else if (key === 'r')
      this.reset();
    else
      return false;
    return true;
  }
}
