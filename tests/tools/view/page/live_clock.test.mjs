import assert from 'node:assert/strict';
import test from 'node:test';

import {LiveClock} from '../../../../tools/view/page/live_clock.js';

const SERVER_AHEAD_MS = 1.7e12;  // The browser's clock counts from when the page was opened.

// Poses at 100 Hz that are published 15 ms after their capture and travel for `travelMs(i)`.
function feed(clock, {from = 0, count, travelMs}) {
  let nowMs = 0;
  for (let i = from; i < from + count; ++i) {
    const captured = 10 * i;
    nowMs = captured + 15 + travelMs(i);
    clock.arrived(nowMs, captured + SERVER_AHEAD_MS, captured + 15 + SERVER_AHEAD_MS);
  }
  return nowMs;
}

test('the offset of the clocks is that of the quickest message', () => {
  const clock = new LiveClock();
  const nowMs = feed(clock, {count: 100, travelMs: (i) => i % 7 === 0 ? 1 : 8});
  assert.equal(clock.serverNow(nowMs) - SERVER_AHEAD_MS, nowMs - 1);
});

test('an offset that no longer holds is forgotten within a minute', () => {
  const clock = new LiveClock();
  feed(clock, {count: 100, travelMs: () => 1});
  // The browser's clock runs on by 50 ms against the server's.
  const nowMs = feed(clock, {from: 100, count: 7000, travelMs: () => 51});
  assert.equal(clock.serverNow(nowMs) - SERVER_AHEAD_MS, nowMs - 51);
});

test('it plays so far behind that the next pose is nearly always there', () => {
  const clock = new LiveClock();
  const travelMs = (i) => [1, 3, 2, 12, 4][i % 5];
  let nowMs = feed(clock, {count: 300, travelMs});
  clock.showTime(nowMs);
  nowMs = feed(clock, {from: 300, count: 100, travelMs});
  const shown = clock.showTime(nowMs) - SERVER_AHEAD_MS;
  assert.ok(shown <= 3990, 'the newest pose is not before it');
  assert.ok(nowMs - shown < 60, `and yet it is near: ${nowMs - shown}`);
});

test('the time that is shown never runs backwards', () => {
  const clock = new LiveClock();
  let before = -Infinity;
  for (let i = 0; i < 3000; ++i) {
    const travel = i % 200 < 100 ? 2 : 60;
    const nowMs = 10 * i + 15 + travel;
    clock.arrived(nowMs, 10 * i, 10 * i + 15);
    if (i % 2) continue;
    const shown = clock.showTime(10 * i + 80);
    assert.ok(shown >= before);
    before = shown;
  }
});

test('jitter does not make it show what is older than a quarter of a second', () => {
  const clock = new LiveClock();
  const nowMs = feed(clock, {count: 200, travelMs: (i) => i % 3 === 0 ? 1 : 400});
  const ageMs = clock.serverNow(nowMs) - clock.showTime(nowMs);
  assert.ok(ageMs <= 250, `${ageMs}`);
});

test('a clock that is put back is learned anew at once', () => {
  const clock = new LiveClock();
  feed(clock, {count: 100, travelMs: () => 1});
  for (const stepMs of [-800, -3600000]) {
    const aheadMs = SERVER_AHEAD_MS + stepMs;
    assert.ok(clock.arrived(1100, aheadMs + 1080, aheadMs + 1095));
    assert.equal(clock.serverNow(1100), aheadMs + 1095);
    assert.ok(clock.showTime(1100) <= aheadMs + 1080);
    assert.ok(!clock.arrived(1110, aheadMs + 1090, aheadMs + 1105));
  }
});

test('a message that another one overtook puts no clock back', () => {
  const clock = new LiveClock();
  const nowMs = feed(clock, {count: 100, travelMs: (i) => i === 50 ? 1 : 9});
  assert.ok(!clock.arrived(nowMs, SERVER_AHEAD_MS + 960, SERVER_AHEAD_MS + 975));
  assert.equal(clock.serverNow(nowMs) - SERVER_AHEAD_MS, nowMs - 1);
});

test('before the first pose nothing is shown', () => {
  assert.equal(new LiveClock().showTime(0), null);
});
