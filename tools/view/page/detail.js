// How finely and how often the scene is drawn: as finely as the machine can draw it smoothly.

const WINDOW = 30;  // intervals that are looked at together
const SLOW_MS = 45;
const PAUSE_MS = 1000;  // a longer interval is a hidden page, not a slow one
const FAST_MS = 25;
const STEP = 0.75;
const LEAST = 0.5;
const FIRST_PATIENCE_MS = 60000;  // before it is tried more finely again; twice as long each time
const SOFTWARE_START = 0.6;
const SOFTWARE_PACE_MS = 100;  // between frames: the processor that draws has other work as well
const EARLY_MS = 5;           // a display's refresh is not exact

/** @return whether WebGL is drawn by the processor: then each pixel counts. */
export function drawsInSoftware() {
  const gl = document.createElement('canvas').getContext('webgl');
  if (!gl) return false;
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software/i.test(name);
}

export class Detail {
  /** @param isFixed draws every pixel, whatever it costs: for a picture of the page. */
  constructor({isSoftware, isFixed}) {
    this.isFixed = isFixed;
    this.scale = isSoftware && !isFixed ? SOFTWARE_START : 1;
    this.finest = this.scale;
    this.paceMs = isSoftware && !isFixed ? SOFTWARE_PACE_MS : 0;
    this.intervals = [];
    this.lastMs = null;
    this.coarserMs = null;
    this.patienceMs = FIRST_PATIENCE_MS;
  }

  /** Pixels drawn for each CSS pixel, along an edge. */
  ratio(devicePixelRatio) {
    return this.scale * Math.min(2, devicePixelRatio || 1);
  }

  /** @return whether a frame is to be drawn, when the display asks for one. */
  isDue(nowMs) {
    return this.lastMs === null || nowMs - this.lastMs >= this.paceMs - EARLY_MS;
  }

  /** Takes the time at which a frame is drawn. @return whether the scale has changed. */
  tick(nowMs) {
    const interval = nowMs - (this.lastMs ?? nowMs);
    this.lastMs = nowMs;
    if (interval > 0 && interval < PAUSE_MS) this.intervals.push(interval);
    if (this.intervals.length < WINDOW) return false;
    const mean = this.intervals.reduce((sum, value) => sum + value, 0) / this.intervals.length;
    this.intervals = [];
    return !this.isFixed && (this.goCoarser(mean, nowMs) || this.goFiner(mean, nowMs));
  }

  goCoarser(meanMs, nowMs) {
    if (meanMs < this.paceMs + SLOW_MS || this.scale <= LEAST) return false;
    this.scale = Math.max(LEAST, STEP * this.scale);
    this.coarserMs = nowMs;
    return true;
  }

  // What was slow may have been another program's fault, for a while.
  goFiner(meanMs, nowMs) {
    if (meanMs > this.paceMs + FAST_MS || this.scale >= this.finest) return false;
    if (nowMs - this.coarserMs < this.patienceMs) return false;
    this.scale = Math.min(this.finest, this.scale / STEP);
    this.coarserMs = nowMs;
    this.patienceMs *= 2;
    return true;
  }
}
