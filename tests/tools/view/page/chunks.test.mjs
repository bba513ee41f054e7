import assert from 'node:assert/strict';
import test from 'node:test';

import {Chunks} from '../../../../tools/view/page/chunks.js';

const settle = () => new Promise((resolve) => setImmediate(resolve));

function recordingFetch(requests) {
  return async (from, count) => {
    requests.push([from, count]);
    return Array.from({length: count}, (_, i) => `pose ${from + i}`);
  };
}

test('what is shown and what comes next is fetched, and found by its frame', async () => {
  const requests = [];
  const chunks = new Chunks(300, recordingFetch(requests));
  assert.equal(chunks.get(130), null);
  chunks.want(130);
  await settle();
  assert.deepEqual(requests, [[128, 128], [256, 44]]);
  assert.equal(chunks.get(130), 'pose 130');
  assert.equal(chunks.get(299), 'pose 299');
  assert.equal(chunks.get(300), null);
});

test('nothing is asked for twice while it is on its way', async () => {
  const requests = [];
  const chunks = new Chunks(300, recordingFetch(requests));
  for (let i = 0; i < 10; ++i) chunks.want(i);
  await settle();
  assert.equal(requests.length, 2);
});

test('a take of hours takes bounded memory', async () => {
  const chunks = new Chunks(1e6, recordingFetch([]));
  for (let frame = 0; frame < 1e5; frame += 128) {
    chunks.want(frame);
    await settle();
  }
  assert.ok(chunks.chunks.size <= 40);
});

test('what failed is asked for again, after a while', async () => {
  let fails = true;
  const chunks = new Chunks(100, async (from, count) => {
    if (fails) throw new Error('no server');
    return new Array(count).fill('pose');
  });
  chunks.want(0, 0);
  await settle();
  fails = false;
  chunks.want(0, 100);
  await settle();
  assert.equal(chunks.get(0), null);
  chunks.want(0, 5000);
  await settle();
  assert.equal(chunks.get(0), 'pose');
});
