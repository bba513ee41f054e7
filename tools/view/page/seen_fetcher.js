// Pictures and voxels of a take's frame, as they are wanted.

import {decodeAll, decodeSeen} from './wire.js';

const RETRY_MS = 1000;

/** Fetches pictures of the newest requested frame: one request at a time, never a queue. */
export class SeenFetcher {
  /** @param fetchBytes url → promise of its bytes; @param onSeen receives pictures and voxels. */
  constructor(fetchBytes, onSeen) {
    Object.assign(this, {fetchBytes, onSeen});
    this.loaded = '';
    this.isBusy = false;
    this.failedMs = -Infinity;
    this.hasFailed = false;  // the last time
  }

  async want(frame, result) {
    const query = `frame=${frame}&result=${result}`;
    const isTooSoon = performance.now() < this.failedMs + RETRY_MS;
    if (this.isBusy || query === this.loaded || isTooSoon) return;
    this.isBusy = true;
    try {
      const seen = decodeAll(await this.fetchBytes(`/pictures.bin?${query}`), decodeSeen);
      this.loaded = query;
      this.hasFailed = false;
      this.onSeen(seen);
    } catch {
      this.failedMs = performance.now();
      this.hasFailed = true;
    }
    this.isBusy = false;
  }
}
