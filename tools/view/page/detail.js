// Resolution and rate of drawing: as high as the machine can draw smoothly.

const WINDOW = 30;  // intervals that are averaged
const SLOW_MS = 45;
const PAUSE_MS = 1000;  // longer intervals mean a hidden page, not slow drawing
const FAST_MS = 25;
const STEP = 0.75;
const LEAST = 0.5;
const FIRST_PATIENCE_MS = 60000;  // before a finer scale is tried again; doubled each time
const SOFTWARE_START = 0.6;
const SOFTWARE_PACE_MS = 100;  // between frames: the processor has other work, too
const EARLY_MS = 5;           // tolerance for the display's refresh

/** @return whether the processor draws WebGL: then each pixel counts. */
export function drawsInSoftware() {
  const gl = document.createElement('canvas').getContext('webgl');
  if (!gl) return false;
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software/i.test(name);
}

export class Detail {
  /** @param isFixed draw every pixel, whatever it costs: for a picture of the page. */
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

  /** Drawn pixels per CSS pixel, along an edge. */
  ratio(devicePixelRatio) {
    return this.scale * Math.min(2, devicePixelRatio || 1);
  }

  /** @return whether to draw a frame when the display asks for one. */
  isDue(nowMs) {
    return this.lastMs === null || nowMs - this.lastMs >= this.paceMs - EARLY_MS;
  }

  /** Takes the time of a drawn frame. @return whether the scale has changed. */
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

  // Another program may have slowed drawing for a while.
  goFiner(meanMs, nowMs) {
    if (meanMs > this.paceMs + FAST_MS || this.scale >= this.finest) return false;
    if (nowMs - this.coarserMs < this.patienceMs) return false;
    this.scale = Math.min(this.finest, this.scale / STEP);
    this.coarserMs = nowMs;
    this.patienceMs *= 2;
    return true;
  }
}
