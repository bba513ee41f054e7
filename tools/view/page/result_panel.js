// Beside a take: its results with what they say of the present frame, and the error by joint.

import {byId, make, setText} from './dom.js';
import {beginPlot, drawLabel, drawLevel} from './plot.js';
import {fixed, partText} from './text.js';
import {color, figureColor, onTheme} from './theme.js';
import {meanOf, niceTop, quantileOf} from './timeline.js';
import {drawEnvelope} from './timeline_view.js';
import {STATES} from './wire.js';

function swatch(k) {
  return make('span', {class: `swatch ${figureColor(k)}`, 'aria-hidden': 'true'});
}

export class ResultPanel {
  /**
   * @param onShow (key, isOn): shows or hides; @param onOver (k): whose body is drawn over
   *     pictures;
   * @param onApart (isOn): sets results beside each other.
   */
  constructor(take, {onShow, onOver, onApart}) {
    this.take = take;
    this.rows = take.results.map((result, k) => this.makeRow(result, k, onShow, onOver));
    byId('replay-panel')
        .append(make('h2', {text: 'Results'}), ...this.rows.map((row) => row.element));
    if (take.truth) byId('replay-panel').append(this.makeTruth(onShow));
    if (take.results.length > 1) byId('replay-panel').append(this.makeApart(onApart));
    this.tellLegend();
    this.joints = take.results[0]?.joints ?? [];
    if (this.joints.length > 0) this.makeJoints();
    onTheme(() => this.drawJoint());
  }

  tellLegend() {
    const entries = this.take.results.map((result, k) => make('li', {}, swatch(k), result.name));
    if (this.take.truth) {
      entries.push(make('li', {}, make('span', {class: 'swatch truth'}), 'truth'));
    }
    byId('legend').hidden = entries.length < 2;
    byId('legend').replaceChildren(...entries);
  }

  makeRow(result, k, onShow, onOver) {
    const shown = make('input', {type: 'checkbox', checked: ''});
    shown.addEventListener('change', () => onShow(k, shown.checked));
    const over = make('input', {type: 'radio', name: 'over', checked: k === 0});
    over.addEventListener('change', () => onOver(k));
    const row = {state: make('dd'), error: make('dd'), residual: make('dd'), mean: make('dd')};
    const hasError = result.error_mm.length > 0;
    row.element = make(
        'div', {class: 'result'},
        make(
            'label', {class: 'result-name'}, shown, swatch(k), make('strong', {text: result.name})),
        make('label', {class: 'over'}, over, 'over the pictures'),
        make(
            'dl', {class: 'pairs'}, make('dt', {text: 'State'}), row.state,
            ...hasError ?
                [
                  make('dt', {text: 'Error now'}), row.error, make('dt', {text: 'Mean error'}),
                  row.mean
                ] :
                [],
            make('dt', {text: 'Residual'}), row.residual));
    setText(row.mean, `${fixed(meanOf(result.error_mm), 1)} mm`);
    return row;
  }

  makeTruth(onShow) {
    const shown = make('input', {type: 'checkbox', checked: ''});
    shown.addEventListener('change', () => onShow('truth', shown.checked));
    return make(
        'div', {class: 'result'},
        make(
            'label', {class: 'result-name'}, shown, make('span', {class: 'swatch truth'}),
            make('strong', {text: 'truth'})));
  }

  makeApart(onApart) {
    const apart = make('input', {type: 'checkbox'});
    apart.addEventListener('change', () => onApart(apart.checked));
    return make(
        'div', {class: 'result'},
        make('label', {}, apart, 'Side by side; the truth stays with the first'));
  }

  makeJoints() {
    this.joint = this.joints[0];
    this.canvas = make('canvas', {id: 'joint-plot', role: 'img'});
    this.jointTitle = make('p', {class: 'plot-legend'});
    const heads = this.take.results.map(
        (result, k) => make(
            'th', {scope: 'col', title: result.name}, swatch(k),
            make('span', {class: 'unseen', text: result.name})));
    const body = make('tbody');
    this.buttons = this.joints.map((joint) => {
      const button = make('button', {type: 'button', class: 'joint', text: partText(joint)});
      button.addEventListener('click', () => this.choose(joint));
      const means = this.take.results.map((result) => {
        const values = result.joint_error_mm[result.joints.indexOf(joint)] ?? [];
        return make('td', {text: fixed(meanOf(values), 1)});
      });
      body.append(make('tr', {}, make('th', {scope: 'row'}, button), ...means));
      return button;
    });
    byId('replay-panel')
        .append(
            make('h2', {text: 'Error by joint'}), this.jointTitle, this.canvas,
            make(
                'table', {class: 'joints'},
                make(
                    'thead', {},
                    make('tr', {}, make('th', {scope: 'col', text: 'Mean error [mm]'}), ...heads)),
                body));
    new ResizeObserver(() => this.drawJoint()).observe(this.canvas);
    this.choose(this.joint);
  }

  choose(joint) {
    this.joint = joint;
    this.buttons.forEach(
        (button, i) => button.setAttribute('aria-pressed', String(this.joints[i] === joint)));
    setText(this.jointTitle, `${partText(joint)}: error along the take [mm]`);
    this.canvas.setAttribute('aria-label', this.jointTitle.textContent);
    this.drawJoint();
  }

  drawJoint() {
    if (!this.canvas || this.canvas.clientWidth === 0) return;
    const {context, width, height} = beginPlot(this.canvas);
    const curves = this.take.results.map(
        (result) => result.joint_error_mm[result.joints.indexOf(this.joint)] ?? []);
    const top = niceTop(Math.max(1, ...curves.map((values) => quantileOf(values, 0.99) ?? 0)));
    const y = (value) => height - 3 - (height - 12) * Math.min(1.04, value / top);
    for (const share of [0, 0.5, 1]) {
      drawLevel(context, y(share * top), width, color('line'), 32);
      drawLabel(context, `${share * top}`, 26, y(share * top), color('muted'), 'right');
    }
    curves.forEach(
        (values, k) => drawEnvelope(
            context, values, {left: 32, width: width - 33, y, color: color(figureColor(k))}));
    if (this.progress === undefined) return;
    context.fillStyle = color('text');
    context.fillRect(32 + (width - 33) * this.progress - 0.75, 0, 1.5, height);
  }

  /** Tells what results say of a frame. */
  show(frame, last) {
    if (frame === this.frame) return;
    this.frame = frame;
    this.progress = frame / Math.max(1, last);
    this.take.results.forEach((result, k) => {
      setText(this.rows[k].state, STATES[result.states[frame]] ?? '–');
      setText(this.rows[k].error, `${fixed(result.error_mm[frame] ?? NaN, 1)} mm`);
      setText(this.rows[k].residual, `${fixed(result.residual_mm[frame] ?? NaN, 1)} mm`);
    });
    this.drawJoint();
  }
}
