import './three_of_debian.mjs';

import assert from 'node:assert/strict';
import test from 'node:test';

import {FakeElement} from './fake_page.mjs';

const {Pictures} = await import('../../../../tools/view/page/pictures.js');
const CAMERAS = ['front', 'left'].map((name) => ({name, size_px: [640, 480]}));

function settle() {
  return new Promise((resolve) => setImmediate(resolve));
}

/** A strip whose pictures are decoded by hand. */
function open() {
  const decoding = [];
  globalThis.createImageBitmap = () =>
      new Promise((decoded, failed) => decoding.push({done: () => decoded({close() {}}), failed}));
  const chosen = [];
  const pictures = new Pictures(new FakeElement('ul'), (name) => chosen.push(name));
  pictures.setCameras(CAMERAS);
  return {pictures, decoding, chosen};
}

function picture(timeMs, camera = 0, more = {}) {
  return {
    camera,
    timeMs,
    widthPx: 640,
    heightPx: 480,
    jpeg: new Uint8Array(2),
    silhouette: [],
    unknown: [],
    unknownShare: -1,
    body: [],
    keypoints: [],
    ...more
  };
}

test('while one picture is decoded only the newest waits', async () => {
  const {pictures, decoding} = open();
  for (const timeMs of [1, 2, 3, 4]) pictures.take(picture(timeMs));
  assert.equal(decoding.length, 1);
  decoding[0].done();
  await settle();
  assert.equal(decoding.length, 2);
  decoding[1].done();
  await settle();
  assert.equal(pictures.card('front').picture.timeMs, 4);
  assert.equal(decoding.length, 2);
});

test('a damaged picture leaves the last one, and the next is decoded', async () => {
  const {pictures, decoding} = open();
  for (const [timeMs, end] of [[1, 'done'], [2, 'failed'], [3, 'done']]) {
    pictures.take(picture(timeMs));
    decoding.at(-1)[end]();
    await settle();
    assert.equal(pictures.card('front').picture.timeMs, end === 'failed' ? 1 : timeMs);
  }
});

test('a picture of no camera is ignored', () => {
  const {pictures, decoding} = open();
  pictures.take(picture(1, 9));
  assert.equal(decoding.length, 0);
});

test('the same cameras keep their pictures, others begin anew', async () => {
  const {pictures, decoding} = open();
  pictures.take(picture(1));
  decoding[0].done();
  await settle();
  pictures.setCameras(CAMERAS.map((camera) => ({...camera})));
  assert.equal(pictures.card('front').picture.timeMs, 1);
  pictures.setCameras([{name: 'front', size_px: [1920, 1080]}]);
  assert.equal(pictures.card('front').picture, null);
});

test('lines lie on pixel centres, scaled to the size of the page', async () => {
  const {pictures, decoding} = open();
  const line = {points: Float32Array.from([0, 0, 320, 240, 320, 0]), side: 0, person: 2};
  pictures.take(picture(1, 0, {body: [line]}));
  decoding[0].done();
  await settle();
  pictures.draw();
  const {calls} = pictures.card('front').canvas.context;
  assert.deepEqual(calls.find(([name]) => name === 'scale'), ['scale', 200 / 640, 100 / 480]);
  assert.deepEqual(
      calls.filter(([name]) => name.endsWith('To')).slice(0, 3),
      [['moveTo', 0.5, 0.5], ['lineTo', 320.5, 240.5], ['lineTo', 320.5, 0.5]]);
});

test('unknown pixels are hatched within their lines, people are not', async () => {
  const line = {points: Float32Array.from([0, 0, 320, 240, 320, 0])};
  for (const [part, clips] of [['unknown', 1], ['silhouette', 0]]) {
    const {pictures, decoding} = open();
    pictures.take(picture(1, 0, {[part]: [line]}));
    decoding[0].done();
    await settle();
    pictures.draw();
    const {calls} = pictures.card('front').canvas.context;
    assert.deepEqual(
        calls.filter(([name]) => name === 'clip'), new Array(clips).fill(['clip', 'evenodd']));
    assert.equal(calls.filter(([name]) => name === 'stroke').length, 1);
  }
});

function callsOf(pictures, name) {
  return pictures.card('front').canvas.context.calls.filter(([call]) => call === name);
}

test('keypoints lie on pixel centres over the picture, until they are hidden', async () => {
  const {pictures, decoding} = open();
  const view = {timeMs: 1, points: Float32Array.from([9, 10, 20, 1, 10, 30, 20, 1])};
  pictures.take(picture(1, 0, {keypoints: [view]}));
  decoding[0].done();
  await settle();
  pictures.draw();
  assert.deepEqual(callsOf(pictures, 'lineTo').at(-1), ['lineTo', 30.5, 20.5]);
  const drawn = callsOf(pictures, 'arc').length;
  assert.ok(drawn >= 2);
  pictures.setKeypoints(false);
  assert.equal(callsOf(pictures, 'drawImage').length, 2);
  assert.equal(callsOf(pictures, 'arc').length, drawn);
});

test('a camera tells how much of the people it does not know, if anybody was there', async () => {
  for (const [unknownShare, text] of [[-1, ''], [0.4, '40\u00a0% of the people unknown']]) {
    const {pictures, decoding} = open();
    pictures.take(picture(1, 0, {unknownShare}));
    decoding[0].done();
    await settle();
    pictures.draw();
    assert.equal(pictures.card('front').unknown.textContent, text);
  }
});

test('a grey picture says why, and a click chooses its camera', () => {
  const {pictures, chosen} = open();
  const card = pictures.card('left');
  card.tell({look: 'lost', facts: '0.0 /s', veil: 'lost'});
  assert.equal(card.element.dataset.tone, 'bad');
  assert.equal(card.button.attributes['aria-label'], 'lost. View through left');
  assert.ok(card.element.classes.has('old'));
  card.tell({look: 'never heard of', facts: '', veil: ''});
  assert.equal(card.element.dataset.tone, 'muted');
  assert.ok(!card.element.classes.has('old'));
  card.button.dispatchEvent(new Event('click'));
  assert.deepEqual(chosen, ['left']);
});
