import assert from 'node:assert/strict';
import test from 'node:test';

import {Socket} from '../../../../tools/view/page/socket.js';

class FakeWebSocket extends EventTarget {
  static made = [];
  constructor(url) {
    super();
    this.url = url;
    FakeWebSocket.made.push(this);
  }
}

/** A socket whose waits end at once when asked. */
function open(context) {
  FakeWebSocket.made = [];
  globalThis.WebSocket = FakeWebSocket;
  const waits = [];
  context.mock.method(globalThis, 'setTimeout', (call, ms) => waits.push({call, ms}));
  const heard = [];
  const socket = new Socket('ws://here/live', {
    open: () => heard.push('open'),
    text: (message) => heard.push(message),
    binary: (buffer) => heard.push(buffer),
    closed: () => heard.push('closed'),
  });
  return {socket, heard, waits};
}

function send(data) {
  FakeWebSocket.made.at(-1).dispatchEvent(Object.assign(new Event('message'), {data}));
}

test('text is parsed, binary is handed on, and what is no JSON is ignored', (context) => {
  const {heard} = open(context);
  FakeWebSocket.made[0].dispatchEvent(new Event('open'));
  const bytes = new ArrayBuffer(4);
  send('{"type":"notice"}');
  send('{"type":');
  send(bytes);
  assert.deepEqual(heard, ['open', {type: 'notice'}, bytes]);
});

test('it connects again after waits that double up to ten seconds', (context) => {
  const {waits} = open(context);
  for (let i = 0; i < 8; ++i) {
    FakeWebSocket.made.at(-1).dispatchEvent(new Event('close'));
    waits.at(-1).call();
  }
  assert.equal(FakeWebSocket.made.length, 9);
  const bases = [500, 1000, 2000, 4000, 8000, 10000, 10000, 10000];
  waits.forEach(({ms}, i) => assert.ok(0.75 * bases[i] <= ms && ms <= 1.25 * bases[i]));
});

test('a connection that opened starts with short waits again', (context) => {
  const {socket, waits} = open(context);
  for (let i = 0; i < 4; ++i) {
    FakeWebSocket.made.at(-1).dispatchEvent(new Event('close'));
    waits.at(-1).call();
  }
  FakeWebSocket.made.at(-1).dispatchEvent(new Event('open'));
  assert.ok(socket.isOpen);
  FakeWebSocket.made.at(-1).dispatchEvent(new Event('close'));
  assert.ok(!socket.isOpen);
  assert.ok(waits.at(-1).ms <= 625);
});
