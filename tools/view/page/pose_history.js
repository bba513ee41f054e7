// Recent poses of one person, interpolated at any time.

const KEEP_MS = 3000;
const MOST_POSES = 1000;
// Across a longer gap, interpolation would be invention.
const LONGEST_GAP_MS = 250;

function mix(a, b, share) {
  const out = new Float32Array(a.length);
  for (let i = 0; i < out.length; ++i) out[i] = a[i] + share * (b[i] - a[i]);
  return out;
}

/** @return the pose between `a` and `b`: linear if both have one, else the earlier. */
export function interpolate(a, b, share) {
  const canMix = a.hasPose && b.hasPose && a.capsules.length === b.capsules.length &&
      b.timeMs - a.timeMs <= LONGEST_GAP_MS;
  if (share <= 0 || !canMix) return a;
  if (share >= 1) return b;
  return {
    ...a,
    timeMs: a.timeMs + share * (b.timeMs - a.timeMs),
    frame: a.frame + share * (b.frame - a.frame),
    points: mix(a.points, b.points, share),
    capsules: mix(a.capsules, b.capsules, share),
    contacts: mix(a.contacts, b.contacts, share),
    rival: a.rival && b.rival ? {...a.rival, points: mix(a.rival.points, b.rival.points, share)} :
                                a.rival,
  };
}

export class PoseHistory {
  constructor() {
    this.poses = [];
  }

  get newest() {
    return this.poses[this.poses.length - 1] ?? null;
  }

  /** Adds a pose. One older than the newest means that the clock restarted. */
  add(pose) {
    if (this.newest && pose.timeMs <= this.newest.timeMs) {
      if (this.newest.timeMs - pose.timeMs < 1000) return;
      this.poses = [];
    }
    this.poses.push(pose);
    const oldest = pose.timeMs - KEEP_MS;
    let drop = Math.max(0, this.poses.length - MOST_POSES);
    while (this.poses[drop].timeMs < oldest) ++drop;
    if (drop > 0) this.poses.splice(0, drop);
  }

  /** @return index of the last pose at or before a time, -1 if there is none. */
  indexAt(timeMs) {
    let low = 0;
    let high = this.poses.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.poses[middle].timeMs <= timeMs)
        low = middle + 1;
      else
        high = middle;
    }
    return low - 1;
  }

  /** @return the pose at a capture time; before the oldest and after the newest, that one. */
  at(timeMs) {
    if (this.poses.length === 0) return null;
    const index = this.indexAt(timeMs);
    if (index < 0) return this.poses[0];
    const a = this.poses[index];
    const b = this.poses[index + 1];
    return b ? interpolate(a, b, (timeMs - a.timeMs) / (b.timeMs - a.timeMs)) : a;
  }

  /** @return the newest pose with a body captured at or before a time, or null. */
  lastBody(timeMs) {
    for (let i = this.indexAt(timeMs); i >= 0; --i) {
      if (this.poses[i].hasPose) return this.poses[i];
    }
    return null;
  }

  /** @return the received pose of a frame number, or null. */
  ofFrame(frame) {
    return this.poses.find((pose) => pose.frame === frame) ?? null;
  }

  /** @return the poses between two times, for a trail. */
  between(fromMs, toMs) {
    return this.poses.slice(this.indexAt(fromMs) + 1, this.indexAt(toMs) + 1);
  }
}
