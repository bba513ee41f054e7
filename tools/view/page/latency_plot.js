// Latency by stage over the last two minutes: a large plot of the total, small ones for the stages.

import {byId, make, setText} from './dom.js';
import {beginPlot, drawCurve, drawLabel, drawLevel} from './plot.js';
import {fixed} from './text.js';
import {color, onTheme} from './theme.js';
import {niceTop} from './timeline.js';

const SECONDS = 120;
const ROWS = ['segment', 'carve', 'label', 'filter', 'total', 'publish'];
export const STAGES = [...ROWS, 'latency'];

export class LatencyPlot {
  constructor() {
    this.series = new Map();  // stage → [{p50, p99}], one per second
    this.canvas = byId('latency-plot');
    this.rows = new Map();
    onTheme(() => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  /** Adds the stages of a status. */
  take(stages) {
    for (const {name, count, p50_ms: p50, p99_ms: p99} of stages) {
      if (!this.series.has(name) && this.series.size > 32) continue;
      const series = this.series.get(name) ?? [];
      series.push(count > 0 ? {p50, p99} : {p50: null, p99: null});
      if (series.length > SECONDS) series.shift();
      this.series.set(name, series);
    }
    this.tell();
    this.draw();
  }

  tell() {
    const last = this.series.get('latency')?.at(-1);
    setText(byId('latency-p50'), fixed(last?.p50, 1));
    setText(byId('latency-p99'), fixed(last?.p99, 1));
    for (const name of ROWS.filter((stage) => this.series.has(stage))) {
      const {p50, p99} = this.series.get(name).at(-1);
      const row = this.row(name);
      setText(row.p50, fixed(p50, 1));
      setText(row.p99, fixed(p99, 1));
    }
  }

  row(name) {
    if (!this.rows.has(name)) {
      const row = {
        canvas: make('canvas', {'aria-hidden': 'true'}),
        p50: make('td'),
        p99: make('td')
      };
      byId('stages').append(make(
          'tr', {}, make('th', {scope: 'row', text: name}), make('td', {}, row.canvas), row.p50,
          row.p99));
      this.rows.set(name, row);
    }
    return this.rows.get(name);
  }

  draw() {
    this.drawWhole();
    for (const [name, {canvas}] of this.rows) {
      const {context, width, height} = beginPlot(canvas);
      const series = this.series.get(name);
      const top = Math.max(...series.map((value) => value.p99 ?? 0), 1e-3);
      this.drawSeries(context, series, width, height - 2, top * 1.1, 0);
    }
  }

  drawSeries(context, series, width, height, top, left) {
    const x = (i) => left + (width - left) * (SECONDS - series.length + i) / (SECONDS - 1);
    const y = (value) => height - (height - 2) * Math.min(1, value / top);
    drawCurve(
        context, series.map((value) => value.p99),
        {x, y, color: color('muted'), dash: [2, 2], width: 1});
    drawCurve(
        context, series.map((value) => value.p50), {x, y, color: color('accent'), width: 1.75});
  }

  drawWhole() {
    const {context, width, height} = beginPlot(this.canvas);
    const series = this.series.get('latency') ?? [];
    const top = niceTop(Math.max(...series.map((value) => value.p99 ?? 0), 10));
    const bottom = height - 16;
    for (const share of [0, 0.5, 1]) {
      const y = bottom - share * (bottom - 8);
      drawLevel(context, y, width, color('line'), 34);
      drawLabel(context, `${top * share}`, 28, y, color('muted'), 'right');
    }
    const plotted = series.length;
    const x = (i) => 34 + (width - 34) * (SECONDS - plotted + i) / (SECONDS - 1);
    const y = (value) => bottom - (bottom - 8) * Math.min(1, value / top);
    drawCurve(
        context, series.map((value) => value.p99),
        {x, y, color: color('muted'), dash: [3, 2], width: 1.25});
    drawCurve(context, series.map((value) => value.p50), {x, y, color: color('accent'), width: 2});
    drawLabel(context, '2 min ago', 34, height - 5, color('muted'));
    drawLabel(context, 'now', width, height - 5, color('muted'), 'right');
  }
}
