import assert from 'node:assert/strict';
import test from 'node:test';

import {freshElement} from './fake_page.mjs';

const {StatePanel} = await import('../../../../tools/view/page/state_panel.js');

const STATUS = {
  version: '1.2',
  up_seconds: 7200,
  fps_nominal: 30,
  sets_per_second: 29.96,
  sets_partial: 2,
  sets_dropped: 1,
  spread: {p50_ms: 0.25},
  cameras: [{state: 'streaming'}, {state: 'lost'}],
  calibration: {where: '/etc/c.toml', made_s: 1000},
  background: {where: '/var/b', made_s: 0},
  bytes_free: 4e9,
  recording: {state: 'running', folder: '/takes/walk', seconds: 65, dropped: 3},
  keypoints: [],
  poor: ['bytes_free'],
};

function open(status) {
  const page = {};
  for (const id
           of ['rate', 'nominal', 'dropped', 'partial', 'spread', 'camera-count', 'disk',
               'calibration', 'background', 'up', 'version', 'recording', 'recording-text'])
    page[id] = freshElement(id);
  new StatePanel().setStatus(status, 1000 + 3 * 86400);
  return page;
}

test('the figures are those of the status', () => {
  const page = open(STATUS);
  const texts = Object.entries(page).map(([id, {textContent}]) => [id, textContent]);
  assert.deepEqual(Object.fromEntries(texts.filter(([id]) => id !== 'recording')), {
    'rate': '30.0',
    'nominal': 'of 30',
    'dropped': '1',
    'partial': '2',
    'spread': '0.25 ms',
    'camera-count': '1 of 2',
    'disk': '4.0 GB',
    'calibration': '3 days old',
    'background': 'age unknown',
    'up': '2 hours',
    'version': 'mocapd 1.2',
    'recording-text': 'recording walk · 1:05, 3 frames dropped',
  });
  assert.equal(page.calibration.title, '/etc/c.toml');
});

test('a disk that is nearly full is marked', () => {
  assert.equal(open(STATUS).disk.dataset.tone, 'warn');
  assert.equal(open({...STATUS, poor: []}).disk.dataset.tone, '');
});

test('a recording is told while there is one', () => {
  const page = open(STATUS);
  assert.deepEqual([page.recording.hidden, page.recording.dataset.state], [false, 'running']);
  assert.ok(open({...STATUS, recording: {...STATUS.recording, state: 'none'}}).recording.hidden);
});

test('who sends keypoints is listed, and who disagrees is marked', () => {
  const sender = {name: 'witness', views_per_second: 2.96, lag_ms: 240.4, agreement: 0.2};
  const other = {name: 'lab', views_per_second: 30, lag_ms: 12, agreement: null, poor: []};
  const [section, list] = ['senders', 'sender-list'].map(freshElement);
  open({...STATUS, keypoints: [{...sender, poor: ['agreement']}, other]});
  assert.equal(section.hidden, false);
  const [first, second] = list.children.map(({children}) => children);
  assert.deepEqual(
      first.map(({textContent}) => textContent), ['witness', '3.0', '240', '20\u00a0%']);
  assert.equal(first[3].dataset.tone, 'warn');
  assert.equal(second[3].textContent, '–');
  assert.equal(second[3].dataset.tone, '');
  freshElement('sender-list');
  open(STATUS);
  assert.ok(section.hidden);
});
