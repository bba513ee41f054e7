// Curves on a canvas: over the last two minutes, or along a take.

import {fitCanvas} from './dom.js';

/** Draws a curve; null values are gaps. */
export function drawCurve(context, values, {x, y, color, width = 1.5, dash = []}) {
  context.beginPath();
  let isDown = false;
  values.forEach((value, i) => {
    if (!Number.isFinite(value)) {
      isDown = false;
      return;
    }
    if (isDown)
      context.lineTo(x(i), y(value));
    else
      context.moveTo(x(i), y(value));
    isDown = true;
  });
  context.strokeStyle = color;
  context.lineWidth = width;
  context.lineJoin = 'round';
  context.setLineDash(dash);
  context.stroke();
  context.setLineDash([]);
}

/** Draws a label of an axis. */
export function drawLabel(context, text, x, y, color, align = 'left') {
  context.font = '11px system-ui, sans-serif';
  context.fillStyle = color;
  context.textAlign = align;
  context.textBaseline = 'middle';
  context.fillText(text, x, y);
}

/** Draws a horizontal line. */
export function drawLevel(context, y, width, color, from = 0) {
  context.beginPath();
  context.moveTo(from, Math.round(y) + 0.5);
  context.lineTo(width, Math.round(y) + 0.5);
  context.strokeStyle = color;
  context.lineWidth = 1;
  context.stroke();
}

/** Clears a canvas. @return its context and its size in CSS pixels. */
export function beginPlot(canvas) {
  const context = fitCanvas(canvas);
  return {context, width: canvas.clientWidth, height: canvas.clientHeight};
}
