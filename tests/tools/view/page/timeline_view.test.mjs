import assert from 'node:assert/strict';
import test from 'node:test';

import {freshElement} from './fake_page.mjs';

const {drawEnvelope, TimelineView} = await import('../../../../tools/view/page/timeline_view.js');
const {PlayHead} = await import('../../../../tools/view/page/timeline.js');
const TIMES = Array.from({length: 101}, (_, i) => 1000 + 10 * i);
const LEFT = 44;
const IDS = [
  'track', 'track-legend', 'play', 'step-back', 'step-on', 'to-begin', 'to-end', 'speed',
  'frame-text'
];

function open(result = {}) {
  const page = Object.fromEntries(IDS.map((id) => [id, freshElement(id)]));
  page.track.setPointerCapture = () => {};
  const head = new PlayHead(TIMES);
  const whole =
      {states: TIMES.map(() => 2), error_mm: [], residual_mm: TIMES.map(() => 8), events: []};
  const view = new TimelineView({results: [{...whole, ...result}]}, head);
  return {view, head, page};
}

function point(page, name, frame) {
  const offsetX = LEFT + (page.track.clientWidth - LEFT - 1) * frame / 100;
  page.track.dispatchEvent(Object.assign(new Event(name), {offsetX, buttons: 1}));
}

function linesOf(values, width) {
  const calls = [];
  const context = new Proxy(
      {}, {get: (_, name) => (...numbers) => calls.push([name, ...numbers]), set: () => true});
  drawEnvelope(context, values, {left: 0, width, y: (value) => value, color: ''});
  return calls.filter(([name]) => name === 'moveTo' || name === 'lineTo');
}

test('a column has the range of its frames, so that a single bad frame is seen', () => {
  const values = new Array(1000).fill(5);
  values[437] = 90;
  assert.ok(linesOf(values, 100).some(([, , y]) => y === 90));
});

test('where nothing is known the curve has a gap', () => {
  const starts = linesOf([1, 2, null, null, 3], 5).filter(([name]) => name === 'moveTo');
  assert.deepEqual(starts.map(([, x]) => x), [0, 5]);
});

test('the pointer moves through the take, which goes on playing after it', () => {
  const {head, page} = open();
  head.toggle();
  point(page, 'pointerdown', 30);
  assert.equal(head.frame, 30);
  assert.equal(head.playing, false);
  point(page, 'pointermove', 55);
  assert.equal(head.frame, 55);
  point(page, 'pointerup', 55);
  assert.equal(head.playing, true);
  point(page, 'pointerdown', 130);
  assert.equal(head.frame, 100, 'beyond the end is the end');
});

test('buttons play, step and jump', () => {
  const {view, head, page} = open();
  const click = (id) => page[id].dispatchEvent(new Event('click'));
  for (const [id, frame] of [['step-on', 1], ['to-end', 100], ['step-back', 99], ['to-begin', 0]]) {
    click(id);
    assert.equal(head.frame, frame, id);
  }
  click('play');
  view.draw();
  assert.equal(page.play.textContent, 'Pause');
});

test('screen readers hear of a frame once it rests, not of each that passes', () => {
  const {view, head, page} = open();
  head.seek(10);
  view.draw();
  assert.equal(page.track.attributes['aria-valuetext'], 'frame 10 of 100 · 0.100 s');
  head.toggle();
  head.advance(300);
  view.draw();
  assert.equal(page['frame-text'].textContent, 'frame 40 of 100 · 0.400 s');
  assert.equal(page.track.attributes['aria-valuenow'], '10');
});

test('with truth the curve is the error, without it the residual', () => {
  assert.match(open().page['track-legend'].textContent, /^Fit/);
  const withTruth = open({error_mm: TIMES.map(() => 20)});
  assert.match(withTruth.page['track-legend'].textContent, /^Mean error/);
  assert.equal(withTruth.view.top, 20);
});

test('steps are marked where they are, and make room for themselves', () => {
  const without = open();
  assert.doesNotMatch(without.page['track-legend'].textContent, /Marks/);
  const event = (time_ms, side, kind) => ({time_ms, side, event: kind});
  const {view, page} =
      open({events: [event(1125, 'left', 'Foot Strike'), event(1500, 'right', 'Foot Off')]});
  assert.match(page['track-legend'].textContent, /Marks/);
  assert.ok(parseInt(page.track.style.height) > parseInt(without.page.track.style.height));
  const marks = [];
  view.drawEvents({fillRect: (...numbers) => marks.push(numbers)}, view.take.results[0].events, 20);
  assert.deepEqual(marks.map(([x]) => x + 0.5), [12.5, 50].map((frame) => view.x(frame)));
  assert.ok(marks[0][1] < marks[1][1], 'left above right');
  assert.ok(marks[0][3] > marks[1][3], 'strikes are longer');
});
