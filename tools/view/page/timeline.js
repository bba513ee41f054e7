// Computations for a take's timeline: frames by time, bands of states, curves.

/** @return index of the last time at or before `timeMs`, at least 0. */
export function frameAt(timesMs, timeMs) {
  let low = 0;
  let high = timesMs.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (timesMs[middle] <= timeMs)
      low = middle + 1;
    else
      high = middle;
  }
  return Math.max(0, low - 1);
}

/** @return the place of a time among frames, to a part of a frame. */
export function placeAt(timesMs, timeMs) {
  const frame = frameAt(timesMs, timeMs);
  if (frame + 1 >= timesMs.length) return frame;
  const begin = timesMs[frame];
  return frame + Math.max(0, (timeMs - begin) / (timesMs[frame + 1] - begin));
}

export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];

/** Playback position: a time between a take's first and last frame. */
export class PlayHead {
  constructor(timesMs) {
    this.timesMs = timesMs;
    this.timeMs = timesMs[0] ?? 0;
    this.speed = 1;
    this.playing = false;
  }

  get last() {
    return this.timesMs.length - 1;
  }

  /** The frame of the present time, which is shown. */
  get frame() {
    return frameAt(this.timesMs, this.timeMs);
  }

  /** Progress from this frame to the next, 0 to below 1. */
  get share() {
    return placeAt(this.timesMs, this.timeMs) - this.frame;
  }

  /** Starts, from the beginning if at the end; or stops, at a whole frame. */
  toggle() {
    const isStart = !this.playing && this.last > 0;
    this.seek(isStart && this.frame >= this.last ? 0 : this.frame);
    this.playing = isStart;
  }

  seek(frame) {
    this.timeMs = this.timesMs[Math.max(0, Math.min(this.last, Math.round(frame)))] ?? 0;
  }

  /** Stops and moves by whole frames. */
  step(frames) {
    this.playing = false;
    this.seek(this.frame + frames);
  }

  /** Moves the choice of speed up or down. */
  changeSpeed(by) {
    const index = SPEEDS.indexOf(this.speed) + by;
    this.speed = SPEEDS[Math.max(0, Math.min(SPEEDS.length - 1, index))];
  }

  /** Advances by wall time; stops at the last frame. */
  advance(elapsedMs) {
    if (!this.playing) return;
    this.timeMs += elapsedMs * this.speed;
    if (this.timeMs < this.timesMs[this.last]) return;
    this.seek(this.last);
    this.playing = false;
  }
}

/** Merges equal neighbours: [{value, from, to}] with `to` after the last. */
export function runsOf(values) {
  const runs = [];
  values.forEach((value, i) => {
    const last = runs[runs.length - 1];
    if (last && last.value === value)
      last.to = i + 1;
    else
      runs.push({value, from: i, to: i + 1});
  });
  return runs;
}

/** Minimum and maximum of each of `columns` columns; null if a column has no number. */
export function columnsOf(values, columns) {
  const out = new Array(columns).fill(null);
  values.forEach((value, i) => {
    if (!Number.isFinite(value)) return;
    const column = Math.min(columns - 1, Math.floor(i * columns / values.length));
    const seen = out[column];
    if (!seen)
      out[column] = {low: value, high: value};
    else
      out[column] = {low: Math.min(seen.low, value), high: Math.max(seen.high, value)};
  });
  return out;
}

/** @return the next of 1, 2, 5 × 10^n at or above a value: the top of an axis. */
export function niceTop(value) {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].map((step) => step * power).find((top) => top >= value * 0.9999);
}

/** @return the mean of the numbers among the values, or null. */
export function meanOf(values) {
  const numbers = values.filter((value) => Number.isFinite(value));
  return numbers.length > 0 ? numbers.reduce((sum, value) => sum + value, 0) / numbers.length :
                              null;
}

/** @return a quantile of the numbers among the values, or null. */
export function quantileOf(values, share) {
  const numbers = values.filter((value) => Number.isFinite(value)).sort((a, b) => a - b);
  if (numbers.length === 0) return null;
  return numbers[Math.min(numbers.length - 1, Math.floor(share * numbers.length))];
}
