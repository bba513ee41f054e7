// The timeline of a take: states as bands, error or residual as curves, and the playback position.

import {byId, make, setText} from './dom.js';
import {beginPlot, drawLabel, drawLevel} from './plot.js';
import {fixed} from './text.js';
import {color, figureColor, onTheme} from './theme.js';
import {columnsOf, niceTop, placeAt, quantileOf, runsOf, SPEEDS} from './timeline.js';
import {BRIDGED, STATES} from './wire.js';

const LEFT = 44;
const BAND = 12;
const BAND_GAP = 4;
const CURVES_TOP = 10;
const FOOT = 4;  // height of a foot's marks
const EVENTS = 2 * FOOT + 1;

/** Adds a pattern to a band's range, for people who do not see colours. */
function drawRun(context, state, x, y, width) {
  context.fillStyle = color(`state-${state}`);
  context.fillRect(x, y, width, BAND);
  if (state === 'tracking') return;
  context.save();
  context.beginPath();
  context.rect(x, y, width, BAND);
  context.clip();
  context.strokeStyle = color('surface');
  context.lineWidth = state === 'lost' ? 2.5 : 1;
  context.beginPath();
  const step = state === 'searching' ? 12 : 6;
  for (let at = x - BAND; at < x + width; at += step) {
    context.moveTo(at, y + BAND);
    context.lineTo(at + BAND, y);
  }
  context.stroke();
  context.restore();
}

/** Draws the range of values of each pixel's frames as a line. */
export function drawEnvelope(context, values, {left, width, y, color: style, lineWidth = 1.5}) {
  const columns = Math.max(1, Math.min(values.length, Math.floor(width)));
  context.beginPath();
  let isDown = false;
  columnsOf(values, columns).forEach((column, i) => {
    if (!column) {
      isDown = false;
      return;
    }
    const x = left + (columns === 1 ? 0 : i * width / (columns - 1));
    if (isDown)
      context.lineTo(x, y(column.low));
    else
      context.moveTo(x, y(column.low));
    context.lineTo(x, y(column.high));
    isDown = true;
  });
  context.strokeStyle = style;
  context.lineWidth = lineWidth;
  context.lineJoin = 'round';
  context.stroke();
}

export class TimelineView {
  /** @param take as in /take.json; @param head the PlayHead that is shown and moved. */
  constructor(take, head) {
    this.take = take;
    this.head = head;
    this.canvas = byId('track');
    this.still = null;
    // Without a matching true person there is no error.
    this.hasTruth = take.results.some((result) => result.error_mm.length > 0);
    this.curves = take.results.map(
        ({error_mm: error, residual_mm: residual}) => this.hasTruth ? error : residual);
    const tops = this.curves.map((values) => quantileOf(values, 0.99) ?? 0);
    this.top = niceTop(Math.max(1, ...tops));
    this.hasEvents = take.results.some(({events}) => events.length > 0);
    this.row = BAND + (this.hasEvents ? EVENTS : 0) + BAND_GAP;
    this.curvesTop = take.results.length * this.row + CURVES_TOP;
    this.canvas.style.height = `${this.curvesTop + 72}px`;
    this.canvas.setAttribute('aria-valuemax', head.last);
    this.tellLegend();
    this.bind();
    onTheme(() => this.still = null);
    new ResizeObserver(() => this.still = null).observe(this.canvas);
  }

  tellLegend() {
    setText(
        byId('track-legend'), this.hasTruth ? 'Mean error over the joints [mm]. ' : 'Fit [mm]. ');
    const isBridged = this.take.results.some(({states}) => states.includes(BRIDGED));
    for (const state of STATES.filter((_, i) => i !== BRIDGED || isBridged)) {
      byId('track-legend')
          .append(make(
              'span', {class: 'state-entry'}, make('span', {class: `state-key ${state}`}), state));
    }
    if (!this.hasEvents) return;
    byId('track-legend')
        .append(' Marks: feet strike (long) and leave the floor (short), left above right.');
  }

  bind() {
    const {head} = this;
    const onClick = (id, action) => byId(id).addEventListener('click', action);
    onClick('play', () => head.toggle());
    onClick('step-back', () => head.step(-1));
    onClick('step-on', () => head.step(1));
    onClick('to-begin', () => head.seek(0));
    onClick('to-end', () => head.seek(head.last));
    byId('speed').replaceChildren(...SPEEDS.map(
        (speed) =>
            make('option', {text: `${speed}×`, value: speed, selected: speed === head.speed})));
    byId('speed').addEventListener('change', ({target}) => head.speed = Number(target.value));
    this.canvas.addEventListener('pointerdown', (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      this.wasPlaying = head.playing;
      head.playing = false;
      this.seekTo(event);
    });
    this.canvas.addEventListener('pointermove', (event) => {
      if (event.buttons & 1) this.seekTo(event);
    });
    this.canvas.addEventListener('pointerup', () => head.playing = this.wasPlaying ?? false);
  }

  seekTo(event) {
    const width = this.canvas.clientWidth - LEFT - 1;
    this.head.seek((event.offsetX - LEFT) / width * this.head.last);
  }

  x(frame) {
    return LEFT + (this.canvas.clientWidth - LEFT - 1) * frame / Math.max(1, this.head.last);
  }

  /** Marks of foot strikes and foot offs. */
  drawEvents(context, events, top) {
    context.fillStyle = color('text');
    for (const {time_ms: timeMs, side, event} of events) {
      const x = this.x(placeAt(this.head.timesMs, timeMs));
      const strikes = event === 'Foot Strike';
      const y = top + (side === 'left' ? 0 : FOOT);
      context.fillRect(x - 0.5, y, strikes ? 1.5 : 1, strikes ? FOOT - 0.5 : FOOT / 2);
    }
  }

  drawStill() {
    const {context, width, height} = beginPlot(this.canvas);
    this.take.results.forEach((result, k) => {
      const y = k * this.row;
      context.fillStyle = color(figureColor(k));
      context.fillRect(LEFT - 14, y, 8, BAND);
      for (const {value, from, to} of runsOf(result.states)) {
        // A gap where a person is unknown.
        if (value === null) continue;
        drawRun(context, STATES[value], this.x(from), y, this.x(to) - this.x(from));
      }
      this.drawEvents(context, result.events, y + BAND + 1);
    });
    const room = height - this.curvesTop - 8;
    const y = (value) => height - 4 - room * Math.min(1.04, value / this.top);
    for (const share of [0, 0.5, 1]) {
      drawLevel(context, y(share * this.top), width, color('line'), LEFT);
      drawLabel(
          context, `${share * this.top}`, LEFT - 8, y(share * this.top), color('muted'), 'right');
    }
    this.curves.forEach(
        (values, k) => drawEnvelope(
            context, values,
            {left: LEFT, width: width - LEFT - 1, y, color: color(figureColor(k))}));
    this.still = make('canvas');
    this.still.width = this.canvas.width;
    this.still.height = this.canvas.height;
    this.still.getContext('2d').drawImage(this.canvas, 0, 0);
  }

  draw() {
    if (this.canvas.clientWidth === 0) return;
    if (!this.still) this.drawStill();
    const {context, width, height} = beginPlot(this.canvas);
    context.drawImage(this.still, 0, 0, width, height);
    const x = this.x(this.head.frame + this.head.share);
    context.fillStyle = color('text');
    context.fillRect(x - 1, 0, 2, height);
    context.beginPath();
    context.arc(x, height - 4, 4, 0, 2 * Math.PI);
    context.fill();
    this.tell();
  }

  tell() {
    const {head} = this;
    const seconds = (head.timesMs[head.frame] - head.timesMs[0]) / 1000;
    const text = `frame ${head.frame} of ${head.last} · ${fixed(seconds, 3)} s`;
    setText(byId('frame-text'), text);
    setText(byId('play'), head.playing ? 'Pause' : 'Play');
    byId('speed').value = head.speed;
    if (head.playing || this.saidFrame === head.frame) return;
    this.saidFrame = head.frame;
    this.canvas.setAttribute('aria-valuenow', head.frame);
    this.canvas.setAttribute('aria-valuetext', text);
  }
}
