// Formats numbers for people.

/** @return a number with fixed decimals; an en dash if there is none. */
export function fixed(value, places = 0) {
  return Number.isFinite(value) ? value.toFixed(places) : '–';
}

/** @return a number and its unit, without a line break between them. */
export function measured(number, unit) {
  return `${number}\u00a0${unit}`;
}

/** @return a share as a percentage. */
export function percent(share) {
  return Number.isFinite(share) ? measured(Math.round(100 * share), '%') : '–';
}

function counted(count, unit) {
  return `${count} ${unit}${count === 1 ? '' : 's'}`;
}

/** @return an age in the largest unit that fits: "3 days". */
export function ageText(seconds) {
  if (!(seconds >= 0)) return 'unknown';
  if (seconds < 90) return counted(Math.round(seconds), 'second');
  if (seconds < 90 * 60) return counted(Math.round(seconds / 60), 'minute');
  if (seconds < 36 * 3600) return counted(Math.round(seconds / 3600), 'hour');
  return counted(Math.round(seconds / 86400), 'day');
}

/** @return a duration in clock format: "1:02:03". */
export function clockText(seconds) {
  const whole = Math.max(0, Math.floor(seconds));
  const parts = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  if (parts[0] === 0) parts.shift();
  return parts.map((part, i) => i === 0 ? `${part}` : `${part}`.padStart(2, '0')).join(':');
}

/** @return bytes in the unit that fits: "412 GB". */
export function bytesText(bytes) {
  if (!Number.isFinite(bytes)) return '–';
  let value = bytes;
  for (const unit of ['bytes', 'kB', 'MB', 'GB']) {
    if (value < 1000)
      return `${unit === 'bytes' || value >= 100 ? Math.round(value) : value.toFixed(1)} ${unit}`;
    value /= 1000;
  }
  return `${value.toFixed(1)} TB`;
}

/** @return an identifier as words: "upper_arm_l" → "upper arm left". */
export function partText(name) {
  return String(name).replace(/_l$/, ' left').replace(/_r$/, ' right').replaceAll('_', ' ');
}

/** @return a text without its numbers, to detect whether something new is said. */
export function withoutNumbers(text) {
  return String(text).replace(/\d+([.,]\d+)?/g, '#');
}
