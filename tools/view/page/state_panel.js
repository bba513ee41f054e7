// State panel: the state, whether all is good, the diagnostics verbatim, and the figures.

import {byId, make, setText} from './dom.js';
import {doubtText} from './doubt.js';
import {ageText, bytesText, clockText, fixed, partText, percent, withoutNumbers} from './text.js';

/** What the figures show of a status as `mocap status --json` has it. */
const FIGURES = {
  'rate': (status) => fixed(status.sets_per_second, 1),
  'nominal': (status) => `of ${fixed(status.fps_nominal, 0)}`,
  'dropped': (status) => status.sets_dropped,
  'partial': (status) => status.sets_partial,
  'spread': (status) => `${fixed(status.spread.p50_ms, 2)} ms`,
  'camera-count': ({cameras}) =>
      `${cameras.filter(({state}) => state === 'streaming').length} of ${cameras.length}`,
  'disk': (status) => bytesText(status.bytes_free),
  'calibration': (status, nowS) => madeText(status.calibration, nowS),
  'background': (status, nowS) => madeText(status.background, nowS),
  'up': (status) => ageText(status.up_seconds),
  'version': (status) => `mocapd ${status.version}`,
  'recording-text': ({recording}) => recordingText(recording),
};

function madeText({made_s: madeS}, nowS) {
  return madeS > 0 ? `${ageText(nowS - madeS)} old` : 'age unknown';
}

function recordingText({state, folder, seconds, dropped}) {
  const name = folder.split('/').filter((part) => part !== '').at(-1) ?? '';
  const words = {running: 'recording', complete: 'recorded', failed: 'recording failed'}[state];
  const lost = dropped > 0 ? `, ${dropped} frames dropped` : '';
  return `${words ?? ''} ${name} · ${clockText(seconds)}${lost}`;
}

/** The main message: {tone: 'ok' | 'warn' | 'bad' | 'muted', text, lines}. Pure, for tests. */
export function conclusionOf({isOpen, sinceClosedS, silence, serviceAgeS, poseAgeS, complaints}) {
  if (!isOpen) {
    const since = sinceClosedS >= 2 ? ` for ${ageText(sinceClosedS)}` : '';
    return {tone: 'bad', text: `No connection to mocap view${since}. Retrying.`, lines: []};
  }
  if (silence) return {tone: 'bad', text: silence, lines: []};
  if (serviceAgeS === null) return {tone: 'muted', text: 'Waiting for mocapd.', lines: []};
  if (serviceAgeS > 3.5) {
    return {
      tone: 'bad',
      text: `Nothing received from mocapd for ${ageText(serviceAgeS)}.`,
      lines: complaints
    };
  }
  if (complaints.length > 0) return {tone: 'warn', text: '', lines: complaints};
  if (poseAgeS === null || poseAgeS > 1) {
    return {
      tone: 'bad',
      lines: [],
      text: poseAgeS === null ? 'No pose received yet.' :
                                `No pose received for ${ageText(poseAgeS)}.`
    };
  }
  return {tone: 'ok', text: 'all is good', lines: []};
}

function makePersonRow() {
  const who = make(
      'th', {scope: 'row'}, make('span', {class: 'swatch', 'aria-hidden': 'true'}), make('span'));
  return make('tr', {}, who, make('td'), make('td'), make('td'));
}

function tellPerson(row, {color, label, state, doubt, residualMm, followedS, hasCome}) {
  const [who, stateCell, fit, since] = row.children;
  const [swatch, name] = who.children;
  swatch.className = `swatch ${color}`;
  setText(name, label);
  setText(stateCell, doubt ? `${state}, ${doubt}` : state);
  setText(fit, fixed(residualMm ?? NaN, 1));
  const age = ageText(followedS);
  setText(since, hasCome || followedS === null ? age : `≥ ${age}`);
}

function makeSenderRow() {
  return make('tr', {}, make('th', {scope: 'row'}), make('td'), make('td'), make('td'));
}

function tellSender(row, {name, views_per_second: rate, lag_ms: lagMs, agreement, poor}) {
  const [who, rateCell, lag, agrees] = row.children;
  setText(who, name);
  setText(rateCell, fixed(rate, 1));
  setText(lag, fixed(lagMs));
  setText(agrees, agreement === null ? '–' : percent(agreement));
  agrees.dataset.tone = poor.includes('agreement') ? 'warn' : '';
}

/** Tells rows of a table; adds and removes lines as needed. */
function tellRows(list, rows, makeRow, tellRow) {
  while (list.children.length > rows.length) list.lastChild.remove();
  while (list.children.length < rows.length) list.append(makeRow());
  rows.forEach((row, i) => tellRow(list.children[i], row));
}

export class StatePanel {
  constructor() {
    this.said = '';
    this.word = '';
  }

  /** Shows the name of the state. */
  setState(state) {
    if (this.word === state) return;
    this.word = state;
    setText(byId('state-word'), state);
    byId('state').dataset.state = state;
  }

  setConclusion({tone, text, lines}) {
    const block = byId('conclusion');
    block.dataset.tone = tone;
    setText(byId('conclusion-text'), text);
    byId('conclusion-text').hidden = text === '';
    const list = byId('complaints');
    while (list.children.length > lines.length) list.lastChild.remove();
    lines.forEach((line, i) => {
      if (!list.children[i]) list.append(make('li'));
      setText(list.children[i], line);
    });
    this.say([text, ...lines]);
  }

  /** Announces changes to screen readers, except changed numbers. */
  say(lines) {
    const said = withoutNumbers(lines.join('\n'));
    if (said === this.said) return;
    this.said = said;
    setText(byId('announce'), lines.filter((line) => line !== '').join('. '));
  }

  /** Shows notices that are not diagnostics, such as why there are no pictures. */
  setNotice({pictures}) {
    setText(byId('no-pictures'), pictures);
    byId('no-pictures').hidden = pictures === '';
  }

  setStatus(status, serverNowS) {
    for (const [id, text] of Object.entries(FIGURES)) setText(byId(id), text(status, serverNowS));
    byId('disk').dataset.tone = status.poor.includes('bytes_free') ? 'warn' : '';
    byId('calibration').title = status.calibration.where;
    byId('background').title = status.background.where;
    byId('recording').hidden = status.recording.state === 'none';
    byId('recording').dataset.state = status.recording.state;
    byId('senders').hidden = status.keypoints.length === 0;
    tellRows(byId('sender-list'), status.keypoints, makeSenderRow, tellSender);
  }

  /** @param pose the newest pose; null if nobody is present. */
  setFit(pose) {
    setText(byId('fit'), pose ? fixed(pose.residualMm, 1) : '–');
    setText(byId('doubt'), pose ? doubtText(pose) : '');
    setText(byId('voxel-count'), pose ? pose.voxels : '–');
  }

  /** Shows each of several people; the rest of the panel shows a single person. */
  setPeople(rows) {
    byId('people').hidden = rows.length < 2;
    setText(byId('sizes-of'), rows.length < 2 ? 'Subject' : rows[0].label);
    tellRows(byId('people-list'), rows, makePersonRow, tellPerson);
  }

  setBody(body) {
    byId('sizes').hidden = false;
    setText(byId('stature'), `${fixed(body.stature_mm)} mm`);
    const rows = Object.entries(body.sizes)
                     .map(([name, value]) => [make('dt', {text: partText(name)}), make('dd', {
                                                text: `${fixed(value)} mm`
                                              })]);
    byId('size-list').replaceChildren(...rows.flat());
    const legend = body.part_names.map(
        (name, i) => make('li', {}, make('span', {class: `swatch part-${i}`}), partText(name)));
    byId('part-legend').replaceChildren(...legend);
  }
}
