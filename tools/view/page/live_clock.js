// Selects the capture time to show. The browser's and the server's clocks may differ arbitrarily.
// The offset is the smallest difference between a pose's arrival and its publication.

const OFFSET_BUCKET_MS = 10000;
const OFFSET_BUCKETS = 6;
const LAGS = 200;
const LAG_WINDOW_MS = 3000;
const LARGEST_AGE_MS = 240;
const JUMP_MS = 150;
const SLEW = 0.1;
const PUT_BACK_MS = 100;  // Messages may overtake each other by less.

function quantile(sorted, share) {
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
}

export class LiveClock {
  constructor() {
    this.reset();
  }

  /** Resets everything, as after a reconnection: the server may be another one. */
  reset() {
    this.buckets = [];   // {number, offset}: smallest offset of each ten seconds
    this.arrivals = [];  // {nowMs, lag, timeMs}
    this.publishMs = -Infinity;
    this.delay = null;  // browser time minus the shown capture time
    this.lastMs = null;
  }

  get isKnown() {
    return this.buckets.length > 0;
  }

  /**
   * Adds the arrival of a message with its capture and publication times.
   * @return whether the server's clock was set back: earlier times are then meaningless.
   */
  arrived(nowMs, timeMs, publishMs) {
    const wasPutBack = publishMs < this.publishMs - PUT_BACK_MS;
    if (wasPutBack) this.reset();
    this.publishMs = publishMs;
    const number = Math.floor(nowMs / OFFSET_BUCKET_MS);
    const offset = nowMs - publishMs;
    const last = this.buckets[this.buckets.length - 1];
    if (last && last.number === number)
      last.offset = Math.min(last.offset, offset);
    else
      this.buckets.push({number, offset});
    while (this.buckets[0].number <= number - OFFSET_BUCKETS) this.buckets.shift();

    this.arrivals.push({nowMs, lag: nowMs - timeMs, timeMs});
    while (this.arrivals.length > LAGS || this.arrivals[0].nowMs < nowMs - LAG_WINDOW_MS) {
      this.arrivals.shift();
    }
    return wasPutBack;
  }

  /** @return the server's time for a browser time. */
  serverNow(nowMs) {
    return nowMs - Math.min(...this.buckets.map((bucket) => bucket.offset));
  }

  /** Returns the delay at which the next pose has nearly always arrived. */
  wantedDelay() {
    const lags = this.arrivals.map((arrival) => arrival.lag).sort((a, b) => a - b);
    const gaps = [];
    for (let i = 1; i < this.arrivals.length; ++i) {
      const gap = this.arrivals[i].timeMs - this.arrivals[i - 1].timeMs;
      if (gap > 0) gaps.push(gap);
    }
    gaps.sort((a, b) => a - b);
    const wanted = quantile(lags, 0.95) + (gaps.length > 0 ? quantile(gaps, 0.5) : 0);
    const offset = Math.min(...this.buckets.map((bucket) => bucket.offset));
    return Math.max(lags[0], Math.min(wanted, offset + LARGEST_AGE_MS));
  }

  /** @return the capture time to show; its rate varies by at most a tenth. */
  showTime(nowMs) {
    if (this.arrivals.length === 0) return null;
    const wanted = this.wantedDelay();
    if (this.delay === null || Math.abs(wanted - this.delay) > JUMP_MS) {
      this.delay = wanted;
    } else {
      const most = SLEW * Math.max(0, nowMs - this.lastMs);
      this.delay += Math.max(-most, Math.min(most, wanted - this.delay));
    }
    this.lastMs = nowMs;
    return nowMs - this.delay;
  }
}
