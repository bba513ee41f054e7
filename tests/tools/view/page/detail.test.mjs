import assert from 'node:assert/strict';
import test from 'node:test';

import {Detail} from '../../../../tools/view/page/detail.js';

function drawFor(detail, {fromMs, seconds, intervalMs}) {
  let nowMs = fromMs;
  while (nowMs < fromMs + 1000 * seconds) {
    nowMs += intervalMs;
    detail.tick(nowMs);
  }
  return nowMs;
}

test('a slow machine draws fewer pixels, but never less than half', () => {
  const detail = new Detail({isSoftware: false, isFixed: false});
  drawFor(detail, {fromMs: 0, seconds: 2, intervalMs: 60});
  assert.equal(detail.scale, 0.75);
  drawFor(detail, {fromMs: 2000, seconds: 60, intervalMs: 200});
  assert.equal(detail.scale, 0.5);
});

test('a machine that was busy for a while gets its pixels back', () => {
  const detail = new Detail({isSoftware: false, isFixed: false});
  const nowMs = drawFor(detail, {fromMs: 0, seconds: 2, intervalMs: 60});
  drawFor(detail, {fromMs: nowMs, seconds: 70, intervalMs: 16});
  assert.equal(detail.scale, 1);
});

test('a page that was hidden is not a slow one', () => {
  const detail = new Detail({isSoftware: false, isFixed: false});
  drawFor(detail, {fromMs: 0, seconds: 200, intervalMs: 1200});
  assert.equal(detail.scale, 1);
});

test('for a picture of the page every pixel is drawn', () => {
  const detail = new Detail({isSoftware: true, isFixed: true});
  drawFor(detail, {fromMs: 0, seconds: 60, intervalMs: 300});
  assert.equal(detail.ratio(1), 1);
});

test('where the processor draws, it draws some frames a second and no more', () => {
  const detail = new Detail({isSoftware: true, isFixed: false});
  let drawn = 0;
  for (let nowMs = 0; nowMs < 10000; nowMs += 1000 / 60) {
    if (!detail.isDue(nowMs)) continue;
    detail.tick(nowMs);
    ++drawn;
  }
  assert.ok(drawn > 80 && drawn <= 110, `${drawn}`);
  assert.equal(detail.scale, detail.finest, 'its pace is not slowness');
});
