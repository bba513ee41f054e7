// Poses of a take, fetched in chunks ahead of playback; the least used are discarded.

const FRAMES = 128;
const MOST_CHUNKS = 40;
const MOST_REQUESTS = 2;
const RETRY_MS = 2000;

export class Chunks {
  /** @param fetchChunk (from, count) → Promise of as many poses. */
  constructor(frameCount, fetchChunk) {
    this.frameCount = frameCount;
    this.fetchChunk = fetchChunk;
    this.chunks = new Map();  // index → poses, in order of use
    this.waiting = new Set();
    this.failedAt = new Map();  // index → time
  }

  /** @return the pose of a frame, or null if it is not loaded. */
  get(frame) {
    const number = Math.floor(frame / FRAMES);
    const chunk = this.chunks.get(number);
    return chunk ? chunk[frame - number * FRAMES] ?? null : null;
  }

  /** Sets the shown frame; fetches missing chunks around it. */
  want(frame, nowMs = performance.now()) {
    const number = Math.floor(frame / FRAMES);
    const chunk = this.chunks.get(number);
    if (chunk) {
      this.chunks.delete(number);
      this.chunks.set(number, chunk);
    }
    for (const next of [number, number + 1, number - 1]) this.request(next, nowMs);
  }

  request(number, nowMs) {
    const from = number * FRAMES;
    if (from < 0 || from >= this.frameCount || this.chunks.has(number)) return;
    if (this.waiting.has(number) || this.waiting.size >= MOST_REQUESTS) return;
    if (nowMs - (this.failedAt.get(number) ?? -Infinity) < RETRY_MS) return;
    this.waiting.add(number);
    this.fetchChunk(from, Math.min(FRAMES, this.frameCount - from))
        .then((poses) => this.keep(number, poses))
        .catch(() => this.failedAt.set(number, nowMs))
        .finally(() => this.waiting.delete(number));
  }

  keep(number, poses) {
    this.failedAt.delete(number);
    this.chunks.set(number, poses);
    if (this.chunks.size > MOST_CHUNKS) this.chunks.delete(this.chunks.keys().next().value);
  }
}
