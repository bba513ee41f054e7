import assert from 'node:assert/strict';
import test from 'node:test';

import {freshElement} from './fake_page.mjs';

const {Actions} = await import('../../../../tools/view/page/actions.js');
const IDS = [
  'record-form', 'record-start', 'record-name', 'record-stop', 'subject-person', 'action-forms',
  'no-actions', 'save-form', 'load-form', 'subject-name', 'subject-list', 'subject-new', 'reload',
  'background-learn', 'answer', 'confirm', 'confirm-title', 'confirm-text', 'confirm-yes'
];

/** A page with a token in its address. `answer` is called for each request: path, options. */
async function open({hash = '#token=secret', answer = () => ({status: 204, ok: true})} = {}) {
  const page = Object.fromEntries(IDS.map((id) => [id, freshElement(id)]));
  const asked = [];
  const stored = new Map();
  Object.assign(globalThis, {
    location: {hash, pathname: '/', search: ''},
    history: {replaceState: (state, title, address) => page.address = address},
    sessionStorage:
        {getItem: (key) => stored.get(key), setItem: (k, value) => stored.set(k, value)},
    fetch: async (path, options) => {
      const request = options.body && JSON.parse(options.body).request;
      asked.push({request, token: options.headers.Authorization});
      return answer(request);
    },
  });
  window.addEventListener = () => {};
  page['confirm'].showModal = () => {};
  const actions = new Actions();
  await settle();
  return {actions, page, asked, requests: () => asked.map(({request}) => request).filter(Boolean)};
}

function settle() {
  return new Promise((resolve) => setImmediate(resolve));
}

function accepting(replies = {}) {
  return (request) => request === undefined ? {status: 204, ok: true} : {
    status: 200,
    ok: true,
    json: async () => replies[request] ??
        {
          outcome: 'done', text: ''
        }
  };
}

async function submit(element) {
  element.dispatchEvent(new Event('submit'));
  await settle();
}

async function decide(page, choice) {
  page.confirm.returnValue = choice;
  page.confirm.dispatchEvent(new Event('close'));
  await settle();
}

test('the token leaves the address bar and goes with each request', async () => {
  const {page, asked} = await open({answer: accepting()});
  assert.equal(page.address, '/');
  assert.ok(asked.length > 0);
  assert.ok(asked.every(({token}) => token === 'Bearer secret'));
  assert.equal(page['action-forms'].hidden, false);
});

test('without a token, or with a false one, the page is read-only', async () => {
  for (const [hash, said] of [['', /^This page is read-only/], ['#token=old', /no longer valid/]]) {
    const {page} = await open({hash, answer: () => ({status: 401, ok: false})});
    assert.equal(page['action-forms'].hidden, true);
    assert.match(page['no-actions'].textContent, said);
  }
});

test('a reason of the server is told before anything else', async () => {
  const {actions, page} = await open({answer: accepting()});
  actions.setNotice('mocapd does not let this user control it');
  assert.equal(page['action-forms'].hidden, true);
  assert.equal(page['no-actions'].textContent, 'mocapd does not let this user control it');
});

test('a take is recorded under its name; what is no name is not sent', async () => {
  const {page, requests} = await open({answer: accepting()});
  for (const name of ['../etc', 'a b', '', 'x'.repeat(65)]) {
    page['record-name'].value = name;
    await submit(page['record-form']);
    assert.match(page.answer.textContent, /^A name has letters/);
  }
  page['record-name'].value = ' walk-01 ';
  await submit(page['record-form']);
  assert.deepEqual(requests().filter((one) => one.startsWith('record')), ['record start walk-01']);
});

test('one request at a time', async () => {
  let answer;
  const replies = accepting();
  const {actions, requests} = await open({
    answer: (request) =>
        request === 'reload' ? new Promise((resolve) => answer = resolve) : replies(request)
  });
  const first = actions.ask('reload');
  assert.equal((await actions.ask('record stop')).outcome, 'wrong');
  answer(replies('reload'));
  assert.equal((await first).outcome, 'done');
  await actions.ask('record stop');
  assert.deepEqual(requests().slice(-2), ['reload', 'record stop']);
});

test(
    'the background is learned only after a yes, and over an objection after a second',
    async () => {
      const objection = {outcome: 'failed', text: 'somebody is in the room; --anyway learns it'};
      const {actions, page, requests} =
          await open({answer: accepting({'background learn': objection})});
      const learned = () => requests().filter((one) => one.startsWith('background'));
      actions.learn();
      await decide(page, '');
      assert.deepEqual(learned(), []);
      actions.learn();
      await decide(page, 'yes');
      assert.equal(page['confirm-text'].textContent, objection.text);
      await decide(page, 'yes');
      assert.deepEqual(learned(), ['background learn', 'background learn anyway']);
    });

test('sizes of one who has left are not saved under another\'s', async () => {
  const {actions, page, requests} = await open({answer: accepting()});
  actions.setPeople([{id: 3, label: 'person 3'}, {id: 4, label: 'person 4'}]);
  page['subject-name'].value = 'anna';
  await submit(page['save-form']);
  actions.setPeople([{id: 4, label: 'person 4'}, {id: 5, label: 'person 5'}]);
  await submit(page['save-form']);
  assert.match(page.answer.textContent, /has left/);
  const saved = requests().filter((one) => one.startsWith('subject save'));
  assert.deepEqual(saved, ['subject save anna 3']);
});

test('an answer that does not come is told', async () => {
  const {actions, page} = await open({
    answer: (request) => {
      if (request === 'reload') throw new Error('connection refused');
      return accepting()(request);
    }
  });
  await actions.ask('reload');
  assert.equal(page.answer.textContent, 'mocap view does not answer: connection refused');
  assert.equal(page.answer.dataset.outcome, 'failed');
  assert.equal(actions.isBusy, false);
});

test('while a take is recorded it can be stopped, not started', async () => {
  const {actions, page} = await open();
  actions.setRecording('running');
  assert.deepEqual([page['record-start'].hidden, page['record-stop'].hidden], [true, false]);
  actions.setRecording('complete');
  assert.deepEqual([page['record-start'].hidden, page['record-stop'].hidden], [false, true]);
});
