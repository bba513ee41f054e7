// Panel of a take: its results at the present frame, and the error by joint.

import {byId, make, setText} from './dom.js';
import {doubtText} from './doubt.js';
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
   * @param onApart (isOn): shows results side by side.
   */
  constructor(take, {onShow, onOver, onApart}) {
    this.take = take;
    this.rows = take.results.map((result, k) => this.makeRow(result, k, onShow, onOver));
    byId('replay-panel')
        .append(make('h2', {text: 'Results'}), ...this.rows.map((row) => row.element));
    if (take.truth) byId('replay-panel').append(this.makeTruth(onShow));
    const groups = new Set(take.results.map((result) => result.group)).size;
    if (groups > 1) byId('replay-panel').append(this.makeApart(onApart));
    this.tellLegend();
    // With several people, one is shown in detail; results of one person are compared.
    this.compared = take.results.map((_, k) => k);
    this.hasPeople = take.results.some((result) => result.person !== '');
    this.joints = take.results.find((result) => result.joints.length > 0)?.joints ?? [];
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
    const row = {state: make('dd'), error: make('dd'), residual: make('dd'), mean: make('dd')};
    const hasError = result.error_mm.length > 0;
    row.element = make(
        'div', {class: 'result'},
        make(
            'label', {class: 'result-name'}, shown, swatch(k), make('strong', {text: result.name})),
        ...this.makeOver(result, k, onOver),
        make(
            'dl', {class: 'pairs'}, make('dt', {text: 'State'}), row.state,
            ...this.tellTruth(result),
            ...hasError ?
                [
                  make('dt', {text: 'Error now'}), row.error, make('dt', {text: 'Mean error'}),
                  row.mean
                ] :
                [],
            make('dt', {text: 'Fit'}), row.residual));
    setText(row.mean, `${fixed(meanOf(result.error_mm), 1)} mm`);
    return row;
  }

  /** Choice of bodies drawn over pictures: of everyone tracked together. */
  makeOver(result, k, onOver) {
    const first = this.take.results.findIndex(({group}) => group === result.group);
    const isOnlyGroup = this.take.results.every(({group}) => group === result.group);
    if (first !== k || (isOnlyGroup && this.take.results.length > 1)) return [];
    const over = make('input', {type: 'radio', name: 'over', checked: k === 0});
    over.addEventListener('change', () => onOver(k));
    const text = result.person === '' ? 'over the pictures' : 'all of them over the pictures';
    return [make('label', {class: 'over'}, over, text)];
  }

  /** Shows the matching true person, if there are several. */
  tellTruth(result) {
    const people = this.take.truth?.people ?? [];
    if (people.length < 2) return [];
    const text = people[result.true_person] ?? 'nobody';
    return [make('dt', {text: 'True person'}), make('dd', {text})];
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
    this.table = make('table', {class: 'joints'});
    byId('replay-panel')
        .append(
            make('h2', {text: 'Error by joint'}), ...this.hasPeople ? [this.makeChoice()] : [],
            this.jointTitle, this.canvas, this.table);
    new ResizeObserver(() => this.drawJoint()).observe(this.canvas);
    this.compare(this.hasPeople ? [0] : this.compared);
  }

  /** Choice of the errors shown: one person's, or everyone's. */
  makeChoice() {
    const list = make(
        'select', {id: 'joints-of', 'aria-label': 'Whose errors'},
        ...this.take.results.map(({name}, k) => make('option', {text: name, value: k})),
        make('option', {text: 'everybody', value: ''}));
    list.addEventListener('change', () => {
      this.compare(list.value === '' ? this.take.results.map((_, k) => k) : [Number(list.value)]);
    });
    return list;
  }

  /** Fills the table of joints with results, by index. */
  compare(results) {
    this.compared = results;
    const heads = results.map((k) => {
      const {name} = this.take.results[k];
      return make(
          'th', {scope: 'col', title: name}, swatch(k),
          make('span', {class: 'unseen', text: name}));
    });
    const body = make('tbody');
    this.buttons = this.joints.map((joint) => {
      const button = make('button', {type: 'button', class: 'joint', text: partText(joint)});
      button.addEventListener('click', () => this.choose(joint));
      const means =
          results.map((k) => make('td', {text: fixed(meanOf(this.jointErrors(k, joint)), 1)}));
      body.append(make('tr', {}, make('th', {scope: 'row'}, button), ...means));
      return button;
    });
    this.table.replaceChildren(
        make(
            'thead', {},
            make('tr', {}, make('th', {scope: 'col', text: 'Mean error [mm]'}), ...heads)),
        body);
    this.choose(this.joint);
  }

  jointErrors(k, joint) {
    const result = this.take.results[k];
    return result.joint_error_mm[result.joints.indexOf(joint)] ?? [];
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
    const curves = this.compared.map((k) => this.jointErrors(k, this.joint));
    const top = niceTop(Math.max(1, ...curves.map((values) => quantileOf(values, 0.99) ?? 0)));
    const y = (value) => height - 3 - (height - 12) * Math.min(1.04, value / top);
    for (const share of [0, 0.5, 1]) {
      drawLevel(context, y(share * top), width, color('line'), 32);
      drawLabel(context, `${share * top}`, 26, y(share * top), color('muted'), 'right');
    }
    curves.forEach(
        (values, i) => drawEnvelope(
            context, values,
            {left: 32, width: width - 33, y, color: color(figureColor(this.compared[i]))}));
    if (this.progress === undefined) return;
    context.fillStyle = color('text');
    context.fillRect(32 + (width - 33) * this.progress - 0.75, 0, 1.5, height);
  }

  /** Shows the results at a frame. */
  show(frame, last) {
    if (frame === this.frame) return;
    this.frame = frame;
    this.progress = frame / Math.max(1, last);
    this.take.results.forEach((result, k) => {
      const probability = result.probability[frame] ?? NaN;
      const state = STATES[result.states[frame]] ?? '–';
      setText(this.rows[k].state, [state, doubtText({probability})].filter(Boolean).join(', '));
      setText(this.rows[k].error, `${fixed(result.error_mm[frame] ?? NaN, 1)} mm`);
      setText(this.rows[k].residual, `${fixed(result.residual_mm[frame] ?? NaN, 1)} mm`);
    });
    this.drawJoint();
  }
}
