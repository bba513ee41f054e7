import assert from 'node:assert/strict';
import test from 'node:test';

import {SeenFetcher} from '../../../../tools/view/page/seen_fetcher.js';

const VOXELS_KIND = 2;

/** Voxels of one size [mm], without cells. */
function voxelBytes(sizeMm) {
  const view = new DataView(new ArrayBuffer(32));
  view.setUint8(0, VOXELS_KIND);
  view.setFloat32(16, sizeMm, true);
  return view.buffer;
}

/** A fetcher whose requests are answered by hand, on a clock of its own. */
function open(context) {
  const clock = {nowMs: 0};
  context.mock.method(performance, 'now', () => clock.nowMs);
  const requests = [];
  const seen = [];
  const fetcher = new SeenFetcher(
      (url) => new Promise((answer, fail) => requests.push({url, answer, fail})),
      (messages) => seen.push(messages.map(({sizeMm}) => sizeMm)));
  return {clock, requests, seen, fetcher};
}

test('a frame is asked for once, with the result to draw over it', async (context) => {
  const {fetcher, requests, seen} = open(context);
  const done = fetcher.want(12, 1);
  assert.deepEqual(requests.map(({url}) => url), ['/pictures.bin?frame=12&result=1']);
  requests[0].answer(voxelBytes(25));
  await done;
  assert.deepEqual(seen, [[25]]);
  await fetcher.want(12, 1);
  assert.equal(requests.length, 1);
  fetcher.want(12, 0);
  assert.equal(requests.length, 2, 'another result is another picture');
});

test('while one request is open no other begins, and then the newest', async (context) => {
  const {fetcher, requests} = open(context);
  const done = fetcher.want(1, 0);
  for (let frame = 2; frame < 50; ++frame) fetcher.want(frame, 0);
  assert.equal(requests.length, 1);
  requests[0].answer(voxelBytes(25));
  await done;
  fetcher.want(50, 0);
  assert.deepEqual(requests.slice(1).map(({url}) => url), ['/pictures.bin?frame=50&result=0']);
});

test('a server that is gone is asked again after a second, not at once', async (context) => {
  const {fetcher, requests, clock, seen} = open(context);
  const done = fetcher.want(3, 0);
  requests[0].fail(new Error('gone'));
  await done;
  assert.ok(fetcher.hasFailed);
  clock.nowMs = 999;
  fetcher.want(3, 0);
  assert.equal(requests.length, 1);
  clock.nowMs = 1001;
  const again = fetcher.want(3, 0);
  requests[1].answer(voxelBytes(40));
  await again;
  assert.ok(!fetcher.hasFailed);
  assert.deepEqual(seen, [[40]]);
});

test('a truncated answer is a failure, and nothing of it is shown', async (context) => {
  const {fetcher, requests, seen} = open(context);
  const done = fetcher.want(3, 0);
  requests[0].answer(voxelBytes(25).slice(0, 20));
  await done;
  assert.ok(fetcher.hasFailed);
  assert.deepEqual(seen, []);
});
