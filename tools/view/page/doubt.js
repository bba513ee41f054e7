// How sure a pose is, and how its rival is drawn.

/**
 * Below this probability, a pose is in doubt. It is odds of 19 to 1, which the tracker wants before
 * it believes another pose; with less, it does not know.
 */
export const SURE = 0.95;

const DASH_MM = 45;
const GAP_MM = 35;

/** @return whether a pose is known to be in doubt. */
export function isDoubtful(pose) {
  return pose.probability < SURE;
}

/** @return "60 % sure" of a pose in doubt; '' of others. No doubt is rounded away. */
export function doubtText(pose) {
  return isDoubtful(pose) ? `${Math.floor(100 * pose.probability + 1e-4)}\u00a0%\u00a0sure` : '';
}

/** @return a label with the doubt after it, in brackets if there is a label. */
export function withDoubt(label, pose) {
  const doubt = doubtText(pose);
  return label && doubt ? `${label} (${doubt})` : label || doubt;
}

/** @return the dashes of a line between two points: pairs of ends; it begins and ends with one. */
export function dashesOf(a, b) {
  const length = Math.hypot(...a.map((value, axis) => b[axis] - value));
  const count = Math.max(1, Math.round((length + GAP_MM) / (DASH_MM + GAP_MM)));
  const dash = count > 1 ? (length - (count - 1) * GAP_MM) / count : length;
  const at = (mm) =>
      a.map((value, axis) => value + (length > 0 ? mm / length : 0) * (b[axis] - value));
  return Array.from({length: count}, (_, i) => {
    const begin = i * (dash + GAP_MM);
    return [at(begin), at(begin + dash)];
  });
}
