// Descriptions of a camera.

import {fixed, measured, percent} from './text.js';

/** @return a camera's state, or that its silhouettes disagree with the other cameras. */
export function lookOfCamera({state, poor}) {
  return state === 'streaming' && poor.length > 0 ? 'not trusted' : state;
}

/** @return the figures of a camera's line in `mocap status`. */
export function factsOf(camera) {
  const parts = [measured(fixed(camera.frames_per_second, 1), '/s')];
  if (camera.trust !== null) {
    parts.push(`trust ${percent(camera.trust)}`);
    if (camera.off_px !== null) parts.push(`off ${measured(fixed(camera.off_px, 1), 'px')}`);
  }
  if (camera.light !== null) parts.push(`light ${percent(camera.light)}`);
  for (const [key, name] of [['dropped', 'dropped'], ['late', 'late'], ['torn', 'damaged']]) {
    if (camera[key] > 0) parts.push(`${name} ${camera[key]}`);
  }
  return parts.join(' · ');
}
