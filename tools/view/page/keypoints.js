// Keypoints over a camera's picture: what pose networks say of the people in it.

import {color} from './theme.js';

const SHOWN_MS = 1000;
const FAINTEST = 0.15;  // of a score of 0
const POINT_FLOATS = 4;

/** Landmarks that a line joins, by their numbers in core/body/landmarks.h. */
const BONES = [
  [0, 1],   [0, 2],   [1, 3],   [2, 4],   [5, 6],    // face
  [7, 8],   [9, 10],  [9, 20],  [10, 21], [20, 21],  // trunk
  [9, 11],  [11, 13], [13, 17], [13, 15], [15, 17],  // left arm
  [10, 12], [12, 14], [14, 18], [14, 16], [16, 18],  // right arm
  [20, 22], [22, 24], [24, 26], [26, 28], [28, 30],  // left leg
  [21, 23], [23, 25], [25, 27], [27, 29], [29, 31],  // right leg
];

function pointsOf({points}) {
  const byLandmark = new Map();
  for (let at = 0; at + POINT_FLOATS <= points.length; at += POINT_FLOATS) {
    const [landmark, x, y, score] = points.subarray(at, at + POINT_FLOATS);
    // Pixel centres are integers; a canvas counts from the corner.
    byLandmark.set(landmark, {x: x + 0.5, y: y + 0.5, strength: Math.max(FAINTEST, score)});
  }
  return byLandmark;
}

/** @return from 1 to 0 how strongly a view is drawn over a picture of a time. */
export function strengthAt(view, timeMs) {
  return Math.max(0, 1 - Math.max(0, timeMs - view.timeMs) / SHOWN_MS);
}

/** @return the size of a point in pixels of the picture: small on the page where the picture is. */
function sizeAt(scale) {
  return Math.min(1, 0.35 + 0.6 * scale) / scale;
}

function drawView(context, points, strength, style, size, border) {
  context.strokeStyle = style;
  context.fillStyle = style;
  context.lineWidth = (1.3 + border) * size;
  for (const [from, to] of BONES) {
    const [a, b] = [points.get(from), points.get(to)];
    if (!a || !b) continue;
    context.globalAlpha = strength * Math.min(a.strength, b.strength);
    context.beginPath();
    context.moveTo(a.x, a.y);
    context.lineTo(b.x, b.y);
    context.stroke();
  }
  for (const point of points.values()) {
    context.globalAlpha = strength * point.strength;
    context.beginPath();
    context.arc(point.x, point.y, (2.2 + border / 2) * size, 0, 2 * Math.PI);
    context.fill();
  }
}

/**
 * Draws keypoints in pixels of the picture. They fade with their age, and with their score.
 * @param scale of the context: pixels of the page for one of the picture.
 */
export function drawKeypoints(context, {keypoints, timeMs}, scale) {
  context.save();
  context.lineCap = 'round';
  const size = sizeAt(scale);
  for (const view of keypoints) {
    const strength = strengthAt(view, timeMs);
    if (strength === 0) continue;
    const points = pointsOf(view);
    drawView(context, points, strength, 'rgba(0, 0, 0, 0.6)', size, 1.2);
    drawView(context, points, strength, color('keypoint'), size, 0);
  }
  context.restore();
}
